// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/forces/edge_edge.hpp"

#include <cmath>
#include <limits>

namespace plyform {
namespace {

const Vec3& at(std::span<const Vec3> x, int n) {
  return x[n];
}

/// Closest points of the lines through two segments; inside: whether they lie inside both segments.
struct SegmentDistance {
  double s, t;
  bool inside;
  Vec3 across; ///< y_a - y_b
  Vec3 normal; ///< (x2 - x1) x (x4 - x3)
  bool parallel;
};

SegmentDistance segment_distance(const Vec3& x1, const Vec3& x2, const Vec3& x3, const Vec3& x4) {
  const Vec3 u = x2 - x1, v = x4 - x3, w = x1 - x3;
  const double uu = u.squaredNorm(), vv = v.squaredNorm(), uv = u.dot(v);
  const double det = uu * vv - uv * uv;
  SegmentDistance d{};
  d.normal = u.cross(v);
  d.parallel = !(det > 1e-4 * uu * vv); // within 0.6 degrees; node-to-face contact resolves these
  if (d.parallel) return d;
  d.s = (uv * v.dot(w) - vv * u.dot(w)) / det;
  d.t = (uu * v.dot(w) - uv * u.dot(w)) / det;
  d.inside = d.s > 0.0 && d.s < 1.0 && d.t > 0.0 && d.t < 1.0;
  d.across = w + d.s * u - d.t * v;
  return d;
}

double distance_to_segment(const Vec3& p, const Vec3& from, const Vec3& to) {
  const Vec3 along = to - from;
  const double t = std::clamp((p - from).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (p - from - t * along).norm();
}

double edge_area(const SurfaceKinematics& sheet, const EdgeNodes& e) {
  return 0.5 * (sheet.area[e.a] + sheet.area[e.b]);
}

/// Updates side, s, t and distance of a pair. Returns the unit normal from b to a; if the closest
/// points are not inside both edges, sets the distance to `far` (mm) and returns zero.
Vec3 measure(EdgePair& pair, const SurfaceKinematics& a, const SurfaceKinematics& b, double far) {
  const SegmentDistance d =
      segment_distance(at(a.x, pair.a.a), at(a.x, pair.a.b), at(b.x, pair.b.a), at(b.x, pair.b.b));
  pair.distance = far;
  if (d.parallel || !d.inside) {
    // Edges can only cross while both closest points are interior. Otherwise they may pass each
    // other's ends, and the cross product changes sign when they pass through parallel: the side is
    // reset.
    pair.side = 0;
    return Vec3::Zero();
  }
  const double along = d.normal.dot(d.across);
  const int side = along > 0.0 ? 1 : -1;
  if (pair.side == 0) pair.side = side;
  pair.s = d.s;
  pair.t = d.t;
  pair.distance = pair.side * side * d.across.norm();
  return pair.side * d.normal.normalized();
}

/// mm, EdgePair::distance of a pair whose closest points are not inside both edges.
double far_of(const EdgeEdgeContact& contact) {
  return 2.0 * contact.distance;
}

/// Pairs with a smaller gap than this (mm) are measured at every step, so that the stable time step
/// knows them before they touch.
constexpr double always_measured = 0.05;

/// Updates the active pairs. Pairs that stay active keep their state.
void renew_pairs(EdgeGroup& group, const EdgeSheet& a, const EdgeSheet& b, double far) {
  if (!update(group.list, group.path_length, [](std::int32_t) {})) return;
  const std::vector<EdgePair> old = std::move(group.pairs);
  group.pairs.clear();
  std::size_t known = 0;
  for (const std::int32_t i : group.list.active) {
    const auto& edge = group.candidates[i];
    while (known < old.size() && old[known].edge < edge)
      ++known;
    if (known < old.size() && old[known].edge == edge) {
      group.pairs.push_back(old[known]);
      continue;
    }
    const SheetEdge &of_a = a.edges.all[edge[0]], &of_b = b.edges.all[edge[1]];
    EdgePair pair{edge, {of_a.a, of_a.b}, {of_b.a, of_b.b}};
    pair.area = std::min(edge_area(a.state, pair.a), edge_area(b.state, pair.b));
    pair.distance = far;
    group.pairs.push_back(pair);
  }
}

/// Adds the forces of a closed pair, p deep, that has deepened by dp in this step, both mm. n: unit
/// normal from b to a; touched: whether it was closed at the step before.
void press(EdgeEdgeContact& contact, const EdgePair& pair, const Vec3& n, double p, double dp,
           bool touched, double dt, std::span<Vec3> force_a, std::span<Vec3> force_b) {
  ContactTotals& sums = contact.sums;
  const NormalForce force = normal_force(contact.law, pair.area, p, touched ? dp : 0.0, dt);
  sums.damping += force.damping * dp;
  const Vec3 f = force.total * n;
  const auto add = [](std::span<Vec3> to, int node, const Vec3& share) { to[node] += share; };
  add(force_a, pair.a.a, (1.0 - pair.s) * f);
  add(force_a, pair.a.b, pair.s * f);
  add(force_b, pair.b.a, (pair.t - 1.0) * f);
  add(force_b, pair.b.b, -pair.t * f);
  sums.elastic += pair.area * contact.law.energy(p);
  sums.penetration = std::max(sums.penetration, p);
  ++sums.touching;
}

/// Measures the pairs of a group that may touch, and adds the forces of those that do.
void group_forces(EdgeEdgeContact& contact, EdgeGroup& group, const SurfaceKinematics& a,
                  const SurfaceKinematics& b, double dt, std::span<Vec3> force_a,
                  std::span<Vec3> force_b) {
  const double now = group.path_length, soon = now + std::max(group.list.ahead, always_measured);
  for (std::size_t i = 0; i < group.pairs.size(); ++i) {
    double& free_until = group.list.free_until[group.list.active[i]];
    if (free_until > soon) continue;
    EdgePair& pair = group.pairs[i];
    const bool followed = pair.side != 0;
    const double last = pair.distance;
    const Vec3 n = measure(pair, a, b, far_of(contact));
    const double p = contact.distance - pair.distance, dp = last - pair.distance;
    if (followed && pair.side != 0)
      contact.sums.step_ratio = std::min(contact.sums.step_ratio, step_ratio(contact.law, p, dp));
    if (p > 0.0) {
      press(contact, pair, n, p, dp, last < contact.distance, dt, force_a, force_b);
      continue;
    }
    if (last < contact.distance) continue;
    free_until = now + edge_distance(pair.a, a.x, pair.b, b.x) - contact.distance;
    if (free_until > soon) pair.side = 0; // unmeasured until then, the edges may pass each other
  }
}

} // namespace

double edge_distance(const EdgeNodes& edge_a, std::span<const Vec3> a, const EdgeNodes& edge_b,
                     std::span<const Vec3> b) {
  const Vec3 &x1 = at(a, edge_a.a), &x2 = at(a, edge_a.b);
  const Vec3 &x3 = at(b, edge_b.a), &x4 = at(b, edge_b.b);
  const SegmentDistance d = segment_distance(x1, x2, x3, x4);
  if (d.parallel)
    return std::min({distance_to_segment(x1, x3, x4), distance_to_segment(x2, x3, x4),
                     distance_to_segment(x3, x1, x2), distance_to_segment(x4, x1, x2)});
  if (d.inside) return d.across.norm();
  // The closest points of the lines lie outside one segment or both. Those of the segments are then
  // an end of such a segment and the point of the other segment closest to it (Ericson, Real-Time
  // Collision Detection, 5.1.9).
  double distance = std::numeric_limits<double>::max();
  if (d.s <= 0.0 || d.s >= 1.0) distance = distance_to_segment(d.s <= 0.0 ? x1 : x2, x3, x4);
  if (d.t <= 0.0 || d.t >= 1.0)
    distance = std::min(distance, distance_to_segment(d.t <= 0.0 ? x3 : x4, x1, x2));
  return distance;
}

void edge_forces(EdgeEdgeContact& contact, const EdgeSheet& a, const EdgeSheet& b, double dt,
                 std::span<Vec3> force_a, std::span<Vec3> force_b) {
  const Stopwatch watch(contact.time.forces);
  clear_present(contact.sums);
  for (EdgeGroup& group : contact.groups) {
    group.path_length +=
        relative_motion(a.patch_motion[group.patch[0]], b.patch_motion[group.patch[1]]);
    renew_pairs(group, a, b, far_of(contact));
    group_forces(contact, group, a.state, b.state, dt, force_a, force_b);
  }
  contact.sums.deepest = std::max(contact.sums.deepest, contact.sums.penetration);
}

void add_edge_stiffness(const EdgeEdgeContact& contact, double margin, std::span<ContactRow> rows_a,
                        std::span<ContactRow> rows_b) {
  for_each_pair(contact, [&](const EdgePair& pair) {
    if (!within(contact, pair, margin)) return;
    const ContactRow row = 2.0 * pair.area * row_of(contact.law, contact.distance - pair.distance);
    rows_a[pair.a.a] += (1.0 - pair.s) * row;
    rows_a[pair.a.b] += pair.s * row;
    rows_b[pair.b.a] += (1.0 - pair.t) * row;
    rows_b[pair.b.b] += pair.t * row;
  });
}

} // namespace plyform
