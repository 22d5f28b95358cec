// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/tool_zone.hpp"

#include "contact/shapes/mesh_curvature.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace plyform {
namespace {

using SurfaceSide = std::pair<std::int32_t, std::int32_t>;

/// A surface, and the radius from which on it is not tight.
struct TightSurface {
  const TriMesh& surface;
  std::vector<double> radius; ///< mm, of each node
  double below_radius;        ///< mm

  /// Radii across tessellated fillets of round tools are found to 2 % or so.
  bool is_tight(std::int32_t node) const { return radius[at(node)] <= 1.02 * below_radius; }
};

Vec3 face_normal_of(const TriMesh& surface, std::size_t f) {
  const Triangle& t = surface.triangles[f];
  const Vec3& a = surface.x[at(t[0])];
  return (surface.x[at(t[1])] - a).cross(surface.x[at(t[2])] - a).stableNormalized();
}

/// The sides with two tight ends over which the surface bends outwards, with the tightest radius
/// (mm) at their faces: where a rounding ends, that of nodes is found too large.
std::map<SurfaceSide, double> tight_sides(const TightSurface& tight) {
  constexpr double least_turn = 1e-3; // rad
  const TriMesh& s = tight.surface;
  const auto tightest = [&](std::size_t f) {
    const Triangle& t = s.triangles[f];
    return std::min({tight.radius[at(t[0])], tight.radius[at(t[1])], tight.radius[at(t[2])]});
  };
  std::map<SurfaceSide, std::size_t> first;
  std::map<SurfaceSide, double> sides;
  for (std::size_t f = 0; f < s.triangles.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const Triangle& t = s.triangles[f];
      const SurfaceSide side = std::minmax(t[k], t[(k + 1) % 3]);
      if (!tight.is_tight(side.first) || !tight.is_tight(side.second)) continue;
      const auto [other, fresh] = first.emplace(side, f);
      if (fresh) continue;
      const Vec3 n = face_normal_of(s, other->second), m = face_normal_of(s, f);
      const Vec3 beyond = s.x[at(t[(k + 2) % 3])] - s.x[at(side.first)];
      if (n.cross(m).norm() > least_turn && n.dot(beyond) < 0.0)
        sides.emplace(side, std::min(tightest(other->second), tightest(f)));
    }
  return sides;
}

/// The radius (mm) of the rounding that a triangle is a piece of; nothing for one beside it, which
/// is longer across a side that is bent: roundings have pieces of 35 degrees at most.
std::optional<double> rounding_of(const TightSurface& tight,
                                  const std::map<SurfaceSide, double>& sides, const Triangle& t) {
  const auto x = [&](std::size_t k) { return tight.surface.x[at(t[k % 3])]; };
  const double twice_area = (x(1) - x(0)).cross(x(2) - x(0)).norm();
  std::optional<double> radius;
  if (!std::all_of(t.begin(), t.end(), [&](std::int32_t n) { return tight.is_tight(n); }))
    return radius;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto side = sides.find(std::minmax(t[k], t[(k + 1) % 3]));
    if (side == sides.end() || twice_area > sharp_turn * side->second * (x(k + 1) - x(k)).norm())
      continue;
    radius = std::min(radius.value_or(side->second), side->second);
  }
  return radius;
}

/// Places by square cells; one a cell, that with the longest reach.
class ThinnedPlaces {
public:
  explicit ThinnedPlaces(double cell_side) : side(cell_side) {}

  void add(const Vec2& p, double reach) {
    const auto cell = [this](double x) { return static_cast<std::int64_t>(std::floor(x / side)); };
    const auto [place, fresh] = index.emplace(std::pair(cell(p.x()), cell(p.y())), all.size());
    if (fresh)
      all.push_back({p, reach});
    else if (all[place->second].reach < reach)
      all[place->second] = {p, reach};
  }

  std::vector<ToolPlace> all;

private:
  double side; ///< mm
  std::map<std::pair<std::int64_t, std::int64_t>, std::size_t> index;
};

