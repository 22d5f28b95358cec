// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/run/bridging.hpp"

#include "core/model/motion.hpp"
#include "core/results/way_to_tool.hpp"
#include "core/run/triangle_grid.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>

namespace plyform {
namespace {

constexpr double beneath = 0.2;     // cosine of 78 degrees: a steeper tool is beside the ply
constexpr double facing_tool = 0.5; // cosine of 60 degrees: the tool that presses
constexpr double of_its_own = 0.5;  // of G: (2)
constexpr double no_load = 1e-6;    // of the loads on a stack: their sum is rounding

std::vector<Vec3> unit_normals(const PlyBody& ply) {
  std::vector<Vec3> normals = normals_at_nodes(ply);
  for (Vec3& n : normals)
    n.stableNormalize();
  return normals;
}

/// +1, -1: loads press the stack of each ply to its upper, lower side; 0: to neither.
std::vector<double> sides_of_loads(const Scene& s) {
  std::vector<double> sum(s.plies.size(), 0.0), all(s.plies.size(), 0.0); // N/mm2, by stack
  for (std::size_t p = 0; p < s.plies.size(); ++p) {
    const double pressure = pressure_on(s.data, p, s.time).value_or(0.0);
    const std::size_t stack = at(s.plies[p].stack);
    sum[stack] += pressure, all[stack] += std::abs(pressure);
  }
  std::vector<double> sides;
  for (const PlyBody& ply : s.plies) {
    const double net = sum[at(ply.stack)];
    sides.push_back(std::abs(net) > no_load * all[at(ply.stack)] ? std::copysign(1.0, net) : 0.0);
  }
  return sides;
}

/// What is known of a node that is pressed along u.
struct NodeState {
  bool pressed = false, held_up = false;
  double height = 0.0; ///< mm, (1); 0 where no tool is met
  Vec3 u = Vec3::Zero();
  std::size_t tool = 0; ///< that it is over
};

/// The nodes beside each node.
std::vector<std::vector<std::int32_t>> neighbours(const PlyBody& ply) {
  std::vector<std::vector<std::int32_t>> beside(ply.x.size());
  for (const Triangle& t : ply.membrane.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      for (const std::size_t other : {(k + 1) % 3, (k + 2) % 3})
        beside[at(t[k])].push_back(t[other]);
  for (std::vector<std::int32_t>& nodes : beside) {
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  }
  return beside;
}

bool is_free(const NodeState& node) {
  return node.pressed && !node.held_up && node.height > 0.0;
}

/// Whether a region of free nodes spans a hollow: beside a node that is held up, and (2).
bool spans(const std::vector<std::int32_t>& region, const std::vector<NodeState>& nodes,
           const std::vector<Vec3>& x, const std::vector<std::vector<std::int32_t>>& beside) {
  bool held = false;
  double own = 0.0, all = 0.0; // S, G
  for (const std::int32_t i : region)
    for (const std::int32_t j : beside[at(i)]) {
      const NodeState &here = nodes[at(i)], &there = nodes[at(j)];
      held = held || there.held_up;
      own += here.height * (x[at(j)] - x[at(i)]).dot(here.u);
      all += here.height * (here.height - there.height);
    }
  return held && own <= of_its_own * all;
}

/// The heights of nodes in regions that span hollows; else 0.
std::vector<double> heights_of_spans(const PlyBody& ply, const std::vector<NodeState>& nodes) {
  const std::vector<std::vector<std::int32_t>> beside = neighbours(ply);
  std::vector<double> heights(nodes.size(), 0.0);
  std::vector<char> seen(nodes.size(), 0);
  for (std::size_t first = 0; first < nodes.size(); ++first) {
    if (seen[first] || !is_free(nodes[first])) continue;
    std::vector<std::int32_t> region{static_cast<std::int32_t>(first)};
    seen[first] = 1;
    for (std::size_t k = 0; k < region.size(); ++k)
      for (const std::int32_t n : beside[at(region[k])])
        if (!seen[at(n)] && is_free(nodes[at(n)])) seen[at(n)] = 1, region.push_back(n);
    if (spans(region, nodes, ply.x, beside))
      for (const std::int32_t n : region)
        heights[at(n)] = nodes[at(n)].height;
  }
  return heights;
}

} // namespace

struct BridgingSearch::Parts {
  const Scene& scene;
  bool can_be = false;
  std::vector<double> sides;
  std::vector<Mould> closed;
  std::vector<std::optional<TriangleGrid>> grids; ///< of plies that may lie between

