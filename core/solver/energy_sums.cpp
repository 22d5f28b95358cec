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
  pool.run(static_cast<int>(of_ply.size()), [&](int p) {
    const PlyBody& ply = s.plies[at(p)];
    of_ply[at(p)].kinetic = kinetic_energy(ply, s.dt, s.next_dt, mass_loads(s.data));
    of_ply[at(p)].external = work_of_gravity(ply, s.data.gravity) + ply.law_work;
  });
  Energies e;
  for (const Energies& ply : of_ply)
    e += ply;
  each_kind<InOrder::summed>(s, [&](const auto& kind) { kind.add_energies(s, pool, e); });
  e.damping += s.mass_damping_work;
  e.mass_scaling = s.mass_scaling_work;
  e.external += s.start_energy;
  e.floor = s.energy_floor;
  return e;
}

} // namespace plyform
