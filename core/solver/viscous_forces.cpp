// SPDX-License-Identifier: GPL-3.0-or-later
// What membranes and bending resist by rates, as kinds of force: steps, energies, words. Their
// forces are among those of elements and bending, whose kernels compute them.
#include "base/format.hpp"
#include "core/solver/force_kinds.hpp"

#include <algorithm>

namespace plyform {
namespace {

constexpr double told_lag = 0.005; // of the stroke

} // namespace

void ViscousForces::finish(Scene& s, ThreadPool&) {
  for (PlyBody& ply : s.plies)
    ply.viscous_stepped = ply.viscous || ply.viscous_bending;
}

void ViscousForces::end_step(Scene& s) {
  for (PlyBody& ply : s.plies) {
    if (!ply.viscous_stepped) continue;
    ply.viscous_states.swap(ply.viscous_end);
    ply.bending_states.swap(ply.bending_end);
    ply.viscous_stepped = false;
  }
}

void ViscousForces::add_energies(const Scene& s, ThreadPool&, Energies& e) {
  for (const PlyBody& ply : s.plies) {
    if (!ply.viscous) continue;
    const ViscousEnergy of = viscous_energy(*ply.viscous, ply.membrane, ply.viscous_now());
    e.shear += of.stored, e.viscous += of.lost;
  }
}

void ViscousForces::describe(const Scene& s, std::vector<std::string>& lines) {
  const double stroke = s.data.process_stroke_time();
  for (const PlyBody& ply : s.plies) {
    if (!ply.viscous) continue;
    const double lag = lag_of(*ply.viscous, ply.membrane, 1.0 / stroke);
    if (lag > told_lag * stroke)
      lines.push_back(fmt::format(
          "viscous shear of {} lags behind its rate by up to {:.2g} s of the process, {:.2g} % of "
          "the stroke: the stiffer its yarns are (solver.fibre_softening), the less",
          ply.name, lag, 100.0 * lag / stroke));
  }
}

void ViscousBendingForces::add_energies(const Scene& s, ThreadPool&, Energies& e) {
  for (const PlyBody& ply : s.plies) {
    if (!ply.viscous_bending) continue;
    const ViscousBendingEnergy of =
        viscous_bending_energy(*ply.viscous_bending, ply.membrane.node_area, ply.bending_now());
    e.bending += of.stored, e.viscous += of.lost;
  }
}

void ViscousBendingForces::add_bound(const PlyBody& ply, Frequencies& of) {
  if (ply.viscous_bending) of.omega2 += ply.viscous_bending->omega2;
}

void ViscousBendingForces::describe(const Scene& s, std::vector<std::string>& lines) {
  const double stroke = s.data.process_stroke_time();
  for (const PlyBody& ply : s.plies) {
    if (!ply.viscous_bending) continue;
    const ViscousBending& v = *ply.viscous_bending;
    const double lag = *std::max_element(v.viscosity.begin(), v.viscosity.end()) / v.spring;
    if (lag > told_lag * stroke)
      lines.push_back(fmt::format(
          "viscous bending of {} lags behind its rate by {:.2g} s of the process, {:.2g} % of the "
          "stroke: the larger elements are, and the stiffer yarns, the less",
          ply.name, lag, 100.0 * lag / stroke));
  }
}

} // namespace plyform