  /// mm, of the plies but p that the way from a to b crosses.
  double between(std::size_t p, const Vec3& a, const Vec3& b) const {
    double sum = 0.0;
    for (std::size_t q = 0; q < grids.size(); ++q)
      if (q != p && grids[q] && grids[q]->crosses(a, b)) sum += scene.plies[q].thickness;
    return sum;
  }

  /// Height (mm) over the surface of a tool, that is `at_x` from x; between: set to b.
  double height(std::size_t p, const Vec3& x, const SurfacePoint& at_x, double& b) const {
    b = between(p, x, x - at_x.distance * at_x.normal);
    return at_x.distance - 0.5 * scene.plies[p].thickness - b;
  }

  /// Whether a node is held up by a tool, or how high it is over the one that it meets along u.
  void look(std::size_t p, const Vec3& x, std::span<const std::size_t> tools, double most,
            NodeState& node) const {
    const double t = scene.plies[p].thickness;
    double nearest = std::numeric_limits<double>::infinity();
    for (const std::size_t tool : tools) {
      const ToolBody& body = scene.tools[tool].body;
      SurfaceHint hint;
      const SurfacePoint at_x = distance_to_tool(body, x, hint);
      if (at_x.distance > most) continue;
      double b = 0.0;
      const double h = height(p, x, at_x, b);
      if (h <= 0.5 * (t + b) && -at_x.normal.dot(node.u) > beneath) node.held_up = true;
      if (node.held_up) return;
      const double way = way_to_tool(body, x, node.u, most);
      if (way < nearest) nearest = way, node.height = h > 0.5 * (t + b) ? h : 0.0, node.tool = tool;
    }
  }

  /// h at a point over a tool.
  double height_over(std::size_t p, const Vec3& x, std::size_t tool) const {
    SurfaceHint hint;
    double b = 0.0;
    return height(p, x, distance_to_tool(scene.tools[tool].body, x, hint), b);
  }

