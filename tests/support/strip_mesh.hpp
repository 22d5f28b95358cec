// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes of the strip of a bias-extension test: along its yarns or not, even or shaken.
#pragma once

#include "support/membrane_checks.hpp"

#include <algorithm>

namespace plyform {

/// The strip of the test, meshed: cells (or a free mesh) turned by `turn` (rad) from the strip, and
/// inner nodes moved by up to `noise` times the size along x and y.
struct StripMesh {
  MeshKind kind = MeshKind::fibres;
  double size = 5.0, turn = 0.0, noise = 0.0; ///< mm, rad, -
};

inline double twice_area(const BlankMesh& mesh, int triangle) {
  const Triangle& t = mesh.triangles[triangle];
  const auto at = [&](std::size_t k) { return mesh.x[t[k]]; };
  const Vec2 a = at(1) - at(0), b = at(2) - at(0);
  return a.x() * b.y() - a.y() * b.x();
}

/// Moves inner nodes at random, less where a triangle would become a sliver.
inline void shake(BlankMesh& mesh, double most, const std::vector<char>& touches_boundary_edge) {
  Random random(7);
  std::vector<std::vector<int>> around(mesh.x.size());
  for (std::size_t e = 0; e < mesh.triangles.size(); ++e)
    for (const int n : mesh.triangles[e])
      around[n].push_back(static_cast<int>(e));
  for (std::size_t n = 0; n < mesh.x.size(); ++n) {
    const double dx = most * signed_unit(random), dy = most * signed_unit(random);
    if (touches_boundary_edge[n]) continue;
    const Vec2 before = mesh.x[n];
    std::vector<double> area;
    for (const int e : around[n])
      area.push_back(twice_area(mesh, e));
    for (double share = 1.0; share > 0.1; share *= 0.5) {
      mesh.x[n] = before + share * Vec2(dx, dy);
      bool valid = true;
      for (std::size_t i = 0; i < area.size(); ++i)
        valid = valid && twice_area(mesh, around[n][i]) > 0.2 * area[i];
      if (valid) break;
      mesh.x[n] = before;
    }
  }
}

inline BlankMesh strip_mesh(const StripMesh& spec, double length, double width) {
  BlankSpec blank = rectangle(length, width, spec.size, spec.kind);
  const bool free = spec.kind == MeshKind::free;
  const Eigen::Rotation2Dd turn(spec.turn);
  if (free) // meshed in its turned place: another mesh for every angle
    for (Vec2& p : blank.outline.boundary)
      p = turn * p;
  BlankMesh mesh = mesh_blank(blank, spec.turn, spec.turn + 0.5 * std::numbers::pi);
  std::vector<char> touches_boundary_edge;
  for (Vec2& p : mesh.x) {
    if (free) p = turn.inverse() * p;
    touches_boundary_edge.push_back(std::abs(std::abs(p.x()) - 0.5 * length) < 1e-9 * length ||
                                    std::abs(std::abs(p.y()) - 0.5 * width) < 1e-9 * length);
  }
  shake(mesh, spec.noise * spec.size, touches_boundary_edge);
  return mesh;
}

} // namespace plyform
