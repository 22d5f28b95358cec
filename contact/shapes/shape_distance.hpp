// SPDX-License-Identifier: GPL-3.0-or-later
// Internal to contact/: signed distances of all shapes, one overload per shape. distance_of(shape)
// returns a function of the point (mm, tool frame) and its hint; what does not depend on the point
// is computed once, when that function is made.
//
// A box of half edges h (in two dimensions: the section of a cylinder or ring) with edges rounded
// by radius e, at u = |p| componentwise, q = u - (h - e):
//   s = |max(q, 0)| + min(max_i q_i, 0) - e                                        (1)
// Gradient: max(q, 0) normalised outside of the inner box, the axis of the largest q_i inside.
// (1) is exact inside too. The rounded box is the set of points within e of the inner box h - e:
// a point at distance r <= e from the inner box therefore lies e - r below the surface, and from a
// point in the inner box the nearest point of the surface is on a flat face, as for a sharp box.
//
// A prism: d the distance to its section, e = |y| - length/2 that to its ends:
//   s = |max((d, e), 0)| + min(max(d, e), 0)                                       (2)
#pragma once

#include "contact/shapes/mesh_shape.hpp"
#include "contact/shapes/profile.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plyform {

template <int N>
struct BoxPoint {
  double distance;
  Eigen::Matrix<double, N, 1> normal;
};

/// (1) with gradient, p from the centre, in N dimensions.
template <int N>
[[gnu::always_inline]] inline BoxPoint<N> rounded_box(const Eigen::Matrix<double, N, 1>& p,
                                                      const Eigen::Matrix<double, N, 1>& half,
                                                      double e) {
  Eigen::Matrix<double, N, 1> n, q;
  int deepest = 0, outside = 0;
  double s = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < N; ++i) {
    q[i] = std::abs(p[i]) - half[i] + e;
    if (q[i] > s) deepest = i;
    s = std::max(s, q[i]);
    outside += q[i] > 0.0 ? 1 : 0;
  }
  for (int i = 0; i < N; ++i)
    n[i] = i == deepest ? 1.0 : 0.0;
  if (outside > 1) { // nearest to an edge
    n = q.cwiseMax(0.0);
    s = n.norm();
    n /= s;
  }
  for (int i = 0; i < N; ++i)
    n[i] = std::copysign(n[i], p[i]);
  return {s - e, n};
}

/// A section in (r, z) turned about z.
template <class Section>
[[gnu::always_inline]] inline SurfacePoint revolved(const Vec3& p, const Section& section) {
  const double r = std::sqrt(p.x() * p.x() + p.y() * p.y());
  const auto [s, n] = section(Vec2(r, p.z()));
  if (!(r > 0.0)) return {s, Vec3(n.x(), 0.0, n.y())}; // on the axis: towards +x
  const double by = n.x() / r;
  return {s, Vec3(by * p.x(), by * p.y(), n.y())};
}

/// (2): a section in (x, z) drawn out along y, with sharp ends at |y| = length/2.
template <class Section>
[[gnu::always_inline]] inline SurfacePoint extruded(const Vec3& p, double length,
                                                    const Section& section) {
  const auto [d, n] = section(Vec2(p.x(), p.z()));
  const double e = std::abs(p.y()) - 0.5 * length;
  if (d > 0.0 && e > 0.0) {
    const double s = std::sqrt(d * d + e * e);
    return {s, Vec3(d * n.x(), std::copysign(e, p.y()), d * n.y()) / s};
  }
  if (d >= e) return {d, Vec3(n.x(), 0.0, n.y())};
  return {e, Vec3(0.0, std::copysign(1.0, p.y()), 0.0)};
}

/// Centre, half edges and edge radius (mm) of a ring's section. That of a disc extends through the
/// axis to r < 0.
struct RingSection {
  Vec2 centre, half;
  double edge;
};

inline RingSection section_of(const Annulus& a) {
  const bool disc = a.inner_radius <= 0.0;
  const Vec2 centre(disc ? 0.0 : 0.5 * (a.inner_radius + a.outer_radius), 0.5 * a.thickness);
  const Vec2 half(a.outer_radius - centre.x(), 0.5 * a.thickness);
  return {centre, half, std::min(a.edge_radius, half.minCoeff())};
}

/// Edge radius (mm) of a cylinder's rims and of a box's edges, limited to what fits.
inline double edge_of(const Cylinder& c) {
  return std::min({c.edge_radius, c.radius, 0.5 * c.length});
}
inline double edge_of(const Box& b) {
  return std::min(b.edge_radius, 0.5 * b.size.minCoeff());
}

inline auto distance_of(const Sphere& sphere) {
  return [radius = sphere.radius](const Vec3& p, SurfaceHint&) -> SurfacePoint {
    const double d = p.norm();
    return {d - radius, d > 0.0 ? Vec3(p / d) : Vec3::UnitZ()};
  };
}

inline auto distance_of(const Cylinder& c) {
  return [half = Vec2(c.radius, 0.5 * c.length), edge = edge_of(c)](const Vec3& p, SurfaceHint&) {
    return revolved(p, [&](const Vec2& q) { return rounded_box<2>(q, half, edge); });
  };
}

inline auto distance_of(const Box& box) {
  return [half = Vec3(0.5 * box.size), edge = edge_of(box)](const Vec3& p,
                                                            SurfaceHint&) -> SurfacePoint {
    const auto [s, n] = rounded_box<3>(p, half, edge);
    return {s, n};
  };
}

inline auto distance_of(const Plane&) {
  return [](const Vec3& p, SurfaceHint&) -> SurfacePoint { return {p.z(), Vec3::UnitZ()}; };
}

inline auto distance_of(const Annulus& a) {
  return [ring = section_of(a)](const Vec3& p, SurfaceHint&) {
    return revolved(
        p, [&](const Vec2& q) { return rounded_box<2>(q - ring.centre, ring.half, ring.edge); });
  };
}

inline auto distance_of(const RevolvedProfile& profile) {
  return [section = SectionField(profile.segments)](const Vec3& p, SurfaceHint&) {
    return revolved(p, [&](const Vec2& q) { return section.distance(q); });
  };
}

inline auto distance_of(const ExtrudedProfile& profile) {
  return [section = SectionField(profile.segments), length = profile.length](const Vec3& p,
                                                                             SurfaceHint&) {
    return extruded(p, length, [&](const Vec2& q) { return section.distance(q); });
  };
}

inline auto distance_of(const MeshShapePtr& mesh) {
  return [&mesh](const Vec3& p, SurfaceHint& hint) { return mesh->signed_distance(p, hint); };
}

} // namespace plyform