/// Of the points a + k step, k from 0 to `most`, those that lie in the box: the first k and the
/// last; none if that is less.
std::pair<double, double> within(const Eigen::AlignedBox2d& box, const Vec2& a, const Vec2& step,
                                 int most) {
  double first = 0.0, last = most;
  for (int axis = 0; axis < 2; ++axis) {
    const double low = box.min()[axis] - a[axis], high = box.max()[axis] - a[axis];
    if (step[axis] == 0.0) {
      if (low > 0.0 || high < 0.0) return {0.0, -1.0};
      continue;
    }
    first = std::max(first, std::min(low / step[axis], high / step[axis]));
    last = std::min(last, std::max(low / step[axis], high / step[axis]));
  }
  return {std::ceil(first), std::floor(last)};
}

/// Points of a triangle or, with c = b, of a side, at most a quarter of the reach apart: the first
/// corner, and those in the window or as near to it as they reach.
void cover(const std::array<Vec2, 3>& x, double reach, const Eigen::AlignedBox2d& window,
           ThinnedPlaces& places) {
  const double longest =
      std::max({(x[1] - x[0]).norm(), (x[2] - x[1]).norm(), (x[0] - x[2]).norm()});
  const int n = std::max(1, static_cast<int>(std::ceil(4.0 * longest / reach)));
  const bool is_side = x[1] == x[2];
  Eigen::AlignedBox2d near = window;
  const Vec2 beyond = Vec2::Constant(1.5 * reach); // with the whole cells of places that reach it
  if (!near.isEmpty()) near = {near.min() - beyond, near.max() + beyond};
  places.add(x[0], reach);
  const Eigen::AlignedBox2d piece(x[0].cwiseMin(x[1]).cwiseMin(x[2]),
                                  x[0].cwiseMax(x[1]).cwiseMax(x[2]));
  if (!near.isEmpty() && !near.intersects(piece)) return;
  for (int i = 0; i <= n; ++i) {
    const int most = is_side ? 0 : i;
    double first = 0.0, last = most;
    if (!near.isEmpty())
      std::tie(first, last) =
          within(near, x[0] + (x[1] - x[0]) * (double(i) / n), (x[2] - x[1]) / n, most);
    if (!(first <= last)) continue; // only else both are from 0 to most
    for (int j = static_cast<int>(first); j <= static_cast<int>(last); ++j)
      places.add(x[0] + (x[1] - x[0]) * (double(i - j) / n) + (x[2] - x[0]) * (double(j) / n),
                 reach);
  }
}

} // namespace

std::vector<ToolPlace> tight_places(const Tool& tool, const ToolZoneRule& rule) {
  if (std::holds_alternative<Plane>(tool.shape)) return {};
  const double tightest = smallest_rounding(tool.shape), diagonal = diagonal_of(tool.shape, 0.0);
  const double twice = std::isfinite(tightest) ? 2.0 * tightest : 0.0;
  const double below = rule.below_radius.value_or(std::max(twice, 0.1 * diagonal));
  const auto reach = [&rule](double radius) {
    return std::max(rule.distance.value_or(2.0 * std::max(radius, rule.element_size)),
                    0.1 * rule.element_size); // less is no part of an element
  };
  const double least_reach = reach(std::min(tightest, below));
  const TriMesh surface = tessellate(tool.shape, diagonal / 60.0, diagonal);
  const TightSurface tight{surface, mesh_curvature(surface).radius, below};
  const std::map<SurfaceSide, double> sides = tight_sides(tight);

  const auto plan = [&](std::int32_t node) {
    return Vec2((tool.position + tool.rotation * surface.x[at(node)]).head<2>());
  };
  ThinnedPlaces places(0.25 * least_reach);
  for (const auto& [side, radius] : sides)
    cover({plan(side.first), plan(side.second), plan(side.second)}, reach(radius), rule.window,
          places);
  for (const Triangle& t : surface.triangles)
    if (const std::optional<double> radius = rounding_of(tight, sides, t))
      cover({plan(t[0]), plan(t[1]), plan(t[2])}, reach(*radius), rule.window, places);
  return places.all;
}

MeshZone seen_from_blank(MeshZone zone, const Ply& ply) {
  const Eigen::Rotation2Dd back(-ply.rotation);
  for (ToolPlace& place : zone.places)
    place.at = back * (place.at - ply.seed);
  return zone;
}

} // namespace plyform
