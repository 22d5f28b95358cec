// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/ply/viscous_simd.hpp"

#include <algorithm>

namespace plyform {
namespace {

static_assert(sizeof(SimdNumbers) == simd_width * sizeof(double));

KernelSpring kernel_spring(double stiffness, double dt) {
  return {stiffness, stiffness > 0.0 ? 1.0 / stiffness : 0.0, stiffness * dt};
}

double smoothing_of(double dt, double time) {
  return dt > 0.0 ? dt / (dt + time) : 0.0;
}

KernelViscousCrossing kernel_crossing_of(const ViscousCrossing& c, const MembraneCrossing& of,
                                         double dt) {
  KernelViscousCrossing k{};
  k.crossing = static_cast<int>(c.crossing), k.first_state = static_cast<int>(c.state);
  k.dashpot = c.law.has_dashpot();
  k.terms = static_cast<int>(c.law.c.size());
  std::copy(c.law.c.begin(), c.law.c.end(), k.viscosity);
  k.shear = kernel_spring(of.spring, dt), k.deviation = kernel_spring(of.deviation_spring, dt);
  for (const MaxwellBranch& branch : c.law.branches) {
    const MaxwellStep step = dt > 0.0 ? maxwell_step(branch, dt) : MaxwellStep{};
    k.branch[k.branches++] = {branch.modulus, 1.0 / branch.modulus, step.keep, step.rise,
                              dt / branch.time};
  }
  k.smoothing = smoothing_of(dt, c.rate_time);
  k.cells = of.cells;
  return k;
}

KernelMelt kernel_melt(const ViscousSheet& sheet, const Membrane& m, double dt) {
  return {{sheet.shear, sheet.apart},
          kernel_spring(m.matrix_spring, dt),
          static_cast<int>(sheet.state),
          smoothing_of(dt, sheet.rate_time),
          {m.across.x(), m.across.y()}};
}

void viscosity_of_table(const KernelViscous& k, int index, const double* angle,
                        const double* driven, const double* factor, double* out) {
  const KernelViscousCrossing& c = k.crossing[index];
  for (int i = 0; i < simd_width; ++i)
    out[i] =
        k.law->crossings[at(index)].law.viscosity(angle[i], driven[i], c.shear.by_dt, factor[i]);
}

/// Calls each(group, lane, node) for all nodes.
template <class Each>
void each_place(const BendingSimd& l, const Each& each) {
  for (const BendingBlock& block : l.blocks)
    for (int g = block.first_group; g < block.first_group + block.groups; ++g)
      for (std::size_t lane = 0; lane < simd_width; ++lane) {
        const SimdStencils& s = l.stencils[at(g)];
        if (s.area[lane] > 0.0)
          each(at(g), lane, at(l.nodes[at(block.first_node) + s.own[lane] / 32]));
      }
}

/// To `out`, `size` numbers each, from those packed.
auto unpack_to(std::vector<double>& out, std::span<const SimdNumbers> packed, std::size_t size) {
  return [&out, packed, size](std::size_t i, std::size_t lane, std::size_t to) {
    for (std::size_t k = 0; k < size; ++k)
      out[to * size + k] = packed[i * size + k].of[lane];
  };
}

} // namespace

KernelViscous kernel_viscous(const ViscousMembrane& v, const Membrane& m, const MembraneSimd& simd,
                             const PackedStep& step) {
  KernelViscous k; // only as many crossings are set as there are
  k.moves = step.dt > 0.0 ? 1.0 : 0.0;
  k.per_dt = step.dt > 0.0 ? 1.0 / step.dt : 0.0;
  k.states = static_cast<int>(v.states);
  k.crossings = static_cast<int>(v.crossings.size());
  for (std::size_t i = 0; i < v.crossings.size(); ++i)
    k.crossing[i] =
        kernel_crossing_of(v.crossings[i], m.crossings[v.crossings[i].crossing], step.dt);
  k.has_melt = v.sheet.has_value();
  if (v.sheet) k.melt = kernel_melt(*v.sheet, m, step.dt);
  k.first = simd.triangles->data();
  k.begin = step.begin.data(), k.end = step.end.data();
  k.factors = step.factors.empty() ? nullptr : step.factors.data();
  k.law = &v;
  k.viscosity = viscosity_of_table;
  return k;
}

KernelViscousBending kernel_viscous(const ViscousBending& v, const PackedStep& step) {
  KernelViscousBending k; // only as many families are set as there are
  k.moves = step.dt > 0.0 ? 1.0 : 0.0;
  k.families = static_cast<int>(v.viscosity.size());
  for (std::size_t f = 0; f < v.viscosity.size(); ++f)
    k.family[f] = static_cast<int>(v.family[f]), k.viscosity[f] = v.viscosity[f];
  k.spring = kernel_spring(v.spring, step.dt);
  k.states = static_cast<int>(v.states());
  k.begin = step.begin.data(), k.end = step.end.data();
  k.factors = step.factors.empty() ? nullptr : step.factors.data();
  return k;
}

std::vector<double> by_triangles(const MembraneSimd& simd, const Membrane& m,
                                 std::span<const SimdNumbers> packed, std::size_t size) {
  std::vector<double> of(m.triangles.size() * size);
  each_place(simd, m, unpack_to(of, packed, size));
  return of;
}

std::vector<double> by_nodes(const BendingSimd& simd, std::size_t nodes,
                             std::span<const SimdNumbers> packed, std::size_t size) {
  std::vector<double> of(nodes * size);
  each_place(simd, unpack_to(of, packed, size));
  return of;
}

void pack(const MembraneSimd& simd, const Membrane& m, std::span<const double> of_triangles,
          std::span<SimdNumbers> packed) {
  each_place(simd, m, [&](std::size_t i, std::size_t lane, std::size_t e) {
    packed[i].of[lane] = of_triangles[e];
  });
}

void pack(const BendingSimd& simd, std::span<const double> of_nodes,
          std::span<SimdNumbers> packed) {
  each_place(simd, [&](std::size_t i, std::size_t lane, std::size_t n) {
    packed[i].of[lane] = of_nodes[n];
  });
}

} // namespace plyform
