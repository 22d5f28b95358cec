// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/forces/sliding_point.hpp"

#include "contact/search/sheet_edges.hpp"
#include "contact/simd/ply_ply_kernel.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace plyform {
namespace {

/// The way from a point to the rim of the master.
struct ToRim {
  double distance = 0.0;       ///< phi, mm, present; below 0 outside
  Vec3 outward = Vec3::Zero(); ///< unit vector in the face; 0 where no rim is nearer than others
  double next = 0.0;           ///< L, mm
  std::int32_t node = -1;      ///< of the slave, there
};

/// By the distances from the rim before forming, which are linear over the face.
ToRim to_rim(const PlyPlyPoint& point, const SurfaceKinematics& slave,
             const SurfaceKinematics& master, const Triangle& t) {
  const Vec3 &a = at(master.x, t[0]), b = at(master.x, t[1]) - a, c = at(master.x, t[2]) - a;
  const double first = master.rim_distance[t[0]];
  const double to_b = master.rim_distance[t[1]] - first, to_c = master.rim_distance[t[2]] - first;
  const Vec3 across = b.cross(c);
  const Vec3 inward = (to_b * c.cross(across) + to_c * across.cross(b)) / across.squaredNorm();
  const double rise = inward.norm(); // 1 where nothing has stretched
  if (!(rise > 0.0)) return {};
  ToRim rim;
  rim.outward = -inward / rise;
  const Vec3 foot = a + point.w[0] * b + point.w[1] * c;
  const double beyond = (at(slave.x, point.node) - foot).dot(rim.outward); // of one that is outside
  rim.distance = (first + point.w[0] * to_b + point.w[1] * to_c) / rise - std::max(beyond, 0.0);
  return rim;
}

/// Whether the rim may be before the next node: of the others a ply covers all.
bool is_near_rim(const PlyPlyPoint& point, const SurfaceKinematics& slave,
                 const SurfaceKinematics& master, const Triangle& t) {
  constexpr double cells = 4.0; // roots of a node's area, at a corner a quarter of a cell
  const std::span<const double> rim = master.rim_distance;
  return std::min({rim[t[0]], rim[t[1]], rim[t[2]]}) < cells * std::sqrt(slave.area[point.node]);
}

/// Finds how far the slave's mesh reaches from each point's node towards the rim. first: the number
/// of each node's first point.
void find_next(const SurfaceKinematics& slave, std::span<const std::size_t> first,
               std::vector<ToRim>& rims) {
  const auto reach = [&](std::int32_t from, std::int32_t to) {
    for (std::size_t i = first[from]; i < first[from + 1]; ++i) {
      const double way = rims[i].outward.dot(at(slave.x, to) - at(slave.x, from));
      if (way > rims[i].next) rims[i].next = way, rims[i].node = to;
    }
  };
  for (const SheetEdge& edge : slave.edges)
    reach(edge.a, edge.b), reach(edge.b, edge.a);
}

/// The ways of all points to the rim, and whether the rim is before the next node.
struct Rims {
  std::vector<ToRim> of;
  std::vector<std::size_t> first; ///< point of each node

  /// outside: mm, how far from the rim a node beyond it is still covered.
  Rims(const PlyPlyContact& contact, const SurfaceKinematics& slave,
       const SurfaceKinematics& master, std::span<const Triangle> triangles, double outside)
      : of(contact.points.size()), first(slave.x.size() + 1, 0), furthest_(-outside) {
    if (master.rim_distance.empty()) return;
    for (std::size_t i = 0; i < of.size(); ++i) {
      const PlyPlyPoint& c = contact.points[i];
      if (is_near_rim(c, slave, master, triangles[c.face]))
        of[i] = to_rim(c, slave, master, triangles[c.face]);
      ++first[c.node + 1];
    }
    std::partial_sum(first.begin(), first.end(), first.begin());
    find_next(slave, first, of);
  }

  bool covers(std::int32_t node) const {
    for (std::size_t i = first[node]; i < first[node + 1]; ++i)
      if (of[i].distance >= furthest_) return true;
    return false;
  }