  void find_tops(std::size_t p, const std::vector<NodeState>& nodes,
                 std::vector<double>& heights) const;
};

/// The largest h over the tool in a triangle of these corners: around the best of a pattern of
/// points the next, half as wide.
double highest_in(const std::array<Vec3, 3>& x, const std::function<double(const Vec3&)>& height) {
  constexpr int halvings = 8; // to a thousandth of a side, over which h rises by no more
  std::array<double, 2> best{1.0 / 3.0, 1.0 / 3.0};
  const auto place = [&x](const std::array<double, 2>& w) {
    return Vec3(x[0] + w[0] * (x[1] - x[0]) + w[1] * (x[2] - x[0]));
  };
  double top = height(place(best)), width = 1.0 / 3.0;
  for (int i = 0; i < halvings; ++i, width *= 0.5) {
    const std::array<double, 2> middle = best;
    for (int a = -2; a <= 2; ++a)
      for (int b = -2; b <= 2; ++b) {
        const std::array<double, 2> w{middle[0] + a * width, middle[1] + b * width};
        if (w[0] < 0.0 || w[1] < 0.0 || w[0] + w[1] > 1.0 || (a == 0 && b == 0)) continue;
        if (const double here = height(place(w)); here > top) top = here, best = w;
      }
  }
  return top;
}

/// Gives the highest node of each triangle of a span the largest h in it.
void BridgingSearch::Parts::find_tops(std::size_t p, const std::vector<NodeState>& nodes,
                                      std::vector<double>& heights) const {
  const PlyBody& ply = scene.plies[p];
  const std::vector<double> at_nodes = heights;
  for (const Triangle& t : ply.membrane.triangles) {
    const std::int32_t highest =
        *std::max_element(t.begin(), t.end(), [&](std::int32_t a, std::int32_t b) {
          return at_nodes[at(a)] < at_nodes[at(b)];
        });
    if (!(at_nodes[at(highest)] > 0.0)) continue;
    const double top =
        highest_in({ply.x[at(t[0])], ply.x[at(t[1])], ply.x[at(t[2])]},
                   [&](const Vec3& x) { return height_over(p, x, nodes[at(highest)].tool); });
    heights[at(highest)] = std::max(heights[at(highest)], top);
  }
}

BridgingSearch::BridgingSearch(const Scene& scene, const Moulds& moulds)
    : parts_(new Parts{scene, false, sides_of_loads(scene), moulds.closed, {}}) {
  if (scene.tools.empty()) return;
  parts_->can_be = moulds.any || !scene.data.loads.empty();
  const bool any =
      !parts_->closed.empty() || std::any_of(parts_->sides.begin(), parts_->sides.end(),
                                             [](double side) { return side != 0.0; });
  parts_->grids.resize(scene.plies.size());
  for (std::size_t p = 0; any && scene.plies.size() > 1 && p < scene.plies.size(); ++p)
    parts_->grids[p].emplace(scene.plies[p].x, scene.plies[p].membrane.triangles,
                             element_size(scene.plies[p]), 0.5 * element_size(scene.plies[p]));
}

BridgingSearch::~BridgingSearch() = default;

void BridgingSearch::fill(std::size_t p, PlyFrame& frame) const {
  if (!parts_->can_be) return;
  const Scene& s = parts_->scene;
  const PlyBody& ply = s.plies[p];
  const std::size_t count = ply.x.size();
  frame.bridging_height.assign(count, 0.0), frame.pushed.assign(count, Vec3::Zero());
  for (const Vec3& x : ply.x)
    if (!x.allFinite()) return;
  const std::vector<Vec3> normals = unit_normals(ply);
  Box3 box;
  for (const Vec3& x : ply.x)
    box.extend(x);
  const double most = box.diagonal().norm();
  std::vector<NodeState> nodes(count);
  const auto take = [&] {
    std::vector<double> heights = heights_of_spans(ply, nodes);
    parts_->find_tops(p, nodes, heights);
    for (std::size_t n = 0; n < count; ++n) {
      frame.bridging_height[n] = std::max(frame.bridging_height[n], heights[n]);
      if (nodes[n].pressed && !nodes[n].held_up) frame.pushed[n] = nodes[n].u;
    }
  };
  if (parts_->sides[p] != 0.0) {
    std::vector<std::size_t> tools(s.tools.size());
    std::iota(tools.begin(), tools.end(), 0);
    for (std::size_t n = 0; n < count; ++n) {
      nodes[n] = {true, false, 0.0, parts_->sides[p] * normals[n]};
      parts_->look(p, ply.x[n], tools, most, nodes[n]);
    }
    take();
  }
  for (const Mould& mould : parts_->closed) {
    for (std::size_t n = 0; n < count; ++n) {
      SurfaceHint hint;
      const SurfacePoint to = distance_to_tool(s.tools[mould.to].body, ply.x[n], hint);
      nodes[n] = {false, false, 0.0,
                  to.normal.dot(normals[n]) < 0.0 ? normals[n] : Vec3(-normals[n])};
      parts_->look(p, ply.x[n], std::array{mould.to}, most, nodes[n]);
      if (nodes[n].held_up) continue;
      SurfaceHint other;
      const SurfacePoint from = distance_to_tool(s.tools[mould.from].body, ply.x[n], other);
      double b = 0.0;
      const double gap = parts_->height(p, ply.x[n], from, b);
      nodes[n].pressed =
          gap <= 0.5 * (ply.thickness + b) && from.normal.dot(nodes[n].u) > facing_tool;
    }
    take();
  }
}

} // namespace plyform
