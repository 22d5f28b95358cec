// SPDX-License-Identifier: GPL-3.0-or-later
// Energies and work of a scene: stored energies are computed from the present state, work and
// dissipation have been accumulated step by step.
#include "core/solver/nodal_forces.hpp"
#include "core/solver/step.hpp"

namespace plyform {
namespace {

double kinetic_energy(const PlyBody& ply, double dt, double next_dt, const MassLoads& loads) {
  double sum = 0.0;
  for (std::size_t n = 0; n < ply.x.size(); ++n) {
    // From the velocities half a step before and after: their product if both steps are equal,
    // which central differences conserve; if not, without the part that is due to the difference of
    // steps.
    const Vec3 a = acceleration(ply, static_cast<int>(n), loads);
    const Vec3 now = ply.velocity[n] + 0.5 * dt * a;
    sum += 0.5 * ply.mass[n] * (now.squaredNorm() - 0.25 * dt * next_dt * a.squaredNorm());
  }
  return sum;
}

double work_of_gravity(const PlyBody& ply, const Vec3& gravity) {
  double sum = 0.0;
  if (gravity.isZero(0)) return sum;
  for (std::size_t n = 0; n < ply.x.size(); ++n)
    sum += ply.membrane.cloth_mass(n) * gravity.dot(ply.x[n] - ply.x0[n]);
  return sum;
}

} // namespace

Energies current_energies(const Scene& s, ThreadPool& pool) {
  std::vector<Energies> of_ply(s.plies.size());
  std::vector<MembraneEnergy> of_block(s.group_blocks.size());
  const int plies = static_cast<int>(s.plies.size());
  pool.run(plies + static_cast<int>(of_block.size()), [&](int i) {
    if (i >= plies) {
      const Block& block = s.group_blocks[i - plies];
      const PlyBody& ply = s.plies[block.ply];
      if (ply.simd) of_block[i - plies] = simd_energy(*ply.simd, ply.membrane, ply.x, block.begin);
      return;
    }
    const PlyBody& ply = s.plies[i];
    Energies& e = of_ply[i];
    if (!ply.simd) {
      const MembraneEnergy m = membrane_energy(ply.membrane, ply.x);
      e.fibre = m.fibre, e.shear = m.shear;
    }
    if (ply.bending) e.bending = bending_energy(*ply.bending, ply.x);
    e.kinetic = kinetic_energy(ply, s.dt, s.next_dt, mass_loads(s));
    e.external = work_of_gravity(ply, s.data.gravity);
  });
  Energies e;
  for (const MembraneEnergy& block : of_block)
    e.fibre += block.fibre, e.shear += block.shear;
  for (const Energies& ply : of_ply)
    e += ply;
  const auto add = [&e](const ContactTotals& c) {
    e.contact += c.elastic;
    e.friction += c.friction;
    e.damping += c.damping;
  };
  for (const ToolState& t : s.tools) {
    for (const ToolPlyContact& c : t.contacts)
      add(c.sums);
    e.external += t.work;
  }
  for (const BoundaryState& b : s.boundaries)
    e.external += b.work;
  for (const PlyContact& pair : s.ply_contacts)
    add(pair.contact.sums);
  for (const PlyEdgeContact& pair : s.edge_contacts)
    add(pair.contact.sums);
  for (double viscous : s.group_sums)
    e.damping += viscous;
  e.damping += s.mass_damping_work;
  e.mass_scaling = s.mass_scaling_work;
  e.external += s.start_energy;
  e.floor = s.energy_floor;
  return e;
}

} // namespace plyform
