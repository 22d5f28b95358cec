// SPDX-License-Identifier: GPL-3.0-or-later
// Elements and bending as kinds of force, with what resists their rates.
#include "base/format.hpp"
#include "base/stopwatch.hpp"
#include "core/solver/scene.hpp"
#include "core/solver/step_faults.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace plyform {
namespace {

double place_among(int task, std::size_t tasks) {
  return static_cast<double>(task) / static_cast<double>(tasks);
}

MembraneEnergy energy_of(const Layup& layup, const Block& block) {
  const PlyBody& ply = layup.plies[at(block.ply)];
  if (ply.simd)
    return simd_energy(*ply.simd, ply.membrane, ply.x, layup.dt, block.begin, ply.yarns,
                       ply.law_factors());
  return block.begin > 0 ? MembraneEnergy{} : membrane_energy(ply.membrane, ply.x); // of all blocks
}

/// Laws with rates of a ply in this step, if it has any: what its kernels ask.
std::optional<KernelViscous> viscous_of(const Layup& layup, PlyBody& ply) {
  if (!ply.viscous) return std::nullopt;
  return kernel_viscous(*ply.viscous, ply.membrane, *ply.simd,
                        {layup.dt * ply.membrane.process_time, ply.viscous_states, ply.viscous_end,
                         ply.flow_factors});
}
std::optional<KernelViscousBending> viscous_bending_of(const Layup& layup, PlyBody& ply) {
  if (!ply.viscous_bending) return std::nullopt;
  return kernel_viscous(*ply.viscous_bending,
                        {layup.dt * ply.membrane.process_time, ply.bending_states, ply.bending_end,
                         ply.node_flow_factors});
}

template <class T>
const T* pointer_to(const std::optional<T>& value) {
  return value ? &*value : nullptr;
}

constexpr double told_lag = 0.005; // of the stroke, of laws with rates

double seconds_of(const std::vector<Block>& blocks) {
  double sum = 0.0;
  for (const Block& block : blocks)
    sum += block.seconds;
  return sum;
}

} // namespace

double ElementForces::place(const Layup&, int task) const {
  return place_among(task, group_blocks.size());
}

void ElementForces::run(Layup& layup, int task) {
  Block& block = group_blocks[at(task)];
  const Stopwatch watch(block.seconds);
  PlyBody& ply = layup.plies[at(block.ply)];
  const std::optional<KernelViscous> viscous = viscous_of(layup, ply);
  const GroupReport report =
      ply.simd ? simd_forces(*ply.simd, ply.membrane, ply.x, layup.dt, block.begin,
                             {ply.yarns, ply.yarns_end}, pointer_to(viscous), ply.law_factors())
               : element_forces(ply.membrane, ply.x, layup.dt, block.begin, block.end, {}, ply.q);
  group_lost[at(task)] = report.lost;
  group_torn[at(task)] = report.torn;
  group_flowed[at(task)] = report.flowed;
  group_collapsed[at(task)] = report.collapsed;
}

void ElementForces::finish(Scene& s, ThreadPool&) {
  for (PlyBody& ply : s.plies)
    ply.viscous_stepped = ply.viscous.has_value();
}

void ElementForces::end_step(Layup& layup) {
  for (PlyBody& ply : layup.plies) {
    ply.yarns.swap(ply.yarns_end);
    if (std::exchange(ply.viscous_stepped, false)) ply.viscous_states.swap(ply.viscous_end);
  }
  for (std::size_t b = 0; b < group_sums.size(); ++b) {
    group_sums[b] += std::exchange(group_lost[b], 0.0);
    torn_sums[b] += std::exchange(group_torn[b], 0.0);
    flowed_sums[b] += std::exchange(group_flowed[b], 0.0);
  }
}

void ElementForces::add_to_nodes(const PlyBody& ply, int begin, int end, Vec3* f) {
  for (int n = begin; n < end; ++n)
    f[n - begin] = ply.simd ? simd_force(*ply.simd, at(n)) : node_force(ply.membrane, ply.q, n);
}

void ElementForces::add_energies(const Layup& layup, ThreadPool& pool, Energies& e) const {
  std::vector<MembraneEnergy> of(group_blocks.size());
  pool.run(static_cast<int>(of.size()),
           [&](int i) { of[at(i)] = energy_of(layup, group_blocks[at(i)]); });
  for (const MembraneEnergy& block : of)
    e.fibre += block.fibre, e.shear += block.shear, e.stitch += block.stitch;
  for (std::size_t b = 0; b < of.size(); ++b)
    e.damping += lost(b), e.stitch_breaking += torn(b), e.viscous += flowed(b);
  for (const PlyBody& ply : layup.plies) {
    if (!ply.viscous) continue;
    const ViscousEnergy viscous = viscous_energy(*ply.viscous, ply.membrane, ply.viscous_now());
    e.shear += viscous.stored, e.viscous += viscous.lost;
  }
}

