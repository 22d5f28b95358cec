// SPDX-License-Identifier: GPL-3.0-or-later
// What the stress table is made of: extreme fabrics, bad meshes, and what a membrane in a uniform
// state must answer.
#pragma once

#include "support/membrane_checks.hpp"

#include <filesystem>
#include <fstream>
#include <iomanip>
#include <map>
#include <string>

namespace plyform {

struct NamedFabric {
  std::string name;
  Fabric fabric = woven_fabric();
};

/// The glass weave, and what it becomes at the edges of the table.
inline std::vector<NamedFabric> extreme_fabrics() {
  std::vector<NamedFabric> all(7, {"glass", glass_weave()});
  all[1].name = "warp 100 times the weft";
  all[1].fabric.families[1].tension.stiffness = 0.01 * all[1].fabric.families[0].tension.stiffness;
  all[2].name = "yarns at 60 degrees";
  all[2].fabric.families[1].angle = 60.0 * degree;
  all[3].name = "yarns at 120 degrees";
  all[3].fabric.families[1].angle = 120.0 * degree;
  all[4].name = "no shear stiffness";
  all[4].fabric.crossings[0].shear.k = {0.0};
  all[5].name = "yarns 100 times as stiff";
  all[5].fabric.families[0].tension.stiffness *= 100.0;
  all[5].fabric.families[1].tension.stiffness *= 100.0;
  all[6].name = "yarns that bear compression";
  all[6].fabric.families[0].tension.compression = 4600.0;
  all[6].fabric.families[1].tension.compression = 480.0;
  return all;
}

/// Square about the origin in nx by ny cells, one diagonal each.
inline BlankMesh stretched_cells(double side, int nx, int ny) {
  BlankMesh mesh = mesh_blank(rectangle(nx, ny, 1.0), 0.0, 0.5 * std::numbers::pi);
  for (Vec2& p : mesh.x)
    p = Vec2(p.x() * side / nx, p.y() * side / ny);
  return mesh;
}

/// Square cells whose two diagonals meet close to the lower side: every fourth triangle has angles
/// of 5, 5 and 170 degrees.
inline BlankMesh slivers(double side, int cells) {
  const double h = side / cells;
  BlankMesh mesh = mesh_blank(rectangle(side, side, h, MeshKind::crossed), 0.0, 1.0);
  for (std::size_t n = static_cast<std::size_t>((cells + 1) * (cells + 1)); n < mesh.x.size(); ++n)
    mesh.x[n].y() -= 0.5 * h * (1.0 - std::tan(5.0 * degree));
  return mesh;
}

/// Smallest angle of any triangle, degrees.
inline double smallest_angle(const BlankMesh& mesh) {
  double smallest = 180.0;
  for (const Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2& a = mesh.x[t[k]];
      const Vec2 u = (mesh.x[t[(k + 1) % 3]] - a).normalized();
      const Vec2 v = (mesh.x[t[(k + 2) % 3]] - a).normalized();
      smallest = std::min(smallest, std::acos(u.dot(v)) / degree);
    }
  return smallest;
}

/// A blank with just that mesh, by way of a file.
inline BlankSpec blank_of(const BlankMesh& mesh, const std::filesystem::path& file) {
  std::ofstream out(file);
  out << std::setprecision(17);
  for (const Vec2& p : mesh.x)
    out << "v " << p.x() << " " << p.y() << " 0\n";
  for (const Triangle& t : mesh.triangles)
    out << "f " << t[0] + 1 << " " << t[1] + 1 << " " << t[2] + 1 << "\n";
  BlankSpec spec;
  spec.mesh = MeshKind::file;
  spec.file = file;
  return spec;
}

/// Stretches of the yarns and angle between them (rad), warp along `along` (rad).
struct YarnState {
  double lambda1, lambda2, omega, along;
};

/// The linear map that brings yarns from `warp_angle` into a state.
inline Eigen::Matrix2d map_to(const YarnState& s, double warp_angle, double omega0) {
  const auto unit = [](double a) { return Vec2(std::cos(a), std::sin(a)); };
  Eigen::Matrix2d before, after;
  before << unit(warp_angle), unit(warp_angle + omega0);
  after << s.lambda1 * unit(s.along), s.lambda2 * unit(s.along + s.omega);
  return after * before.inverse();
}

/// Energies per unformed area (N/mm) and nominal stress P (N/mm): traction on the unformed normal n
/// is P n. By the chain rule in the plane: the angle of k turns by (k rotated by 90 degrees)/k^2.
struct UniformAnswer {
  double fibre = 0.0, shear = 0.0;
  Eigen::Matrix2d stress = Eigen::Matrix2d::Zero();
};

inline UniformAnswer uniform_answer(const Fabric& f, double warp_angle, const YarnState& s) {
  UniformAnswer a;
  const double cells =
      f.families[0].density * f.families[1].density * std::sin(f.families[1].angle);
  const LawPoint shear = f.crossings[0].shear.at(f.families[1].angle - s.omega);
  a.shear = cells * shear.energy;
  Eigen::Matrix2d before, force; // columns: warp, weft
  for (int i = 0; i < 2; ++i) {
    const TensionLaw& law = i == 0 ? f.families[0].tension : f.families[1].tension;
    const double d = i == 0 ? f.families[0].density : f.families[1].density;
    const double lambda = i == 0 ? s.lambda1 : s.lambda2;
    const double at0 = warp_angle + i * f.families[1].angle, at = s.along + i * s.omega;
    const LawPoint yarn = law.at(lambda - 1.0);
    const double folded = std::max(0.0, 0.5 - lambda),
                 collapse_penalty = 1e-3 * law.stiffness; // g_a of (E)
    a.fibre += d * (yarn.energy + 0.5 * collapse_penalty * folded * folded);
    const Vec2 along(std::cos(at), std::sin(at)), across(-along.y(), along.x());
    before.col(i) = Vec2(std::cos(at0), std::sin(at0));
    force.col(i) = d * (yarn.value - collapse_penalty * folded) * along +
                   (i == 0 ? 1.0 : -1.0) * cells * shear.value / lambda * across;
  }
  a.stress = force * before.transpose(); // dw = force_a . dk_a, k_a = F before_a
  return a;
}

/// Half of the boundary's length times its outward normal, gathered at the nodes: what a uniform
/// stress pulls at. Zero inside.
inline std::vector<Vec2> outward(const BlankMesh& mesh) {
  std::map<std::pair<int, int>, int> sides; // directed side -> times
  for (const Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      ++sides[{t[k], t[(k + 1) % 3]}];
  std::vector<Vec2> sum(mesh.x.size(), Vec2::Zero());
  for (const auto& [side, times] : sides) {
    if (sides.contains({side.second, side.first})) continue;
    const auto a = static_cast<std::size_t>(side.first), b = static_cast<std::size_t>(side.second);
    const Vec2 way = mesh.x[b] - mesh.x[a], half(0.5 * way.y(), -0.5 * way.x());
    sum[a] += half;
    sum[b] += half;
  }
  return sum;
}

} // namespace plyform
