// SPDX-License-Identifier: GPL-3.0-or-later
// Laws with rates in the kernels of membrane and bending, beside core/ply/viscous_membrane.hpp and
// core/ply/viscous_bending.hpp, whose functions compute the same one triangle and one node after
// the other: oracles of the test. What a law keeps lies in the kernels' order, that of
// MembraneSimd::triangles and BendingSimd::stencils: number k of the i-th is at `states` i + k. All
// is 0 at the start.
#pragma once

#include "core/ply/bending_simd.hpp"
#include "core/ply/membrane_simd.hpp"
#include "core/ply/viscous_bending.hpp"
#include "core/ply/viscous_kernel.hpp"
#include "core/ply/viscous_membrane.hpp"

namespace plyform {

using PackedStates = std::vector<SimdNumbers>;

/// States at the begin of a step and at its end, and what temperatures make of viscosities (and of
/// times), one number each triangle or node; factors empty: 1.
struct PackedStep {
  double dt = 0.0; ///< s of the process; 0 at the start
  std::span<const SimdNumbers> begin;
  std::span<SimdNumbers> end;
  std::span<const SimdNumbers> factors;
};

/// For simd_forces.
KernelViscous kernel_viscous(const ViscousMembrane& v, const Membrane& m, const MembraneSimd& simd,
                             const PackedStep& step);
/// For bending_forces.
KernelViscousBending kernel_viscous(const ViscousBending& v, const PackedStep& step);

/// `size` numbers of the first triangle, of the second ..., or of nodes, from the kernels' order.
std::vector<double> by_triangles(const MembraneSimd& simd, const Membrane& m,
                                 std::span<const SimdNumbers> packed, std::size_t size);
std::vector<double> by_nodes(const BendingSimd& simd, std::size_t nodes,
                             std::span<const SimdNumbers> packed, std::size_t size);
/// Writes one number each triangle, or node, in the kernels' order.
void pack(const MembraneSimd& simd, const Membrane& m, std::span<const double> of_triangles,
          std::span<SimdNumbers> packed);
void pack(const BendingSimd& simd, std::span<const double> of_nodes, std::span<SimdNumbers> packed);

} // namespace plyform
