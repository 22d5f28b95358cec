// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/model/boundary.hpp"

#include "core/model/mirror.hpp"

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

Bars bars_at(const HingedFrame& frame, double d) {
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
Vec2 frame_coordinates(const HingedFrame& frame, const Vec2& X) {
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
  if (const auto* plane = std::get_if<SymmetryPlane>(&boundary.kind))
    return hold_axis(node, {plane->normal.x(), plane->normal.y(), 0.0}, index);
  for (std::size_t k = 0; k < 3; ++k)
    if (boundary.is<HingedFrame>() || boundary.as<Grip>().held[k])
      hold_axis(node, Vec3::Unit(static_cast<Eigen::Index>(k)), index);
}

bool holds(const HeldPlace& place, const Vec2& X) {
  return place.on_edge ? near_segment(X, place.ends[0], place.ends[1]) : in_box(X, place.ends);
}

template <class Kind>
bool kind_holds(const Kind& kind, const Vec2& X) {
  return holds(kind.place, X);
}
bool kind_holds(const HingedFrame& frame, const Vec2& X) {
  for (std::size_t i = 0; i < 4; ++i)
    if (near_segment(X, frame.hinges[i], frame.hinges[(i + 1) % 4])) return true;
  return false;
}
bool kind_holds(const SymmetryPlane& plane, const Vec2& X) {
  return lies_on(plane, X);
}

template <class Kind>
Vec3 position(const Kind&, const Vec3& X, double) {
  return X;
}
Vec3 position(const Grip& grip, const Vec3& X, double d) {
  return X + d * grip.direction;
}
Vec3 position(const Gripper& gripper, const Vec3& X, double d) {
  return X + d * gripper.direction;
}
Vec3 position(const HingedFrame& frame, const Vec3& X, double d) {
  if (d == 0.0) return X;
  const Vec2 st = frame_coordinates(frame, X.head<2>());
  const Bars bars = bars_at(frame, d);
  Vec3 x = X;
  x.head<2>() = frame.hinges[0] + st.x() * bars.u + st.y() * bars.v;
  return x;
}

template <class Kind>
Vec3 slope(const Kind&, const Vec3&, double) {
  return Vec3::Zero();
}
Vec3 slope(const Grip& grip, const Vec3&, double) {
  return grip.direction;
}
Vec3 slope(const Gripper& gripper, const Vec3&, double) {
  return gripper.direction;
}
Vec3 slope(const HingedFrame& frame, const Vec3& X, double d) {
  const Vec2 st = frame_coordinates(frame, X.head<2>());
  const Bars bars = bars_at(frame, d);
  Vec3 slope = Vec3::Zero();
  slope.head<2>() = st.x() * bars.du + st.y() * bars.dv;
  return slope;
}

} // namespace

bool hold_by_mesh(const std::vector<Boundary>& boundaries) {
  return std::any_of(boundaries.begin(), boundaries.end(),
                     [](const Boundary& b) { return !b.is<SymmetryPlane>(); });
}

double stroke_of(const Boundary& b) {
  const auto stroke = [](const auto& kind) {
    if constexpr (requires { kind.stroke; }) return kind.stroke;
    return 0.0;
  };
  return std::visit(stroke, b.kind);
}

double force_of(const Boundary& b) {
  return b.is<Gripper>() ? b.as<Gripper>().force : 0.0;
}

std::span<const Stage> programme_of(const Boundary& b) {
  const auto programme = [](const auto& kind) -> std::span<const Stage> {
    if constexpr (requires { kind.programme; }) return kind.programme;
    return {};
  };
  return std::visit(programme, b.kind);
}

const HeldPlace* place_of(const Boundary& b) {
  const auto place = [](const auto& kind) -> const HeldPlace* {
    if constexpr (requires { kind.place; }) return &kind.place;
    return nullptr;
  };
  return std::visit(place, b.kind);
}

bool holds(const Boundary& b, int ply, const Vec2& X) {
  if (b.ply >= 0 && b.ply != ply) return false;
  return std::visit([&](const auto& kind) { return kind_holds(kind, X); }, b.kind);
}

Vec3 prescribed_position(const Boundary& b, const Vec3& X, double d) {
  return std::visit([&](const auto& kind) { return position(kind, X, d); }, b.kind);
}

Vec3 prescribed_slope(const Boundary& b, const Vec3& X, double d) {
  return std::visit([&](const auto& kind) { return slope(kind, X, d); }, b.kind);
}

double longest_stroke(const HingedFrame& frame) {
  const auto& p = frame.hinges;
  return (p[1] - p[0]).norm() + (p[2] - p[1]).norm() - (p[2] - p[0]).norm();
}

std::vector<PrescribedNode> prescribed_nodes(const std::vector<Boundary>& boundaries, int ply,
                                             std::span<const Vec3> x0) {
  std::vector<PrescribedNode> held;
  const auto by_gripper = [&](const Vec3& X) {
    return std::any_of(boundaries.begin(), boundaries.end(), [&](const Boundary& b) {
      return b.is<Gripper>() && holds(b, ply, X.head<2>());
    });
  };
  for (std::size_t n = 0; n < x0.size(); ++n) {
    if (by_gripper(x0[n])) continue;
    PrescribedNode node{ply, static_cast<int>(n)};
    for (const bool planes : {false, true})
      for (std::size_t b = 0; b < boundaries.size(); ++b)
        if (prescribes(boundaries[b]) && boundaries[b].is<SymmetryPlane>() == planes &&
            holds(boundaries[b], ply, x0[n].head<2>()))
          hold_by(node, boundaries[b], static_cast<int>(b));
    if (node.count > 0) held.push_back(node);
  }
  return held;
}

} // namespace plyform
