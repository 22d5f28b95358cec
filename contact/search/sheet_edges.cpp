// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/search/sheet_edges.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace plyform {
namespace {

/// Small patches move more alike, few are quicker to compare. With half or twice as many edges
/// hemisphere_five_ply takes as long.
constexpr double edges_per_patch = 30.0;

std::vector<SheetEdge> list_edges(std::span<const Triangle> triangles) {
  std::map<std::pair<int, int>, SheetEdge> open;
  std::vector<SheetEdge> edges;
  for (const Triangle& t : triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const int i = t[k], j = t[(k + 1) % 3];
      const auto [found, first] = open.try_emplace(std::minmax(i, j));
      SheetEdge& edge = found->second;
      std::int32_t& third = i < j ? edge.c : edge.d;
      if (first) edge = {std::min(i, j), std::max(i, j), -1, -1};
      third = t[(k + 2) % 3];
      if (first) continue;
      edges.push_back(edge);
      open.erase(found);
    }
  for (const auto& [key, edge] : open)
    edges.push_back(edge);
  std::sort(edges.begin(), edges.end(), [](const SheetEdge& e, const SheetEdge& g) {
    return std::pair(e.a, e.b) < std::pair(g.a, g.b);
  });
  return edges;
}

/// Gives free edges that lie on a plane the mirror image of their triangle.
void close_at(std::span<const NodesOnPlane> planes, std::vector<SheetEdge>& edges) {
  for (std::size_t k = 0; k < planes.size(); ++k) {
    const auto on = [&](std::int32_t n) {
      return std::binary_search(planes[k].nodes.begin(), planes[k].nodes.end(), n);
    };
    for (SheetEdge& e : edges)
      if (e.is_free() && on(e.a) && on(e.b)) (e.c == no_face ? e.c : e.d) = mirror_of(k);
  }
}

/// The first edge of two nodes.
std::size_t number_of(const std::vector<SheetEdge>& edges, std::int32_t i, std::int32_t j) {
  const std::pair<std::int32_t, std::int32_t> wanted = std::minmax(i, j);
  const auto before = [](const SheetEdge& e, const auto& nodes) {
    return std::pair(e.a, e.b) < nodes;
  };
  return static_cast<std::size_t>(std::lower_bound(edges.begin(), edges.end(), wanted, before) -
                                  edges.begin());
}

/// The size (mm) of the cells, and the axes that they divide.
struct Cells {
  double size;
  int one, two;
  Vec3 low;
};

Cells cells_of(std::size_t edges, std::span<const Vec3> x0) {
  Box3 all;
  for (const Vec3& x : x0)
    all.extend(x);
  const Vec3 sizes = x0.empty() ? Vec3::Zero().eval() : Vec3(all.sizes());
  int flat = 0;
  sizes.minCoeff(&flat);
  const int one = (flat + 1) % 3, two = (flat + 2) % 3;
  const double patches = std::max(1.0, static_cast<double>(edges) / edges_per_patch);
  const double longest = std::max(sizes[one], sizes[two]);
  const double size = std::sqrt(sizes[one] * sizes[two] / patches);
  return {std::max({size, longest / patches, 1e-9}), one, two, all.min()};
}

/// SheetEdges::faces_across. edge: numbers of the edges of each triangle, that of its nodes k and
/// k + 1 at k.
std::vector<std::array<std::int32_t, 3>>
faces_across(const std::vector<std::array<std::int32_t, 3>>& edge, std::size_t edges) {
  std::vector<std::array<std::int32_t, 2>> faces(edges, {no_face, no_face});
  for (std::size_t t = 0; t < edge.size(); ++t)
    for (const std::int32_t e : edge[t]) {
      const auto face = static_cast<std::int32_t>(t);
      auto& [one, other] = faces[static_cast<std::size_t>(e)];
      if (one == no_face)
        one = face;
      else
        other = other == no_face ? face : several_faces;
    }
  std::vector<std::array<std::int32_t, 3>> across(edge.size());
  for (std::size_t t = 0; t < edge.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& [one, other] = faces[static_cast<std::size_t>(edge[t][(k + 1) % 3])];
      across[t][k] = other < 0 || one == static_cast<std::int32_t>(t) ? other : one;
    }
  return across;
}

} // namespace

