// SPDX-License-Identifier: GPL-3.0-or-later
// Closed-form signed distances of the primitives, and what holds for every shape.
//
// A box of half edges h (in two dimensions: the section of a cylinder or ring) with edges rounded
// by radius e, asked at u = |p| componentwise, q = u - (h - e):
//   s = |max(q, 0)| + min(max_i q_i, 0) - e                                        (1)
// Gradient: max(q, 0) normalised outside of the inner box, the axis of the largest q_i inside.
#include "contact/tool_shape.hpp"

#include "contact/mesh_shape.hpp"
#include "contact/profile.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plyform {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

template <int N>
struct BoxPoint {
  double distance;
  Eigen::Matrix<double, N, 1> normal;
};

/// (1) with gradient, p from the centre, in N dimensions.
template <int N>
BoxPoint<N> rounded_box(const Eigen::Matrix<double, N, 1>& p,
                        const Eigen::Matrix<double, N, 1>& half, double e) {
  const Eigen::Matrix<double, N, 1> q = (p.cwiseAbs() - half).array() + e;
  int deepest = 0;
  const double largest = q.maxCoeff(&deepest);
  Eigen::Matrix<double, N, 1> n = Eigen::Matrix<double, N, 1>::Zero();
  double s = largest;
  n[deepest] = 1.0;
  if ((q.array() > 0.0).count() > 1) { // nearest to an edge
    const Eigen::Matrix<double, N, 1> outside = q.cwiseMax(0.0);
    s = outside.norm();
    n = outside / s;
  }
  for (int i = 0; i < N; ++i)
    if (p[i] < 0.0) n[i] = -n[i];
  return {s - e, n};
}

/// A section in (r, z) turned about z.
template <class Section>
SurfacePoint revolved(const Vec3& p, Section section) {
  const double r = std::sqrt(p.x() * p.x() + p.y() * p.y());
  const auto [s, n] = section(Vec2(r, p.z()));
  const Vec2 out = radial_direction(p, r);
  return {s, Vec3(n.x() * out.x(), n.x() * out.y(), n.y())};
}

/// Centre, half edges and edge radius of a ring's section. A disc's goes on through the axis.
struct RingSection {
  Vec2 centre, half;
  double edge;
};

RingSection section_of(const Annulus& a) {
  const bool disc = a.inner_radius <= 0.0;
  const Vec2 centre(disc ? 0.0 : 0.5 * (a.inner_radius + a.outer_radius), 0.5 * a.thickness);
  const Vec2 half(a.outer_radius - centre.x(), 0.5 * a.thickness);
  return {centre, half, std::min(a.edge_radius, half.minCoeff())};
}

SurfacePoint distance_to(const Sphere& s, const Vec3& p, int&) {
  const double d = p.norm();
  return {d - s.radius, d > 0.0 ? Vec3(p / d) : Vec3::UnitZ()};
}

SurfacePoint distance_to(const Cylinder& c, const Vec3& p, int&) {
  return revolved(p, [&](const Vec2& q) {
    return rounded_box<2>(q, {c.radius, 0.5 * c.length}, 0.0);
  });
}

SurfacePoint distance_to(const Box& b, const Vec3& p, int&) {
  const auto [s, n] = rounded_box<3>(p, 0.5 * b.size, 0.0);
  return {s, n};
}

SurfacePoint distance_to(const Plane&, const Vec3& p, int&) {
  return {p.z(), Vec3::UnitZ()};
}

SurfacePoint distance_to(const Annulus& a, const Vec3& p, int&) {
  const RingSection s = section_of(a);
  return revolved(p, [&](const Vec2& q) { return rounded_box<2>(q - s.centre, s.half, s.edge); });
}

SurfacePoint distance_to(const RevolvedProfile& profile, const Vec3& p, int&) {
  return revolved(p, [&](const Vec2& q) { return section_distance(profile, q); });
}

SurfacePoint distance_to(const MeshShapePtr& mesh, const Vec3& p, int& hint) {
  return mesh->signed_distance(p, hint);
}

Box3 upright(double r, double z0, double z1) {
  return {Vec3(-r, -r, z0), Vec3(r, r, z1)};
}

Box3 bounds(const Sphere& s) {
  return upright(s.radius, -s.radius, s.radius);
}
Box3 bounds(const Cylinder& c) {
  return upright(c.radius, -0.5 * c.length, 0.5 * c.length);
}
Box3 bounds(const Box& b) {
  return {-0.5 * b.size, 0.5 * b.size};
}
Box3 bounds(const Plane&) {
  return {Vec3(-infinity, -infinity, -infinity), Vec3(infinity, infinity, 0.0)};
}
Box3 bounds(const Annulus& a) {
  return upright(a.outer_radius, 0.0, a.thickness);
}
Box3 bounds(const MeshShapePtr& mesh) {
  return mesh->bounds();
}

double gap_between(const Box3& a, const Box3& b) {
  return (a.min() - b.max()).cwiseMax(b.min() - a.max()).cwiseMax(0.0).norm();
}

double smallest(const Sphere& s) {
  return s.radius;
}
double smallest(const Cylinder&) {
  return 0.0;
}
double smallest(const Box&) {
  return 0.0;
}
double smallest(const Plane&) {
  return infinity;
}
double smallest(const Annulus& a) {
  return section_of(a).edge;
}
double smallest(const MeshShapePtr&) {
  return infinity;
}

/// Arcs, and 0 where the material ends in an edge: a turn to the right, or a tip on the axis.
/// Inner corners do not count: a sheet bridges them.
double smallest(const RevolvedProfile& profile) {
  constexpr double straight = 1e-6; // rad, above the rounding of tangents
  const auto& s = profile.segments;
  double radius = infinity;
  for (std::size_t i = 0; i < s.size(); ++i) {
    if (s[i].kind == ProfileSegment::Kind::arc)
      radius = std::min(radius, (s[i].a - s[i].centre).norm());
    if (i + 1 == s.size() && !is_ring(profile)) break;
    const Vec2 t = tangent(s[i], 1), next = tangent(s[(i + 1) % s.size()], 0);
    if (t.x() * next.y() - t.y() * next.x() < -straight) return 0.0;
  }
  if (is_ring(profile)) return radius;
  // Walking away from the axis downwards, or towards it downwards: a cone's tip.
  const Vec2 t0 = tangent(s.front(), 0), t1 = tangent(s.back(), 1);
  if (s.front().a.x() <= 0.0 && t0.x() * t0.y() < -straight) return 0.0;
  if (s.back().b.x() <= 0.0 && t1.x() * t1.y() > straight) return 0.0;
  return radius;
}

} // namespace

SurfacePoint signed_distance(const ToolShape& shape, const Vec3& p, int& hint) {
  return std::visit([&](const auto& s) { return distance_to(s, p, hint); }, shape);
}

double distance_lower_bound(const ToolShape& shape, const Box3& box) {
  int hint = -1;
  // The distance changes by no more than the way.
  const double at_centre = signed_distance(shape, box.center(), hint).distance;
  const double bound = at_centre - 0.5 * box.diagonal().norm();
  if (at_centre <= 0.0) return bound;
  const double gap = std::visit([&](const auto& s) { return gap_between(bounds(s), box); }, shape);
  return gap > 0.0 ? std::max(bound, gap) : bound;
}

double smallest_radius(const ToolShape& shape) {
  return std::visit([](const auto& s) { return smallest(s); }, shape);
}

} // namespace plyform
