// SPDX-License-Identifier: GPL-3.0-or-later
// Elements and bending as kinds of force.
#include "base/stopwatch.hpp"
#include "core/solver/force_kinds.hpp"
#include "core/solver/step_faults.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace plyform {
namespace {

double place_among(int task, std::size_t tasks) {
  return static_cast<double>(task) / static_cast<double>(tasks);
}

MembraneEnergy energy_of(const Scene& s, const Block& block) {
  const PlyBody& ply = s.plies[at(block.ply)];
  if (ply.simd)
    return simd_energy(*ply.simd, ply.membrane, ply.x, s.dt, block.begin, ply.yarns,
                       ply.shear_factors);
  return block.begin > 0 ? MembraneEnergy{} : membrane_energy(ply.membrane, ply.x); // of all blocks
}

/// Laws with rates of a ply in this step, if it has any: what its kernels ask.
std::optional<KernelViscous> viscous_of(const Scene& s, PlyBody& ply) {
  if (!ply.viscous) return std::nullopt;
  return kernel_viscous(
      *ply.viscous, ply.membrane, *ply.simd,
      {s.dt * ply.membrane.process_time, ply.viscous_states, ply.viscous_end, ply.flow_factors});
}
std::optional<KernelViscousBending> viscous_bending_of(const Scene& s, PlyBody& ply) {
  if (!ply.viscous_bending) return std::nullopt;
  return kernel_viscous(*ply.viscous_bending, {s.dt * ply.membrane.process_time, ply.bending_states,
                                               ply.bending_end, ply.node_flow_factors});
}

template <class T>
const T* pointer_to(const std::optional<T>& value) {
  return value ? &*value : nullptr;
}

double seconds_of(const std::vector<Block>& blocks) {
  double sum = 0.0;
  for (const Block& block : blocks)
    sum += block.seconds;
  return sum;
}

} // namespace

double ElementForces::place(const Scene& s, int task) {
  return place_among(task, s.group_blocks.size());
}

void ElementForces::run(Scene& s, int task) {
  Block& block = s.group_blocks[at(task)];
  const Stopwatch watch(block.seconds);
  PlyBody& ply = s.plies[at(block.ply)];
  const std::optional<KernelViscous> viscous = viscous_of(s, ply);
  const GroupReport report =
      ply.simd ? simd_forces(*ply.simd, ply.membrane, ply.x, s.dt, block.begin,
                             {ply.yarns, ply.yarns_end}, pointer_to(viscous), ply.shear_factors)
               : element_forces(ply.membrane, ply.x, s.dt, block.begin, block.end, {}, ply.q);
  s.group_lost[at(task)] = report.lost;
  s.group_torn[at(task)] = report.torn;
  s.group_collapsed[at(task)] = report.collapsed;
}

void ElementForces::end_step(Scene& s) {
  for (PlyBody& ply : s.plies)
    ply.yarns.swap(ply.yarns_end);
  for (std::size_t b = 0; b < s.group_sums.size(); ++b) {
    s.group_sums[b] += std::exchange(s.group_lost[b], 0.0);
    s.torn_sums[b] += std::exchange(s.group_torn[b], 0.0);
  }
}

void ElementForces::add_to_nodes(const PlyBody& ply, int begin, int end, Vec3* f) {
  for (int n = begin; n < end; ++n)
    f[n - begin] = ply.simd ? simd_force(*ply.simd, at(n)) : node_force(ply.membrane, ply.q, n);
}

void ElementForces::add_energies(const Scene& s, ThreadPool& pool, Energies& e) {
  std::vector<MembraneEnergy> of(s.group_blocks.size());
  pool.run(static_cast<int>(of.size()),
           [&](int i) { of[at(i)] = energy_of(s, s.group_blocks[at(i)]); });
  for (const MembraneEnergy& block : of)
    e.fibre += block.fibre, e.shear += block.shear, e.stitch += block.stitch;
  for (std::size_t b = 0; b < of.size(); ++b)
    e.damping += lost(s, b), e.stitch_breaking += torn(s, b);
}

double ElementForces::elastic(const Scene& s, std::size_t ply) {
  double sum = 0.0;
  for (const Block& block : s.group_blocks)
    if (at(block.ply) == ply) {
      const MembraneEnergy m = energy_of(s, block);
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

std::optional<Stop> ElementForces::fault(const Scene& s) {
  // at every step, as small triangles can invert within a few
  if (std::find(s.group_collapsed.begin(), s.group_collapsed.end(), 1) == s.group_collapsed.end())
    return std::nullopt;
  return find_collapsed(s);
}

void ElementForces::add_times(const Scene& s, Times& times) {
  times.elements += seconds_of(s.group_blocks);
}

double BendingForces::place(const Scene& s, int task) {
  return place_among(task, s.bending_blocks.size());
}

void BendingForces::run(Scene& s, int task) {
  Block& block = s.bending_blocks[at(task)];
  const Stopwatch watch(block.seconds);
  PlyBody& ply = s.plies[at(block.ply)];
  const std::optional<KernelViscousBending> viscous = viscous_bending_of(s, ply);
  bending_forces(*ply.bending, ply.x, block.begin, pointer_to(viscous));
}

void BendingForces::add_to_nodes(const PlyBody& ply, int begin, int end, Vec3* f) {
  if (!ply.bending) return;
  for (int n = begin; n < end; ++n)
    f[n - begin] += simd_force(*ply.bending, at(n));
}

void BendingForces::add_energies(const Scene& s, ThreadPool& pool, Energies& e) {
  std::vector<double> of(s.plies.size());
  pool.run(static_cast<int>(of.size()), [&](int p) { of[at(p)] = elastic(s, at(p)); });
  for (const double ply : of)
    e.bending += ply;
}

double BendingForces::elastic(const Scene& s, std::size_t ply) {
  const PlyBody& body = s.plies[ply];
  return body.bending ? bending_energy(*body.bending, body.x) : 0.0;
}

void BendingForces::add_bound(const PlyBody& ply, Frequencies& of) {
  if (ply.bending) of.omega2 += ply.bending->omega2;
}

void BendingForces::add_times(const Scene& s, Times& times) {
  times.elements += seconds_of(s.bending_blocks);
}

} // namespace plyform
