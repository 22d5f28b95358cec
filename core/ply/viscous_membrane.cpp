// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/ply/viscous_membrane.hpp"

#include "core/mesh/pairs.hpp"
#include "core/ply/element_limits.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

constexpr double rate_share = 0.01; // of the stroke: over which told rates are smoothed

double sum_of_torques(const ViscousCrossing& c, const double* q) {
  double sum = 0.0;
  for (std::size_t k = 0; k <= c.law.branches.size(); ++k)
    sum += q[3 * k];
  return sum;
}

} // namespace

std::optional<ViscousMembrane> make_viscous(Membrane& m, double stroke) {
  ViscousMembrane v;
  for (std::size_t c = 0; c < m.crossings.size(); ++c) {
    MembraneCrossing& of = m.crossings[c];
    const std::optional<ViscousShear>& law = m.fabric.crossings[c].viscous;
    if (!law) continue;
    const auto stiffness = [&](std::size_t a) {
      return m.families[a].density * m.families[a].yarn.largest_slope();
    };
    const double k = std::min(stiffness(of.first), stiffness(of.second)) / of.cells;
    of.branches = law->instant_modulus();
    if (law->has_dashpot())
      of.spring = spring_share * k, of.deviation_spring = deviation_share / deviation_weight * k;
    v.crossings.push_back({c, *law, v.states, rate_share * stroke});
    v.states = v.crossings.back().end();
  }
  if (const std::optional<ViscousMatrix>& melt = m.fabric.matrix) {
    const double h = m.fabric.thickness;
    v.sheet = ViscousSheet{melt->longitudinal * h, 4.0 * melt->transverse * h, v.states,
                           rate_share * stroke};
    v.states = v.sheet->end();
    for (const MembraneFamily& family : m.families)
      m.matrix_spring += matrix_spring_share * family.density * family.yarn.largest_slope();
  }
  if (v.crossings.empty() && !v.sheet) return std::nullopt;
  return v;
}

ViscousEnergy viscous_energy(const ViscousMembrane& v, const Membrane& m,
                             std::span<const double> states) {
  ViscousEnergy sum;
  for (std::size_t e = 0; e < m.triangles.size(); ++e) {
    const double* state = states.data() + e * v.states;
    sum.lost += state[0];
    for (const ViscousCrossing& c : v.crossings) {
      const MembraneCrossing& of = m.crossings[c.crossing];
      const double* q = state + c.state + 3;
      double stored = 0.0;
      for (std::size_t i = 0; i < 3; ++i) {
        const double spring = i == 0 ? of.spring : of.deviation_spring;
        if (spring > 0.0) stored += 0.5 * q[i] * q[i] / spring;
        for (std::size_t k = 0; k < c.law.branches.size(); ++k)
          stored += 0.5 * q[3 * (k + 1) + i] * q[3 * (k + 1) + i] / c.law.branches[k].modulus;
      }
      sum.stored += m.area[e] * of.cells * stored;
    }
    if (v.sheet) {
      const double* n = state + v.sheet->state + 3;
      sum.stored += 0.5 * m.area[e] * (n[0] * n[0] + n[1] * n[1]) / m.matrix_spring;
    }
  }
  return sum;
}

ShownRate shown_rate(const ViscousMembrane& v, const Membrane& m, std::span<const double> states,
                     std::size_t e) {
  const double* state = states.data() + e * v.states;
  if (v.crossings.empty())
    return {state[v.sheet->rates()], state[v.sheet->rates() + 1], state[v.sheet->state + 3]};
  const ViscousCrossing& c = v.crossings.front();
  return {state[c.rates()], state[c.rates() + 1],
          m.crossings[c.crossing].cells * sum_of_torques(c, state + c.state + 3)};
}

double lag_of(const ViscousMembrane& v, const Membrane& m, double rate) {
  double lag = 0.0;
  for (const ViscousCrossing& c : v.crossings)
    for (int i = 0; i <= 9 && c.law.has_dashpot(); ++i)
      lag = std::max(lag, c.law.torque(0.25 * M_PI * i / 9.0, rate) / rate /
                              m.crossings[c.crossing].spring);
  if (v.sheet) lag = std::max(lag, std::max(v.sheet->shear, v.sheet->apart) / m.matrix_spring);
  return lag;
}

} // namespace plyform
