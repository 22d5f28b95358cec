// SPDX-License-Identifier: GPL-3.0-or-later
// Plies that are held: a strip, and a square pushed by a ball that planes of symmetry may cut.
#pragma once

#include "support/scene_checks.hpp"

namespace plyform {

inline Boundary grip(const std::string& name, const Vec2& a, const Vec2& b, const Vec3& direction,
                     double stroke) {
  Grip g;
  g.place = {true, {a, b}};
  g.direction = direction;
  g.stroke = stroke;
  return {name, -1, g};
}

inline Boundary plane(const std::string& name, const Vec2& normal) {
  return {name, -1, SymmetryPlane{Vec2::Zero(), normal}};
}

/// 100 x 20 mm between x = -50 and 50, held at the left, pulled at the right.
inline Case strip(double angle, const Vec3& direction, double stroke, double size = 10.0) {
  Case data = stack_of({angle}, rectangle(100.0, 20.0, size));
  data.boundaries = {grip("left", {-50, -10}, {-50, 10}, Vec3::UnitX(), 0.0),
                     grip("right", {50, -10}, {50, 10}, direction, stroke)};
  set_friction(data, 0.0);
  data.solver.fibre_softening = 100.0;
  data.solver.duration = 0.02;
  return data;
}

/// A square of 80 mm clamped all round, or the quarter of it beyond x = 0 and y = 0, under a ball.
inline Case pushed_square(double angle, MeshKind mesh, bool quarter) {
  Case data = stack_of({angle}, rectangle(80.0, 80.0, 10.0, mesh));
  data.fabrics[0].families[1].tension =
      data.fabrics[0].families[0].tension; // balanced, for 45 degrees
  if (quarter) {
    data.blanks[0].outline.boundary = {{0, 0}, {40, 0}, {40, 40}, {0, 40}};
    data.boundaries = {plane("x0", Vec2::UnitX()), plane("y0", Vec2::UnitY())};
  }
  const Vec2 corners[] = {{-40, -40}, {40, -40}, {40, 40}, {-40, 40}};
  for (std::size_t k = quarter ? 1 : 0; k < (quarter ? 3u : 4u); ++k)
    data.boundaries.push_back(
        grip("side" + std::to_string(k), corners[k], corners[(k + 1) % 4], Vec3::UnitZ(), 0.0));
  Tool ball;
  ball.name = "ball";
  ball.shape = Sphere{25.0};
  ball.position = {0.0, 0.0, 25.6};
  ball.motion = Motion::driven;
  ball.stroke = 8.0;
  data.tools = {ball};
  set_friction(data, 0.2);
  data.gravity = {0.0, 0.0, -9810.0};
  data.solver.fibre_softening = 100.0;
  data.solver.duration = 0.02;
  return data;
}

} // namespace plyform
