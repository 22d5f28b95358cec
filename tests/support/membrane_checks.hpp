// SPDX-License-Identifier: GPL-3.0-or-later
// Small membranes in random states, for tests.
#pragma once

#include "core/ply/membrane.hpp"

#include <cmath>
#include <initializer_list>
#include <numbers>
#include <random>

namespace plyform {

/// The paper's glass plain weave (Hamila and Boisse 2008, table 1).
inline Fabric glass_weave() {
  Fabric f = woven_fabric();
  f.name = "glass";
  f.families[0].tension.stiffness = 46000.0;
  f.families[1].tension.stiffness = 48000.0;
  f.families[0].density = f.families[1].density = 0.25;
  f.crossings[0].shear.k = {0.37044, 0.84105, 1.03113};
  f.surface_density = 6e-10;
  f.thickness = 0.6;
  return f;
}

/// The weave with a law of shear that is stiffer where the angle closes: by polynomials.
inline Fabric two_sided_weave() {
  Fabric f = glass_weave();
  f.crossings[0].shear.negative_k = {0.037, 0.084, 0.103};
  return f;
}

/// The same by a table; or one whose other side does not resist at all.
inline Fabric two_sided_table(bool nothing_below = false) {
  Fabric f = glass_weave();
  ShearLaw& law = f.crossings[0].shear;
  law.k.clear();
  law.angle = {-0.9, -0.4, -0.15, 0.0, 0.1, 0.2, 0.35, 0.6, 0.9, 1.1};
  law.torque = {-0.12, -0.05, -0.03, 0.0, 0.05, 0.08, 0.2, 0.5, 1.5, 4.0};
  if (nothing_below)
    for (std::size_t i = 0; i < 3; ++i)
      law.torque[i] = 0.0;
  return f;
}

/// Yarns of glass in one direction at 20 degrees to the ply's angle, in a sheet.
inline Fabric unidirectional() {
  Fabric f;
  f.families.resize(1);
  f.families[0].name = "tow";
  f.families[0].angle = 0.35;
  f.families[0].density = 0.5;
  f.families[0].tension.stiffness = 46000.0;
  f.sheet = IsotropicLaw{3.0, 0.2};
  f.surface_density = 5e-10;
  f.thickness = 0.5;
  return f;
}

/// Three families at 60 degrees to each other that all cross.
inline Fabric triaxial() {
  Fabric f = glass_weave();
  f.families[1].angle = std::numbers::pi / 3.0;
  f.families.push_back(f.families[0]);
  f.families[2].name = "third";
  f.families[2].angle = 2.0 * std::numbers::pi / 3.0;
  f.families[2].tension.compression = 400.0;
  f.crossings.push_back({0, 2, {{0.2, 0.5}, {}, {}}});
  f.crossings.push_back({2, 1, {{}, {0.0, 0.3, 0.9}, {0.0, 0.1, 1.2}}});
  return f;
}

/// Warp and weft with crimp, one of which bears compression; `table`: one by a table.
inline Fabric crimped_weave(bool table) {
  Fabric f = glass_weave();
  f.families[1].tension.compression = 300.0;
  f.families[1].density = 0.2;
  f.crossings[0].crimp = CrimpedCell{{5.0, 4.0}, {0.004, 0.02}};
  if (!table) return f;
  f.families[0].tension.strain = {0.0, 0.002, 0.01};
  f.families[0].tension.tension = {0.0, 20.0, 400.0};
  f.families[1].tension.buckling_force = 4.0;
  return f;
}

/// Three families of which the last two make crimped cells.
inline Fabric crimped_triaxial() {
  Fabric f = triaxial();
  f.crossings[2].crimp = CrimpedCell{{4.6, 4.6}, {0.01, 0.003}};
  return f;
}

/// Two families at 80 degrees without a crossing, a third between that is soft, in a sheet.
inline Fabric stitched() {
  Fabric f = glass_weave();
  f.families[1].angle = 1.4;
  f.families.push_back(f.families[0]);
  f.families[2].name = "stitch";
  f.families[2].angle = 0.6;
  f.families[2].tension.stiffness = 20.0;
  f.crossings.clear();
  f.sheet = IsotropicLaw{2.0, 0.3};
  return f;
}

/// A biaxial fabric of yarns at +-45 degrees to the ply's angle, held together by stitches: none.
inline Fabric biaxial() {
  Fabric f = glass_weave();
  f.families[0].angle = -0.25 * std::numbers::pi;
  f.families[1].angle = 0.25 * std::numbers::pi;
  return f;
}

/// Stitches in one direction (rad).
inline Stitch stitch_at(double angle, double stiffness, double taut_at = 0.0) {
  Stitch s;
  s.name = "stitch";
  s.angle = angle;
  s.density = 0.2;
  s.law.tension.stiffness = stiffness;
  s.law.taut_at = taut_at;
  return s;
}

/// It with stitches of all kinds: a pillar that is taut, a zigzag with a table that is slack and
/// pulls, all so stiff that they matter beside yarns.
inline Fabric non_crimp(bool zigzag = true) {
  Fabric f = biaxial();
  f.families[1].tension.compression = 400.0;
  f.stitches = {stitch_at(0.0, 3000.0)};
  if (!zigzag) return f;
  Stitch leg = stitch_at(0.6, 0.0, 0.02);
  leg.law.tension.strain = {0.0, 0.05, 0.2}, leg.law.tension.tension = {0.0, 90.0, 900.0};
  f.stitches.push_back(leg);
  leg.angle = -0.6, leg.law.taut_at = -0.03;
  f.stitches.push_back(leg);
  return f;
}

/// It with stitches that break one after the other.
inline Fabric breaking(bool zigzag) {
  Fabric f = non_crimp(zigzag);
  for (Stitch& s : f.stitches)
    s.law.breaking_force = 250.0;
  return f;
}

/// A sheet without yarns.
inline Fabric foil() {
  Fabric f;
  f.sheet = IsotropicLaw{20.0, 0.3};
  f.surface_density = 1e-10;
  f.thickness = 0.1;
  return f;
}

/// A sheet of rubber.
inline Fabric rubber() {
  Fabric f;
  f.sheet = MooneyRivlinLaw{0.3, 0.1};
  f.surface_density = 1.65e-9;
  f.thickness = 1.5;
  return f;
}

/// Viscosity (N s per yarn) of the families, in their order.
inline void set_viscosity(Membrane& m, std::initializer_list<double> eta) {
  auto family = m.families.begin();
  for (const double of : eta)
    if (family != m.families.end()) (family++)->viscosity = of;
}

/// Rectangle about the origin, meshed.
inline BlankSpec rectangle(double width, double height, double size,
                           MeshKind kind = MeshKind::diagonal) {
  BlankSpec spec;
  const double a = 0.5 * width, b = 0.5 * height;
  spec.outline.boundary = {{-a, -b}, {a, -b}, {a, b}, {-a, b}};
  spec.mesh = kind;
  spec.element_size = size;
  return spec;
}

using Random = std::mt19937_64;

/// Between -1 and 1.
inline double signed_unit(Random& random) {
  return std::uniform_real_distribution<double>(-1.0, 1.0)(random);
}

inline Vec3 random_vector(Random& random) {
  const double x = signed_unit(random), y = signed_unit(random);
  return {x, y, signed_unit(random)};
}

inline Eigen::Matrix3d random_rotation(Random& random) {
  const Vec3 axis = random_vector(random).normalized();
  return Eigen::AngleAxisd(std::numbers::pi * signed_unit(random), axis).toRotationMatrix();
}

/// 3 x 3 cells of 10 mm whose nodes are moved at random: no side runs along a fibre.
inline BlankMesh irregular_mesh(Random& random) {
  BlankMesh mesh = mesh_blank(rectangle(30.0, 30.0, 10.0), 0.0, 0.5 * std::numbers::pi);
  for (Vec2& p : mesh.x)
    p += 2.0 * Vec2(signed_unit(random), signed_unit(random));
  return mesh;
}

/// The mesh in space: stretched to `stretch` on the whole, sheared, wavy, turned.
inline std::vector<Vec3> random_state(const BlankMesh& mesh, double stretch, double noise,
                                      Random& random) {
  Eigen::Matrix2d f = stretch * Eigen::Matrix2d::Identity();
  for (int i = 0; i < 4; ++i)
    f(i / 2, i % 2) += 0.2 * stretch * signed_unit(random);
  const Eigen::Matrix3d turn = random_rotation(random);
  std::vector<Vec3> x;
  for (const Vec2& p : mesh.x) {
    const Vec2 q = f * p;
    x.push_back(turn *
                (Vec3(q.x(), q.y(), 0.01 * q.squaredNorm()) + noise * random_vector(random)));
  }
  return x;
}

/// From these states of yarns.
inline std::vector<Vec3> nodal_forces(const Membrane& m, const std::vector<Vec3>& x, double dt,
                                      std::vector<YarnMemory> states) {
  std::vector<ElementForce> q(m.triangles.size());
  element_forces(m, x, dt, 0, m.groups(), {states, states}, q);
  std::vector<Vec3> f;
  for (std::size_t n = 0; n < x.size(); ++n)
    f.push_back(node_force(m, q, static_cast<int>(n)));
  return f;
}

/// From the state at the start.
inline std::vector<Vec3> nodal_forces(const Membrane& m, const std::vector<Vec3>& x,
                                      double dt = 0.0) {
  return nodal_forces(m, x, dt, memory_at_start(m));
}

inline double largest_norm(const std::vector<Vec3>& vectors) {
  double largest = 0.0;
  for (const Vec3& v : vectors)
    if (!(v.norm() <= largest) && !std::isnan(largest)) largest = v.norm(); // NaN stays
  return largest;
}

inline double energy_of(const Membrane& m, const std::vector<Vec3>& x) {
  const MembraneEnergy e = membrane_energy(m, x);
  return e.fibre + e.shear + e.stitch;
}

/// Largest difference between the forces and minus the central difference of the energy, over the
/// largest force.
inline double gradient_error(Membrane& m, std::vector<Vec3> x) {
  constexpr double h =
      1e-4; // mm: 1e-5 of a side; cut-off and rounding both below 1e-9 of the force
  const std::vector<Vec3> force = nodal_forces(m, x);
  std::vector<Vec3> difference;
  for (std::size_t n = 0; n < x.size(); ++n) {
    Vec3 gradient;
    for (int i = 0; i < 3; ++i) {
      const double old = x[n][i];
      x[n][i] = old + h;
      const double above = energy_of(m, x);
      x[n][i] = old - h;
      gradient[i] = (above - energy_of(m, x)) / (2.0 * h);
      x[n][i] = old;
    }
    difference.emplace_back(force[n] + gradient);
  }
  return largest_norm(difference) / largest_norm(force);
}

} // namespace plyform
