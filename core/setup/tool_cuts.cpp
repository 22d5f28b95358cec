// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/setup/tool_cuts.hpp"

#include "core/input/checks/initial_scene.hpp"
#include "core/model/motion.hpp"
#include "core/run/facet_penetration.hpp"
#include "core/setup/draws.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

/// An edge of a tool's surface that sticks out, in space.
struct Ridge {
  Vec3 q, n, across, along; ///< mm; unit vectors
  double angle = 0.0;       ///< rad, between the normals of its faces
};

/// Ridges of a surface, the sharpest ones if there are very many.
std::vector<Ridge> ridges_of(const TriMesh& surface) {
  constexpr double flat = 1e-3;       // rad
  constexpr std::size_t most = 20000; // asked
  const auto middle = [&](std::size_t f) {
    const Triangle& t = surface.triangles[f];
    return Vec3((surface.x[t[0]] + surface.x[t[1]] + surface.x[t[2]]) / 3.0);
  };
  const auto normal = [&](std::size_t f) {
    const Triangle& t = surface.triangles[f];
    const Vec3& a = surface.x[t[0]];
    return Vec3((surface.x[t[1]] - a).cross(surface.x[t[2]] - a).stableNormalized());
  };
  std::vector<Ridge> ridges;
  const std::vector<FaceSide> sides = sides_by_edge(surface.triangles);
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    while (end < sides.size() && sides[end].same_edge(sides[begin]))
      ++end;
    if (end - begin != 2) continue;
    const FaceSide& edge = sides[begin];
    const Vec3 n0 = normal(edge.face), n1 = normal(sides[begin + 1].face);
    const double angle = std::acos(std::clamp(n0.dot(n1), -1.0, 1.0));
    if (angle < flat || n0.dot(middle(sides[begin + 1].face) - surface.x[edge.first]) >= 0.0)
      continue;
    Ridge ridge;
    ridge.q = 0.5 * (surface.x[edge.first] + surface.x[edge.second]);
    ridge.n = (n0 + n1).stableNormalized();
    ridge.along = (surface.x[edge.second] - surface.x[edge.first]).stableNormalized();
    ridge.across = ridge.n.cross(ridge.along);
    ridge.angle = angle;
    ridges.push_back(ridge);
  }
  if (ridges.size() > most) {
    std::nth_element(ridges.begin(), ridges.begin() + most, ridges.end(),
                     [](const Ridge& a, const Ridge& b) { return a.angle > b.angle; });
    ridges.resize(most);
  }
  return ridges;
}

/// Lowers chords onto one tool.
struct Chords {
  const Tool& tool;
  double half; ///< mm, of the thickness
  mutable SurfaceHint hint;

  double distance(const Vec3& p) const { return tool_distance(tool, Vec3::Zero(), p, hint); }

  /// The place of a ridge, mm, on the surface and half a thickness above it.
  Vec3 top_of(const Ridge& ridge) const {
    return ridge.q - distance(ridge.q) * ridge.n + half * ridge.n;
  }

  /// Whether the ends of a chord of that side in direction `across` are free `way` mm below `top`.
  bool ends_free(const Ridge& ridge, const Vec3& top, const Vec3& across, double side,
                 double way) const {
    const Vec3 p = top - way * ridge.n;
    return distance(p + 0.5 * side * across) > half && distance(p - 0.5 * side * across) > half;
  }

  /// The way, mm, of a chord of that side in direction `across`.
  double cut(const Ridge& ridge, const Vec3& across, double side) const {
    const Vec3 top = top_of(ridge);
    const auto free = [&](double way) { return ends_free(ridge, top, across, side, way); };
    double low = 0.0, high = 0.5 * side; // as over a sharp edge of 90 degrees, at most
    if (!free(1e-9 * side)) return 0.0;
    if (free(high)) return high;
    for (int i = 0; i < 20; ++i)
      (free(0.5 * (low + high)) ? low : high) = 0.5 * (low + high);
    return low;
  }

  /// With the longer way that the middle of a triangle has to its corners where the surface is
  /// curved both ways.
  double deepest(const Ridge& ridge, double side) const {
    const double one = cut(ridge, ridge.across, side);
    const bool both_ways = one > 0.0 && cut(ridge, ridge.along, side) > 0.5 * one;
    return both_ways ? cut(ridge, ridge.across, longer * side) : one;
  }

  /// Whether `deepest` may be more than `depth`, mm: most places of a tool cut less than the worst.
  bool may_exceed(const Ridge& ridge, double side, double depth) const {
    const Vec3 top = top_of(ridge);
    return ends_free(ridge, top, ridge.across, longer * side, depth) ||
           ends_free(ridge, top, ridge.across, side, depth);
  }

  static constexpr double longer = 1.1547005383792515; ///< 2 / sqrt(3)
};

/// Direction from the tool to the part of the ply that is closest to it.
Vec3 side_of(const Tool& tool, const PlyBody& ply) {
  double least = std::numeric_limits<double>::infinity();
  Vec3 side = Vec3::UnitZ();
  SurfaceHint hint;
  for (const Vec3& x : ply.x0) {
    const Vec3 local = tool.rotation.transpose() * (x - tool.position);
    const SurfacePoint found = signed_distance(tool.shape, local, hint);
    if (found.distance < least) least = found.distance, side = tool.rotation * found.normal;
  }
  return side;
}