  /// Whether the next node of point i lies on the master, too: the rim runs along, or not there.
  bool goes_on(std::size_t i) const {
    const ToRim& rim = of[i];
    if (rim.node < 0) return false;
    for (std::size_t k = first[rim.node]; k < first[rim.node + 1]; ++k)
      if (of[k].distance >= -ends * rim.next) return true;
    return false;
  }

  /// Of the area `own` (mm^2) of the node of point i, what the master covers.
  double share(std::size_t i, double own) const {
    const ToRim& rim = of[i];
    if (!(rim.next > ends * std::sqrt(own))) return 1.0;
    const double left = std::clamp(rim.distance / rim.next, -0.5, 1.0);
    const bool next_is_outside = left < 1.0 && !covers(rim.node);
    const double beyond = next_is_outside ? std::max(left - 0.5, 0.0) : 0.0;
    return std::min(left + 0.5, 1.0) + beyond;
  }

private:
  static constexpr double ends = 0.1; // of an element, below which the slave's mesh ends there, too
  double furthest_;                   ///< mm
};

} // namespace

double contact_area(const SurfaceKinematics& slave, const SurfaceKinematics& master,
                    const PlyPlyPoint& point, const Triangle& face) {
  const std::array<double, 3> w = weights_of(point);
  double master_area = 0.0; // at the closest point: does not depend on which of two faces is taken
  for (std::size_t j = 0; j < 3; ++j)
    master_area += w[j] * master.area[face[j]];
  return std::min(slave.area[point.node], master_area);
}

void renew_film_areas(PlyPlyContact& contact, const SurfaceKinematics& slave,
                      const SurfaceKinematics& master, std::span<const Triangle> triangles) {
  // of the master's nodal area, the most that presses on one
  constexpr double finer = 4.0, least_share = 1e-3;
  const double h = contact.distance, film = contact.law.sliding_gap;
  const Rims rims(contact, slave, master, triangles,
                  std::sqrt(film * (2.0 * h + film))); // what still touches the rim from outside
  for (std::size_t i = 0; i < rims.of.size(); ++i) {
    PlyPlyPoint& c = contact.points[i];
    const double own = slave.area[c.node], share = rims.share(i, own);
    const double before = c.area, most = finer * contact_area(slave, master, c, triangles[c.face]);
    c.area = std::min(std::max(share, least_share) * own, most);
    s_of(c.memory) *= before / c.area;
  }
}

std::vector<Cover> covers_of(const PlyPlyContact& contact, const SurfaceKinematics& slave,
                             const SurfaceKinematics& master, std::span<const Triangle> triangles) {
  const Rims rims(contact, slave, master, triangles, std::numeric_limits<double>::infinity());
  std::vector<Cover> covers;
  covers.reserve(contact.points.size());
  for (std::size_t i = 0; i < contact.points.size(); ++i) {
    const PlyPlyPoint& c = contact.points[i];
    Cover& cover = covers.emplace_back();
    cover.share = rims.goes_on(i) ? 1.0 : rims.share(i, slave.area[c.node]);
    if (!(rims.of[i].distance < 0.0)) continue;
    const Triangle& t = triangles[c.face];
    const Vec3& a = at(master.x, t[0]);
    const Vec3 normal = (at(master.x, t[1]) - a).cross(at(master.x, t[2]) - a).normalized();
    cover.height = std::abs(normal.dot(at(slave.x, c.node) - a));
  }
  return covers;
}

double by_angle(const FrictionLaw& law, const PlyPlyPoint& point, const SurfaceKinematics& slave,
                const SurfaceKinematics& master, std::span<const Triangle> triangles) {
  if (slave.fibres.empty() || master.fibres.empty()) return 1.0;
  const std::array<double, 3> w = weights_of(point);
  const Triangle& t = triangles[static_cast<std::size_t>(point.face)];
  Vec3 other = Vec3::Zero();
  for (std::size_t j = 0; j < 3; ++j)
    other += w[j] * at(master.fibres, t[j]);
  const Vec3& own = at(slave.fibres, point.node);
  const double size = own.norm() * other.norm();
  if (!(size > 0.0)) return 1.0;
  return law.by_angle(std::acos(std::min(std::abs(own.dot(other)) / size, 1.0)));
}

} // namespace plyform
