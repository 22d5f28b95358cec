// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/edge_contact.hpp"

#include <cmath>
#include <limits>
#include <map>

namespace plyform {
namespace {

constexpr double least_sag = 0.4; // thicknesses: two sheets, each below it, cannot reach each other

const Vec3& at(std::span<const Vec3> x, int n) {
  return x[static_cast<std::size_t>(n)];
}

Vec3 face_normal(const Triangle& t, std::span<const Vec3> x) {
  return (at(x, t[1]) - at(x, t[0])).cross(at(x, t[2]) - at(x, t[0]));
}

Box3 edge_box(const SheetEdge& e, std::span<const Vec3> x, double inflate) {
  Box3 box(at(x, e.a).cwiseMin(at(x, e.b)), at(x, e.a).cwiseMax(at(x, e.b)));
  box.min().array() -= inflate;
  box.max().array() += inflate;
  return box;
}

/// Closest points of the lines' segments; inside: whether they lie inside both.
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
  d.parallel = !(det > 1e-4 * uu * vv); // within half a degree: the nodes see each other
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

/// mm, of two edges wherever their closest points are.
double distance_of(const EdgePair& pair, const SheetState& a, const SheetState& b) {
  const Vec3 &x1 = at(a.x, pair.a.a), &x2 = at(a.x, pair.a.b);
  const Vec3 &x3 = at(b.x, pair.b.a), &x4 = at(b.x, pair.b.b);
  const SegmentDistance d = segment_distance(x1, x2, x3, x4);
  if (d.parallel)
    return std::min({distance_to_segment(x1, x3, x4), distance_to_segment(x2, x3, x4),
                     distance_to_segment(x3, x1, x2), distance_to_segment(x4, x1, x2)});
  if (d.inside) return d.across.norm();
  // Where the lines are closest is outside one segment or both. The closest points are then an end
  // of a segment that is passed and what is closest to it on the other (Ericson, Real-Time
  // Collision Detection, 5.1.9).
  double distance = std::numeric_limits<double>::max();
  if (d.s <= 0.0 || d.s >= 1.0) distance = distance_to_segment(d.s <= 0.0 ? x1 : x2, x3, x4);
  if (d.t <= 0.0 || d.t >= 1.0)
    distance = std::min(distance, distance_to_segment(d.t <= 0.0 ? x3 : x4, x1, x2));
  return distance;
}

double edge_area(const SheetState& sheet, const SheetEdge& e) {
  return 0.5 *
         (sheet.area[static_cast<std::size_t>(e.a)] + sheet.area[static_cast<std::size_t>(e.b)]);
}

/// Brings a pair up to date; returns the unit vector from b to a across the gap.
Vec3 measure(EdgePair& pair, const SheetState& a, const SheetState& b, double far) {
  const SegmentDistance d =
      segment_distance(at(a.x, pair.a.a), at(a.x, pair.a.b), at(b.x, pair.b.a), at(b.x, pair.b.b));
  pair.distance = far;
  if (d.parallel || !d.inside) {
    // Edges can only cross while both closest points are inside; outside, the ends may swap sides
    // freely (and the cross product turns over when edges pass through parallel).
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

} // namespace

std::vector<SheetEdge> sheet_edges(std::span<const Triangle> triangles) {
  std::map<std::pair<int, int>, SheetEdge> open;
  std::vector<SheetEdge> edges;
  for (std::size_t f = 0; f < triangles.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const int i = triangles[f][k], j = triangles[f][(k + 1) % 3];
      const auto key = std::minmax(i, j);
      const auto found = open.find(key);
      if (found == open.end()) {
        open[key] = {key.first, key.second, static_cast<std::int32_t>(f), -1};
      } else {
        found->second.right = static_cast<std::int32_t>(f);
        edges.push_back(found->second);
        open.erase(found);
      }
    }
  for (const auto& [key, edge] : open)
    edges.push_back(edge);
  std::sort(edges.begin(), edges.end(), [](const SheetEdge& e, const SheetEdge& g) {
    return std::pair(e.a, e.b) < std::pair(g.a, g.b);
  });
  return edges;
}

std::vector<std::int32_t> folded_edges(std::span<const SheetEdge> edges,
                                       std::span<const Triangle> triangles, std::span<const Vec3> x,
                                       double thickness) {
  std::vector<std::int32_t> folded;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const SheetEdge& e = edges[i];
    if (e.right >= 0) {
      const Vec3 n = face_normal(triangles[static_cast<std::size_t>(e.left)], x);
      const Vec3 m = face_normal(triangles[static_cast<std::size_t>(e.right)], x);
      const double cosine = n.dot(m), size = n.norm() * m.norm();
      // sag = L/2 tan(fold/2), tan^2(fold/2) = (1 - cos) / (1 + cos)
      const double length2 = (at(x, e.b) - at(x, e.a)).squaredNorm();
      const double limit = least_sag * thickness;
      if (0.25 * length2 * (size - cosine) < limit * limit * (size + cosine)) continue;
    }
    folded.push_back(static_cast<std::int32_t>(i));
  }
  return folded;
}

void find_edge_pairs(EdgeContact& contact, const SheetState& a, std::span<const SheetEdge> edges_a,
                     std::span<const std::int32_t> folded_a, const SheetState& b,
                     std::span<const SheetEdge> edges_b, std::span<const std::int32_t> folded_b,
                     double skin, double path) {
  const std::vector<EdgePair> old = std::move(contact.pairs);
  contact.pairs.clear();
  clear(contact.list);
  struct Entry {
    Box3 box;
    std::int32_t edge;
  };
  std::vector<Entry> sorted; // of b, by the lower x of its box
  double widest = 0.0;
  for (std::int32_t e : folded_b) {
    sorted.push_back({edge_box(edges_b[static_cast<std::size_t>(e)], b.x, 0.0), e});
    widest = std::max(widest, sorted.back().box.sizes().x());
  }
  std::sort(sorted.begin(), sorted.end(), [](const Entry& e, const Entry& g) {
    return std::pair(e.box.min().x(), e.edge) < std::pair(g.box.min().x(), g.edge);
  });
  const auto key = [](const EdgePair& p) { return std::array{p.a.a, p.a.b, p.b.a, p.b.b}; };
  for (std::int32_t e : folded_a) {
    const SheetEdge& edge = edges_a[static_cast<std::size_t>(e)];
    const Box3 box = edge_box(edge, a.x, contact.distance + skin);
    auto it = std::lower_bound(
        sorted.begin(), sorted.end(), box.min().x() - widest,
        [](const Entry& entry, double lower) { return entry.box.min().x() < lower; });
    for (; it != sorted.end() && it->box.min().x() <= box.max().x(); ++it)
      if (box.intersects(it->box)) {
        EdgePair pair{};
        pair.a = edge;
        pair.b = edges_b[static_cast<std::size_t>(it->edge)];
        contact.pairs.push_back(pair);
      }
  }
  for (const EdgePair& pair : old) // touching, but no longer folded
    if (pair.distance < contact.distance) contact.pairs.push_back(pair);
  std::sort(contact.pairs.begin(), contact.pairs.end(),
            [&](const EdgePair& p, const EdgePair& q) { return key(p) < key(q); });
  contact.pairs.erase(
      std::unique(contact.pairs.begin(), contact.pairs.end(),
                  [&](const EdgePair& p, const EdgePair& q) { return key(p) == key(q); }),
      contact.pairs.end());
  std::size_t known = 0, kept = 0;
  for (EdgePair pair : contact.pairs) {
    while (known < old.size() && key(old[known]) < key(pair))
      ++known;
    if (known < old.size() && key(old[known]) == key(pair))
      pair = old[known];
    else
      measure(pair, a, b, contact.distance + skin);
    const bool touches = pair.distance < contact.distance;
    const double gap = touches ? 0.0 : distance_of(pair, a, b) - contact.distance;
    if (gap > skin) continue;    // its box was in reach
    if (!touches) pair.side = 0; // taken anew when they come near
    pair.area = std::min(edge_area(a, pair.a), edge_area(b, pair.b));
    contact.list.wake.push_back(path + gap);
    contact.pairs[kept++] = pair;
  }
  contact.pairs.resize(kept);
}

void edge_forces(EdgeContact& contact, const SheetState& a, const SheetState& b, double dt,
                 double path, std::span<Vec3> force_a, std::span<Vec3> force_b) {
  const Stopwatch watch(contact.time.forces);
  ContactSums& sums = contact.sums;
  renew(contact.list, path, [&contact](std::int32_t i) { // cannot cross: its side does not matter
    contact.pairs[static_cast<std::size_t>(i)].side = 0;
  });
  sums.elastic = sums.penetration = 0.0;
  sums.touching = 0;
  for (const std::int32_t i : contact.list.near) {
    EdgePair& pair = contact.pairs[static_cast<std::size_t>(i)];
    double& wake = contact.list.wake[static_cast<std::size_t>(i)];
    if (wake > path) continue;
    const double last = pair.distance;
    const Vec3 n = measure(pair, a, b, 2.0 * contact.distance);
    const double p = contact.distance - pair.distance;
    if (!(p > 0.0)) {
      if (last < contact.distance) continue;
      wake = path + distance_of(pair, a, b) - contact.distance; // until then it may rest
      continue;
    }
    const double dp = last - pair.distance;
    const NormalForce force =
        normal_force(contact.law, pair.area, p, last < contact.distance ? dp : 0.0, dt);
    sums.damping += force.damping * dp;
    const Vec3 f = force.total * n;
    const auto add = [](std::span<Vec3> to, int node, const Vec3& share) {
      to[static_cast<std::size_t>(node)] += share;
    };
    add(force_a, pair.a.a, (1.0 - pair.s) * f);
    add(force_a, pair.a.b, pair.s * f);
    add(force_b, pair.b.a, (pair.t - 1.0) * f);
    add(force_b, pair.b.b, -pair.t * f);
    sums.elastic += 0.5 * pair.area * contact.law.stiffness * p * p;
    sums.penetration = std::max(sums.penetration, p);
    ++sums.touching;
  }
  sums.deepest = std::max(sums.deepest, sums.penetration);
}

void add_edge_stiffness(const EdgeContact& contact, double margin, std::span<double> rows_a,
                        std::span<double> rows_b) {
  for (const EdgePair& pair : contact.pairs) {
    if (pair.distance > contact.distance + margin) continue;
    const double row = 2.0 * pair.area * contact.law.stiffness;
    rows_a[static_cast<std::size_t>(pair.a.a)] += (1.0 - pair.s) * row;
    rows_a[static_cast<std::size_t>(pair.a.b)] += pair.s * row;
    rows_b[static_cast<std::size_t>(pair.b.a)] += (1.0 - pair.t) * row;
    rows_b[static_cast<std::size_t>(pair.b.b)] += pair.t * row;
  }
}

} // namespace plyform