/// The longest sides of a flat ply's triangles from place to place, on squares that divide its box.
class SidesInPlan {
public:
  explicit SidesInPlan(const PlyBody& ply) : longest_(longest_side(ply.edges, ply.x)) {
    for (const Vec3& x : ply.x0)
      box_.extend(Vec2(x.head<2>()));
    square_ = std::max(0.5 * longest_, box_.sizes().maxCoeff() / most_squares);
    columns_ = 1 + static_cast<int>(box_.sizes().x() / square_);
    rows_ = 1 + static_cast<int>(box_.sizes().y() / square_);
    sides_.assign(at(columns_ * rows_), 0.0);
    for (const Triangle& t : ply.membrane.triangles)
      enter(ply.x0[at(t[0])], ply.x0[at(t[1])], ply.x0[at(t[2])]);
  }

  double longest() const { return longest_; }

  /// The longest side, mm, from p for `way` (mm) in direction u, a unit vector.
  double longest_along(const Vec2& p, const Vec2& u, double way) const {
    double side = 0.0;
    for (double gone = 0.0; gone <= way; gone += 0.5 * square_) {
      const Vec2 x = p + gone * u;
      if (box_.contains(x)) side = std::max(side, sides_[square_at(x)]);
    }
    return side;
  }

private:
  static constexpr double most_squares = 400.0; // a way

  std::size_t square_at(const Vec2& x) const {
    const Vec2 place = (x - box_.min()) / square_;
    return at(std::clamp(static_cast<int>(place.y()), 0, rows_ - 1) * columns_ +
              std::clamp(static_cast<int>(place.x()), 0, columns_ - 1));
  }

  void enter(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double side = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    for (const auto& w : {Vec3(1, 1, 1), Vec3(4, 1, 1), Vec3(1, 4, 1), Vec3(1, 1, 4), Vec3(3, 3, 0),
                          Vec3(0, 3, 3), Vec3(3, 0, 3)}) {
      const Vec3 x = (w[0] * a + w[1] * b + w[2] * c) / w.sum();
      double& there = sides_[square_at(x.head<2>())];
      there = std::max(there, side);
    }
  }

  double longest_, square_ = 0.0; ///< mm
  Eigen::AlignedBox2d box_;
  int columns_ = 0, rows_ = 0;
  std::vector<double> sides_; ///< mm
};

/// mm: how far cloth may be drawn over a place of a tool: half of what drives it, about as much as
/// over the fillet of a hemisphere's die.
double draw_of(const Case& data) {
  const Strokes strokes = longest_strokes(data);
  return 0.5 * std::max(strokes.tool, strokes.boundary);
}

/// The longest side that passes a ridge: from there on to where the cloth comes from, against the
/// way that the ridge leans.
double side_over(const SidesInPlan& sides, const Ridge& ridge, double draw) {
  const Vec2 leans = ridge.n.head<2>();
  const Vec2 from = leans.norm() > 1e-6 ? Vec2(-leans.normalized()) : Vec2(Vec2::UnitX());
  return sides.longest_along(ridge.q.head<2>(), from, draw);
}

} // namespace

std::optional<CutAhead> cut_ahead(const Scene& scene, std::size_t t, std::size_t p) {
  constexpr double askew = 0.1; // cosine from which a place faces a direction
  const Tool& tool = scene.data.tools[t];
  const PlyBody& ply = scene.plies[p];
  const SidesInPlan sides(ply);
  const double half = 0.5 * ply.thickness, draw = draw_of(scene.data);
  const std::vector<Vec3> ways = draws_on(scene.data, t);
  Box3 box;
  for (const Vec3& x : ply.x0)
    box.extend(x);
  const double reach = box.diagonal().norm() + tool.position.norm() + box.center().norm();
  const Vec3 to_ply = side_of(tool, ply);
  const Chords chords{tool, half, {}};
  std::optional<CutAhead> worst;
  for (const Ridge& ridge : ridges_of(tool_surface(tool, 0.5 * sides.longest(), reach))) {
    const bool over = draws_over(ways, ridge.n);
    const Eigen::AlignedBox2d plan(Vec2(box.min().head<2>()), Vec2(box.max().head<2>()));
    if (!over || ridge.n.dot(to_ply) < askew || !plan.contains(ridge.q.head<2>())) continue;
    const double side = side_over(sides, ridge, draw);
    if (side == 0.0 || (worst && !chords.may_exceed(ridge, side, worst->depth))) continue;
    const double depth = chords.deepest(ridge, side);
    if (worst && depth <= worst->depth) continue;
    worst = CutAhead{depth, ridge.q, 0.0, side, side};
    if (!(depth > half)) continue;
    const double near = 4.0 * half, there = chords.cut(ridge, ridge.across, near);
    const double radius = (0.25 * near * near + there * there) / (2.0 * there) - half;
    worst->radius =
        radius < 2.0 * half ? 0.0 : (0.25 * side * side + depth * depth) / (2.0 * depth) - half;
    double low = 0.0, high = side;
    for (int i = 0; i < 20; ++i)
      (chords.deepest(ridge, 0.5 * (low + high)) > half ? high : low) = 0.5 * (low + high);
    worst->good_side = low;
  }
  return worst;
}

} // namespace plyform