std::array<Vec3, 2> SheetEdges::third_nodes(const SheetEdge& e, std::span<const Vec3> x) const {
  const auto beyond = [&](std::int32_t plane, std::int32_t other) {
    const Vec3& normal = plane_normals[static_cast<std::size_t>(mirror_of(0) - plane)];
    const Vec3& third = x[at(other)];
    return Vec3(third - 2.0 * (third - x[at(e.a)]).dot(normal) * normal);
  };
  std::array<Vec3, 2> found = {Vec3::Zero(), Vec3::Zero()};
  if (e.c >= 0) found[0] = x[at(e.c)];
  if (e.d >= 0) found[1] = x[at(e.d)];
  if (e.c < no_face) found[0] = beyond(e.c, e.d);
  if (e.d < no_face) found[1] = beyond(e.d, e.c);
  return found;
}

SheetEdges sheet_edges(std::span<const Triangle> triangles, std::span<const Vec3> x0,
                       std::span<const NodesOnPlane> planes) {
  SheetEdges edges{list_edges(triangles), {}, {}, {}, {}, {}};
  close_at(planes, edges.all);
  for (const NodesOnPlane& plane : planes)
    edges.plane_normals.push_back(plane.normal);
  edges.all.shrink_to_fit();
  edges.patch.reserve(edges.all.size());
  const Cells cells = cells_of(edges.all.size(), x0);
  std::map<std::pair<int, int>, std::int32_t> patch_at;
  for (const SheetEdge& e : edges.all) {
    const Vec3 from = (0.5 * (x0[e.a] + x0[e.b]) - cells.low) / cells.size;
    const std::pair place(static_cast<int>(from[cells.one]), static_cast<int>(from[cells.two]));
    const auto next = static_cast<std::int32_t>(edges.patch_nodes.size());
    const auto [found, is_new] = patch_at.try_emplace(place, next);
    if (is_new) edges.patch_nodes.emplace_back(), edges.patch_edges.emplace_back();
    edges.patch_edges[found->second].push_back(static_cast<std::int32_t>(edges.patch.size()));
    edges.patch.push_back(found->second);
    std::vector<std::int32_t>& nodes = edges.patch_nodes[found->second];
    nodes.insert(nodes.end(), {e.a, e.b});
  }
  for (std::vector<std::int32_t>& nodes : edges.patch_nodes) {
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    nodes.shrink_to_fit();
  }
  for (std::vector<std::int32_t>& of : edges.patch_edges)
    of.shrink_to_fit();
  std::vector<std::array<std::int32_t, 3>> edge_of;
  edge_of.reserve(triangles.size());
  edges.patches_of_triangle.reserve(triangles.size());
  for (const Triangle& t : triangles) {
    auto& of = edge_of.emplace_back();
    auto& patch = edges.patches_of_triangle.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t e = number_of(edges.all, t[k], t[(k + 1) % 3]);
      of[k] = static_cast<std::int32_t>(e);
      patch[k] = edges.patch[e];
    }
  }
  edges.faces_across = faces_across(edge_of, edges.all.size());
  return edges;
}

std::vector<double> rim_distances(const SheetEdges& edges, std::span<const Vec3> x) {
  std::vector<double> distance(x.size(), std::numeric_limits<double>::infinity());
  for (const SheetEdge& e : edges.all) {
    if (!e.is_free()) continue;
    const Vec3 &from = x[at(e.a)], side = x[at(e.b)] - from;
    for (std::size_t n = 0; n < x.size(); ++n) {
      const double along = std::clamp((x[n] - from).dot(side) / side.squaredNorm(), 0.0, 1.0);
      distance[n] = std::min(distance[n], (x[n] - from - along * side).norm());
    }
  }
  return distance;
}

double longest_side(const SheetEdges& edges, std::span<const Vec3> x) {
  double longest = 0.0;
  for (const SheetEdge& e : edges.all)
    longest = std::max(longest, (x[at(e.a)] - x[at(e.b)]).norm());
  return longest;
}

void patch_motions(const SheetEdges& edges, std::span<const Vec3> motion,
                   std::vector<Box3>& boxes) {
  boxes.resize(edges.patch_nodes.size());
  for (std::size_t p = 0; p < boxes.size(); ++p) {
    const std::vector<std::int32_t>& nodes = edges.patch_nodes[p];
    Vec3 low = motion[nodes.front()], high = low; // in registers, unlike boxes[p]
    for (const std::int32_t n : nodes) {
      low = low.cwiseMin(motion[n]);
      high = high.cwiseMax(motion[n]);
    }
    boxes[p] = Box3(low, high);
  }
}

double relative_motion(const Box3& a, const Box3& b) {
  return (a.max() - b.min()).cwiseMax(b.max() - a.min()).norm();
}

} // namespace plyform
