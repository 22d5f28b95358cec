// SPDX-License-Identifier: GPL-3.0-or-later
// Small cases in code, for tests of whole scenes.
#pragma once

#include "core/solver/scene.hpp"
#include "support/membrane_checks.hpp"

namespace plyform {

/// Plies of glass weave on top of each other, from z = 0 up, without tools.
inline Case stack_of(const std::vector<double>& angles, const BlankSpec& blank) {
  Case data;
  data.fabrics = {glass_weave()};
  data.blanks = {blank};
  for (std::size_t p = 0; p < angles.size(); ++p)
    data.plies.push_back({"ply" + std::to_string(p + 1), 0, 0, angles[p],
                          glass_weave().thickness * (static_cast<double>(p) + 0.5)});
  return data;
}

/// To be called when all plies and tools are there.
inline void set_friction(Case& data, double mu) {
  data.friction.bodies = static_cast<int>(data.plies.size() + data.tools.size());
  data.friction.mu.assign(static_cast<std::size_t>(data.friction.bodies * data.friction.bodies),
                          mu);
}

/// Puts the stack between a floor and a plate of 30 N with friction, to be at rest in 0.02 s.
inline void press_by_plate(Case& data) {
  Tool floor;
  floor.name = "floor";
  floor.shape = Plane{};
  Tool plate;
  plate.name = "plate";
  plate.shape = Box{{140.0, 140.0, 10.0}};
  const double top = glass_weave().thickness * static_cast<double>(data.plies.size());
  plate.position = {0.0, 0.0, top + 5.0};
  plate.motion = Motion::force;
  plate.force = 30.0;
  data.tools = {floor, plate};
  set_friction(data, 0.2);
  data.solver.fibre_softening = 100.0;
  data.solver.mass_damping = 2000.0; // 1/s: at rest long before the end
  data.solver.duration = 0.02;
}

/// The shipped hemisphere, coarse: 289 cells a ply, a second or so.
inline Case coarse_hemisphere(const std::vector<double>& angles) {
  Case data = stack_of(angles, rectangle(340.0, 340.0, 20.0));
  const double top = glass_weave().thickness * static_cast<double>(angles.size());
  Tool punch;
  punch.name = "punch";
  punch.shape = Sphere{75.0};
  punch.position = {0.0, 0.0, 75.0 + top};
  punch.motion = Motion::driven;
  punch.stroke = 75.0;
  Tool die;
  die.name = "die";
  die.shape = make_profile({{80.0, -120.0, 0.0}, {80.0, 0.0, 10.0}, {400.0, 0.0, 0.0}});
  Tool holder;
  holder.name = "blank_holder";
  holder.shape = Annulus{92.0, 300.0, 10.0, 0.0};
  holder.position = {0.0, 0.0, top};
  holder.motion = Motion::force;
  holder.force = 300.0;
  data.tools = {punch, die, holder};
  set_friction(data, 0.2);
  data.solver.fibre_softening = 100.0;
  return data;
}

/// Yarns that bear compression and bend, so that plies may lie in a stack.
inline void stiffen_yarns(Fabric& fabric) {
  for (YarnFamily& family : fabric.families) {
    family.tension.compression = 0.01 * family.tension.stiffness;
    family.bending.stiffness = 2.0, family.in_plane_bending = 4.0;
  }
}

/// Force along z on ply `lower` from the ply above it, N.
inline double force_from_above(const Scene& s, int lower) {
  double sum = 0.0;
  for (const PlyPair& pair : s.ply_pairs)
    if (pair.a == lower && pair.b == lower + 1)
      for (const Vec3& f : pair.force_a)
        sum += f.z();
  return sum;
}

} // namespace plyform
