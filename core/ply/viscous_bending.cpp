// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/ply/viscous_bending.hpp"

#include <algorithm>

namespace plyform {
namespace {

bool is_viscous(const FamilyBending& family) {
  return family.viscosity > 0.0;
}

/// Moves the moment of one family over a step; returns it and adds what is lost, N/mm. state:
/// kappa, moment.
double move_moment(double viscosity, double spring, double kappa, double dt, const double* now,
                   double* next, double& lost) {
  next[0] = kappa, next[1] = now[1];
  if (!(dt > 0.0)) return next[1];
  const double change = kappa - now[0];
  next[1] = dashpot_torque(viscosity, spring, dt, now[1], change);
  lost += branch_loss(now[1], next[1], change, spring);
  return next[1];
}

} // namespace

bool has_viscosity(const BendingLaw& law) {
  return std::any_of(law.families.begin(), law.families.end(), is_viscous);
}

std::optional<ViscousBending>
make_viscous_bending(Bending bending, std::span<const double> node_mass, double omega2) {
  if (!has_viscosity(bending.law)) return std::nullopt;
  ViscousBending v;
  BendingLaw springs;
  for (std::size_t f = 0; f < bending.law.families.size(); ++f)
    if (const FamilyBending& family = bending.law.families[f]; is_viscous(family)) {
      springs.families.push_back({family.along, {1.0, {}, {}}, 0.0});
      v.family.push_back(f), v.viscosity.push_back(family.viscosity);
    }
  bending.law = springs, bending.in_plane.clear();
  v.omega2 = bending_spring_share * omega2;
  v.spring = v.omega2 / bending_omega2(bending, node_mass);
  return v;
}

void viscous_bending_forces(const ViscousBending& v, const Bending& bending,
                            std::span<const Vec3> x, double dt, std::span<const double> begin,
                            std::span<double> end, std::vector<Vec3>& force,
                            std::span<const double> factors) {
  std::fill(force.begin(), force.end(), Vec3::Zero());
  for (std::size_t n = 0; n < x.size(); ++n) {
    const StencilShape s = stencil_shape(bending, x, n);
    const double* now = begin.data() + n * v.states();
    double* next = end.data() + n * v.states();
    const double by = factors.empty() ? 1.0 : factors[n];
    double lost = 0.0;
    std::array<double, 3> m{};
    for (std::size_t f = 0; f < v.viscosity.size(); ++f) {
      const Vec3 p = bending.law.families[v.family[f]].of_axes();
      const double kappa = p[0] * s.kappa[0] + p[1] * s.kappa[1] + p[2] * s.kappa[2];
      const double moment = move_moment(by * v.viscosity[f], v.spring, kappa, dt, now + 1 + 2 * f,
                                        next + 1 + 2 * f, lost);
      for (std::size_t k = 0; k < 3; ++k)
        m[k] += moment * p[static_cast<Eigen::Index>(k)];
    }
    next[0] = now[0] + bending.area[n] * lost;
    add_moment_forces(bending, x, n, s, m, force);
  }
}

ViscousBendingEnergy viscous_bending_energy(const ViscousBending& v, std::span<const double> area,
                                            std::span<const double> states) {
  ViscousBendingEnergy sum;
  for (std::size_t n = 0; n < area.size(); ++n) {
    const double* state = states.data() + n * v.states();
    sum.lost += state[0];
    for (std::size_t f = 0; f < v.viscosity.size(); ++f)
      sum.stored += 0.5 * area[n] * state[2 + 2 * f] * state[2 + 2 * f] / v.spring;
  }
  return sum;
}

} // namespace plyform
