// SPDX-License-Identifier: GPL-3.0-or-later
// Two wavy sheets that lie on each other, one turned against the other's mesh.
#pragma once

#include "contact/forces/ply_ply.hpp"
#include "tests/bench/machine.hpp"

#include <cmath>
#include <numbers>

namespace plyform {

constexpr double bench_thickness = 0.6; ///< mm

struct BenchSheet {
  std::vector<Vec3> x;
  std::vector<Triangle> triangles;
  std::vector<double> area; ///< mm^2, a third of the triangles around a node
  std::vector<Vec3> still;  ///< no motion
  SurfaceKinematics state() const { return {x, still, area, {}}; }
};

/// cells x cells squares of side `cell` (mm), turned by `turn` (rad), at `height` (mm) along the
/// normal above z = a sin(k x) sin(k y): waves of 250 mm, slopes up to a quarter.
inline BenchSheet wavy_sheet(int cells, double cell, double turn, double height) {
  constexpr double k = 2.0 * std::numbers::pi / 250.0, a = 10.0;
  BenchSheet s;
  for (int j = 0; j <= cells; ++j)
    for (int i = 0; i <= cells; ++i) {
      const Vec2 p =
          Eigen::Rotation2Dd(turn) * Vec2(cell * (i - 0.5 * cells), cell * (j - 0.5 * cells));
      const double sx = std::sin(k * p.x()), sy = std::sin(k * p.y());
      const double cx = std::cos(k * p.x()), cy = std::cos(k * p.y());
      const Vec3 normal = Vec3(-a * k * cx * sy, -a * k * sx * cy, 1.0).normalized();
      s.x.push_back(Vec3(p.x(), p.y(), a * sx * sy) + height * normal);
    }
  for (int j = 0; j < cells; ++j)
    for (int i = 0; i < cells; ++i) {
      const int n = j * (cells + 1) + i;
      s.triangles.push_back({n, n + 1, n + cells + 2});
      s.triangles.push_back({n, n + cells + 2, n + cells + 1});
    }
  s.area.assign(s.x.size(), cell * cell);
  s.still.assign(s.x.size(), Vec3::Zero());
  return s;
}

/// One pass of ply_ply_forces, each array once; faces of points whose foot is lost are not counted.
inline Traffic sheet_traffic(const PlyPlyContact& c, std::size_t slave_nodes,
                             std::size_t master_nodes) {
  Traffic t = traffic(c.list.active.size(), sizeof(PlyPlyPoint), 2.0); // read and written
  t += traffic(c.list.active.size(), sizeof(std::int32_t) + sizeof(Triangle));
  const std::size_t nodes = slave_nodes + master_nodes;
  t += traffic(nodes, 2 * sizeof(Vec3));  // place, motion
  t += traffic(nodes, sizeof(Vec3), 3.0); // force: set to zero, then read and written
  return t;
}

} // namespace plyform
