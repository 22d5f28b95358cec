// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/forces/edge_edge.hpp"

#include "base/cpu_features.hpp"

#include <cmath>
#include <limits>

namespace plyform {
namespace {

/// Closest points of the lines through two segments; inside: whether they lie inside both segments.
struct SegmentDistance {
  double s, t;
  bool inside;
  Vec3 across; ///< y_a - y_b
  bool parallel;
};

SegmentDistance segment_distance(const Vec3& x1, const Vec3& x2, const Vec3& x3, const Vec3& x4) {
  const Vec3 u = x2 - x1, v = x4 - x3, w = x1 - x3;
  const double uu = u.squaredNorm(), vv = v.squaredNorm(), uv = u.dot(v);
  const double det = uu * vv - uv * uv;
  SegmentDistance d{};
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

/// mm, EdgePair::distance of a pair whose closest points are not inside both edges.
double far_of(const EdgeEdgeContact& contact) {
  return 2.0 * contact.distance;
}

/// Pairs with a smaller gap than this, of the contact's distance, are measured at every step, so
/// that the stable time step knows them before they touch: 0.05 mm between plies of 0.6 mm.
double always_measured(const EdgeEdgeContact& contact) {
  return 0.05 * (contact.distance / 0.3);
}

/// Appends those of the candidates first to end - 1 that may touch within this path length (mm, of
/// their group), and returns the smallest free_until of the others.
float append_due(std::span<const EdgeCandidate> candidates, std::int32_t first, std::int32_t end,
                 double path_length, std::int32_t group,
                 std::vector<std::array<std::int32_t, 2>>& due) {
  const float soon = rounded_down(path_length); // no float is between the two
  float others = std::numeric_limits<float>::infinity();
  for (std::int32_t i = first; i < end; ++i) {
    for (; i < end && candidates[i].free_until > soon; ++i) // most of them
      others = std::min(others, candidates[i].free_until);
    if (i < end) due.push_back({i, group});
  }
  return others;
}

/// Moves the groups on by their patches' motion in this step, and lists the candidates that may
/// touch soon, or within two steps like this one, so that their closing speed is known by then.
void list_due(EdgeEdgeContact& contact, const EdgeSheet& a, const EdgeSheet& b) {
  EdgeMeasurements& m = contact.measurements;
  m.due.clear();
  for (std::size_t g = 0; g < contact.groups.size(); ++g) {
    EdgeGroup& group = contact.groups[g];
    const double moved =
        relative_motion(a.patch_motion[group.patch[0]], b.patch_motion[group.patch[1]]);
    group.path_length += moved;
    group.ahead = std::max(2.0 * moved, always_measured(contact));
    const double soon = group.path_length + group.ahead;
    if (group.free_until > soon) continue;
    group.free_until = append_due(contact.candidates, group.first, group.end, soon,
                                  static_cast<std::int32_t>(g), m.due);
  }
  m.nodes.clear();
  for (const auto& [candidate, group] : m.due) {
    const auto& [one, other] = contact.candidates[candidate].edge;
    const SheetEdge &of_a = a.edges.all[one], &of_b = b.edges.all[other];
    m.nodes.push_back({of_a.a, of_a.b, of_b.a, of_b.b});
  }
}

/// The pair of a candidate: as it was in the last step, if it was measured then. next: number in
/// measurements.last of the first that may be it.
EdgePair pair_of(const EdgeMeasurements& m, std::size_t due, std::size_t& next, const EdgeSheet& a,
                 const EdgeSheet& b, double far) {
  const std::int32_t candidate = m.due[due][0];
  while (next < m.last.size() && m.last[next].candidate < candidate)
    ++next;
  if (next < m.last.size() && m.last[next].candidate == candidate) return m.last[next];
  const auto& n = m.nodes[due];
  EdgePair pair{candidate, {n[0], n[1]}, {n[2], n[3]}};
  pair.area = std::min(edge_area(a.state, pair.a), edge_area(b.state, pair.b));
  pair.distance = far;
  return pair;
}

/// Updates side, s, t and distance of a pair; the distance is `far` (mm) if its closest points are
/// not inside both edges.
void update_pair(EdgePair& pair, const EdgeEdgeDistance& now, double far) {
  if (now.side == 0) {
    // Edges can only cross while both closest points are interior. Otherwise they may pass each
    // other's ends, and the cross product changes sign when they pass through parallel: the side is
    // reset.
    pair.side = 0;
    pair.distance = far;
    return;
  }
  const int side = static_cast<int>(now.side);
  if (pair.side == 0) pair.side = side;
  pair.s = now.s;
  pair.t = now.t;
  pair.distance = pair.side * side * now.distance;
}

/// The unit normal of a pair from b to a.
Vec3 normal_of(const EdgePair& pair, std::span<const Vec3> a, std::span<const Vec3> b) {
  const Vec3 along_a = at(a, pair.a.b) - at(a, pair.a.a);
  const Vec3 along_b = at(b, pair.b.b) - at(b, pair.b.a);
  return pair.side * along_a.cross(along_b).normalized();
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

void measure_edges(std::span<const std::array<std::int32_t, 4>> nodes, std::span<const Vec3> a,
                   std::span<const Vec3> b, std::vector<EdgeEdgeDistance>& distances) {
  distances.resize(nodes.size());
  if (nodes.empty()) return;
  const auto run =
      fastest(edge_edge_kernel_generic, edge_edge_kernel_avx2, edge_edge_kernel_avx512);
  run({nodes.data()->data(), static_cast<int>(nodes.size()), a.data()->data(), b.data()->data()},
      distances.data());
}

void edge_forces(EdgeEdgeContact& contact, const EdgeSheet& a, const EdgeSheet& b, double dt,
                 std::span<Vec3> force_a, std::span<Vec3> force_b) {
  const Stopwatch watch(contact.time.forces);
  clear_present(contact.sums);
  list_due(contact, a, b);
  EdgeMeasurements& m = contact.measurements;
  measure_edges(m.nodes, a.state.x, b.state.x, m.distances);
  std::swap(contact.pairs, m.last);
  contact.pairs.clear();
  const double far = far_of(contact);
  std::size_t next = 0;
  for (std::size_t i = 0; i < m.due.size(); ++i) {
    EdgePair pair = pair_of(m, i, next, a, b, far);
    EdgeGroup& group = contact.groups[m.due[i][1]];
    EdgeCandidate& candidate = contact.candidates[pair.candidate];
    const bool followed = pair.side != 0;
    const double last = pair.distance;
    update_pair(pair, m.distances[i], far);
    const double p = contact.distance - pair.distance, dp = last - pair.distance;
    if (followed && pair.side != 0)
      contact.sums.step_ratio = std::min(contact.sums.step_ratio, step_ratio(contact.law, p, dp));
    if (p > 0.0)
      press(contact, pair, normal_of(pair, a.state.x, b.state.x), p, dp, last < contact.distance,
            dt, force_a, force_b);
    else if (!(last < contact.distance)) // it has been open for a step
      candidate.free_until =
          rounded_down(group.path_length + m.distances[i].distance - contact.distance);
    group.free_until = std::min(group.free_until, double{candidate.free_until});
    // unmeasured from then on, the edges may pass each other: a pair that is left forgets its side
    if (!(candidate.free_until > group.path_length + group.ahead)) contact.pairs.push_back(pair);
  }
  contact.sums.deepest = std::max(contact.sums.deepest, contact.sums.penetration);
}

void add_edge_stiffness(const EdgeEdgeContact& contact, double margin, std::span<ContactRow> rows_a,
                        std::span<ContactRow> rows_b) {
  for (const EdgePair& pair : contact.pairs) {
    if (!within(contact, pair, margin)) continue;
    const ContactRow row =
        2.0 * pair.area * row_of(contact.law, pair.distance - contact.distance, 1.0);
    rows_a[pair.a.a] += (1.0 - pair.s) * row;
    rows_a[pair.a.b] += pair.s * row;
    rows_b[pair.b.a] += (1.0 - pair.t) * row;
    rows_b[pair.b.b] += pair.t * row;
  }
}

} // namespace plyform