double ElementForces::elastic(const Layup& layup, std::size_t ply) const {
  double sum = 0.0;
  for (const Block& block : group_blocks)
    if (at(block.ply) == ply) {
      const MembraneEnergy m = energy_of(layup, block);
      sum += m.fibre + m.shear + m.stitch;
    }
  return sum;
}

void ElementForces::add_bound(const PlyBody& ply, Frequencies& of) {
  const EigenvalueBound& b = ply.bound;
  of.omega2 += kink_factor(ply.membrane) * highest_omega2(b, ply.eigenvalue_ratio);
  of.damping +=
      b.penalty_acts ? b.damping : std::min(b.damping, ply.eigenvalue_ratio * b.yarns * b.viscous);
}

void ElementForces::add_bound_of_rest(const PlyBody& ply, Frequencies& of) {
  of.omega2 += ply.bound.soft;
  if (!ply.membrane.fabric.has_yarns()) of.omega2 += ply.bound.yarns;
}

std::optional<Stop> ElementForces::fault(const Layup& layup) const {
  // at every step, as small triangles can invert within a few
  if (std::find(group_collapsed.begin(), group_collapsed.end(), 1) == group_collapsed.end())
    return std::nullopt;
  return find_collapsed(layup);
}

void ElementForces::add_times(Times& times) const {
  times.elements += seconds_of(group_blocks);
}

void ElementForces::describe(const Layup& layup, std::vector<std::string>& lines) const {
  const double stroke = layup.data.process_stroke_time();
  for (const PlyBody& ply : layup.plies) {
    if (!ply.viscous) continue;
    const double lag = lag_of(*ply.viscous, ply.membrane, 1.0 / stroke);
    if (lag > told_lag * stroke)
      lines.push_back(fmt::format(
          "viscous shear of {} lags behind its rate by up to {:.2g} s of the process, {:.2g} % of "
          "the stroke: the stiffer its yarns are (solver.fibre_softening), the less",
          ply.name, lag, 100.0 * lag / stroke));
  }
}

double BendingForces::place(const Layup&, int task) const {
  return place_among(task, bending_blocks.size());
}

void BendingForces::run(Layup& layup, int task) {
  Block& block = bending_blocks[at(task)];
  const Stopwatch watch(block.seconds);
  PlyBody& ply = layup.plies[at(block.ply)];
  const std::optional<KernelViscousBending> viscous = viscous_bending_of(layup, ply);
  bending_forces(*ply.bending, ply.x, block.begin, pointer_to(viscous));
}

void BendingForces::finish(Scene& s, ThreadPool&) {
  for (PlyBody& ply : s.plies)
    ply.bending_stepped = ply.viscous_bending.has_value();
}

void BendingForces::end_step(Layup& layup) {
  for (PlyBody& ply : layup.plies)
    if (std::exchange(ply.bending_stepped, false)) ply.bending_states.swap(ply.bending_end);
}

void BendingForces::add_to_nodes(const PlyBody& ply, int begin, int end, Vec3* f) {
  if (!ply.bending) return;
  for (int n = begin; n < end; ++n)
    f[n - begin] += simd_force(*ply.bending, at(n));
}

void BendingForces::add_energies(const Layup& layup, ThreadPool& pool, Energies& e) const {
  std::vector<double> of(layup.plies.size());
  pool.run(static_cast<int>(of.size()), [&](int p) { of[at(p)] = elastic(layup, at(p)); });
  for (const double ply : of)
    e.bending += ply;
  for (const PlyBody& ply : layup.plies) {
    if (!ply.viscous_bending) continue;
    const ViscousBendingEnergy viscous =
        viscous_bending_energy(*ply.viscous_bending, ply.membrane.node_area, ply.bending_now());
    e.bending += viscous.stored, e.viscous += viscous.lost;
  }
}

double BendingForces::elastic(const Layup& layup, std::size_t ply) {
  const PlyBody& body = layup.plies[ply];
  return body.bending ? bending_energy(*body.bending, body.x) : 0.0;
}

void BendingForces::add_bound(const PlyBody& ply, Frequencies& of) {
  if (ply.bending) of.omega2 += ply.bending->omega2;
  if (ply.viscous_bending) of.omega2 += ply.viscous_bending->omega2;
}

void BendingForces::add_times(Times& times) const {
  times.elements += seconds_of(bending_blocks);
}

void BendingForces::describe(const Layup& layup, std::vector<std::string>& lines) const {
  const double stroke = layup.data.process_stroke_time();
  for (const PlyBody& ply : layup.plies) {
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
