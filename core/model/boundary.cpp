// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/model/boundary.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

constexpr double on_line = 1e-4; // mm: rounding of coordinates given with some digits

bool near_segment(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 d = b - a;
  const double s = std::clamp((p - a).dot(d) / d.squaredNorm(), 0.0, 1.0);
  return (p - a - s * d).norm() <= on_line;
}

bool in_box(const Vec2& p, const std::array<Vec2, 2>& corners) {
  const Vec2 low = corners[0].cwiseMin(corners[1]), high = corners[0].cwiseMax(corners[1]);
  return ((p - low).array() >= -on_line).all() && ((high - p).array() >= -on_line).all();
}

/// Bars u = P0 P1 and v = P0 P3 at displacement d, and their slopes.
struct Bars {
  Vec2 u, v, du, dv;
};

Bars bars_at(const Boundary& frame, double d) {
  const auto& p = frame.hinges;
  const Vec2 diagonal = p[2] - p[0], e = diagonal.normalized(), across(-e.y(), e.x());
  const double a = (p[1] - p[0]).norm(), b = (p[2] - p[1]).norm();
  const double D = diagonal.norm() + d, side = across.dot(p[1] - p[0]) < 0.0 ? -1.0 : 1.0;
  const double c = (a * a + D * D - b * b) / (2.0 * a * D); // cosine of the angle from e to u
  const double s = side * std::sqrt(std::max(0.0, 1.0 - c * c));
  const double dc = 1.0 / a - c / D, ds = -c * dc / s;
  Bars bars;
  bars.u = a * (c * e + s * across);
  bars.du = a * (dc * e + ds * across);
  bars.v = D * e - bars.u;
  bars.dv = e - bars.du;
  return bars;
}

/// X = P0 + s (P1 - P0) + t (P3 - P0)
Vec2 frame_coordinates(const Boundary& frame, const Vec2& X) {
  Eigen::Matrix2d sides;
  sides << frame.hinges[1] - frame.hinges[0], frame.hinges[3] - frame.hinges[0];
  return sides.inverse() * (X - frame.hinges[0]);
}

/// Adds the part of `axis` that is orthogonal to the axes already prescribed.
void hold_axis(PrescribedNode& node, Vec3 axis, int boundary) {
  for (int i = 0; i < node.count; ++i) {
    const Vec3& taken = node.axis[i];
    axis -= axis.dot(taken) * taken;
  }
  constexpr double nothing_new = 1e-9;
  if (node.count == 3 || axis.norm() < nothing_new) return;
  node.axis[node.count] = axis.normalized();
  node.boundary[node.count++] = boundary;
}

void hold_by(PrescribedNode& node, const Boundary& boundary, int index) {
  if (boundary.kind == BoundaryKind::symmetry)
    return hold_axis(node, {boundary.normal.x(), boundary.normal.y(), 0.0}, index);
  for (int k = 0; k < 3; ++k)
    if (boundary.kind == BoundaryKind::frame || boundary.held[k])
      hold_axis(node, Vec3::Unit(k), index);
}

} // namespace

bool holds(const Boundary& b, int ply, const Vec2& X) {
  if (b.ply >= 0 && b.ply != ply) return false;
  switch (b.kind) {
  case BoundaryKind::grip:
  case BoundaryKind::spring:
  case BoundaryKind::gripper:
    return b.on_edge ? near_segment(X, b.place[0], b.place[1]) : in_box(X, b.place);
  case BoundaryKind::frame:
    for (std::size_t i = 0; i < 4; ++i)
      if (near_segment(X, b.hinges[i], b.hinges[(i + 1) % 4])) return true;
    return false;
  case BoundaryKind::symmetry:
    return std::abs((X - b.point).dot(b.normal)) <= on_line;
  }
  return false;
}

Vec3 prescribed_position(const Boundary& b, const Vec3& X, double d) {
  if (b.kind == BoundaryKind::grip || b.kind == BoundaryKind::gripper) return X + d * b.direction;
  if (b.kind != BoundaryKind::frame || d == 0.0) return X;
  const Vec2 st = frame_coordinates(b, X.head<2>());
  const Bars bars = bars_at(b, d);
  Vec3 x = X;
  x.head<2>() = b.hinges[0] + st.x() * bars.u + st.y() * bars.v;
  return x;
}

Vec3 prescribed_slope(const Boundary& b, const Vec3& X, double d) {
  if (b.kind == BoundaryKind::grip || b.kind == BoundaryKind::gripper) return b.direction;
  Vec3 slope = Vec3::Zero();
  if (b.kind != BoundaryKind::frame) return slope;
  const Vec2 st = frame_coordinates(b, X.head<2>());
  const Bars bars = bars_at(b, d);
  slope.head<2>() = st.x() * bars.du + st.y() * bars.dv;
  return slope;
}

double longest_stroke(const Boundary& frame) {
  const auto& p = frame.hinges;
  return (p[1] - p[0]).norm() + (p[2] - p[1]).norm() - (p[2] - p[0]).norm();
}

std::vector<PrescribedNode> prescribed_nodes(const std::vector<Boundary>& boundaries, int ply,
                                             std::span<const Vec3> x0) {
  std::vector<PrescribedNode> held;
  const auto by = [&](BoundaryKind kind, const Vec3& X) {
    return std::any_of(boundaries.begin(), boundaries.end(), [&](const Boundary& b) {
      return b.kind == kind && holds(b, ply, X.head<2>());
    });
  };
  for (std::size_t n = 0; n < x0.size(); ++n) {
    if (by(BoundaryKind::gripper, x0[n])) continue;
    PrescribedNode node{ply, static_cast<int>(n)};
    for (const bool planes : {false, true})
      for (std::size_t b = 0; b < boundaries.size(); ++b)
        if (prescribes(boundaries[b]) && (boundaries[b].kind == BoundaryKind::symmetry) == planes &&
            holds(boundaries[b], ply, x0[n].head<2>()))
          hold_by(node, boundaries[b], static_cast<int>(b));
    if (node.count > 0) held.push_back(node);
  }
  return held;
}

} // namespace plyform
