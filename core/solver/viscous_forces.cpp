// SPDX-License-Identifier: GPL-3.0-or-later
// What membranes and bending resist by rates, as kinds of force.
#include "base/stopwatch.hpp"
#include "core/solver/force_kinds.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace plyform {
namespace {

constexpr double told_lag = 0.005; // of the stroke

} // namespace

double ViscousForces::place(const Scene& s, int task) {
  return static_cast<double>(task) / static_cast<double>(s.viscous_blocks.size());
}

void ViscousForces::run(Scene& s, int task) {
  Block& block = s.viscous_blocks[at(task)];
  const Stopwatch watch(block.seconds);
  PlyBody& ply = s.plies[at(block.ply)];
  viscous_forces(*ply.viscous, ply.membrane, ply.x, s.dt * ply.membrane.process_time, block.begin,
                 block.end, {ply.viscous_states, ply.viscous_end, ply.flow_factors}, ply.viscous_q);
}

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

void ViscousForces::add_to_nodes(const PlyBody& ply, int begin, int end, Vec3* f) {
  if (!ply.viscous) return;
  for (int n = begin; n < end; ++n)
    f[n - begin] += node_force(ply.membrane, ply.viscous_q, n);
}

void ViscousForces::add_energies(const Scene& s, ThreadPool&, Energies& e) {
  for (const PlyBody& ply : s.plies) {
    if (!ply.viscous) continue;
    const ViscousEnergy of = viscous_energy(*ply.viscous, ply.membrane, ply.viscous_now());
    e.shear += of.stored, e.viscous += of.lost;
  }
}

void ViscousForces::add_times(const Scene& s, Times& times) {
  for (const Block& block : s.viscous_blocks)
    times.elements += block.seconds;
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

int ViscousBendingForces::tasks(const Scene& s) {
  const bool any = std::any_of(s.plies.begin(), s.plies.end(),
                               [](const PlyBody& ply) { return ply.viscous_bending.has_value(); });
  return any ? static_cast<int>(s.plies.size()) : 0;
}

double ViscousBendingForces::place(const Scene& s, int task) {
  return static_cast<double>(task) / static_cast<double>(s.plies.size());
}

void ViscousBendingForces::run(Scene& s, int task) {
  PlyBody& ply = s.plies[at(task)];
  if (!ply.viscous_bending) return;
  const Stopwatch watch(ply.viscous_bending_seconds);
  viscous_bending_forces(*ply.viscous_bending, ply.x, s.dt * ply.membrane.process_time,
                         ply.bending_states, ply.bending_end, ply.viscous_bending_force,
                         ply.node_flow_factors);
}

void ViscousBendingForces::add_to_nodes(const PlyBody& ply, int begin, int end, Vec3* f) {
  if (!ply.viscous_bending) return;
  for (int n = begin; n < end; ++n)
    f[n - begin] += ply.viscous_bending_force[at(n)];
}

void ViscousBendingForces::add_energies(const Scene& s, ThreadPool&, Energies& e) {
  for (const PlyBody& ply : s.plies) {
    if (!ply.viscous_bending) continue;
    const ViscousBendingEnergy of = viscous_bending_energy(*ply.viscous_bending, ply.bending_now());
    e.bending += of.stored, e.viscous += of.lost;
  }
}

void ViscousBendingForces::add_bound(const PlyBody& ply, Frequencies& of) {
  if (ply.viscous_bending) of.omega2 += ply.viscous_bending->bending.omega2;
}

void ViscousBendingForces::add_times(const Scene& s, Times& times) {
  for (const PlyBody& ply : s.plies)
    times.elements += ply.viscous_bending_seconds;
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
