// SPDX-License-Identifier: GPL-3.0-or-later
// The membrane of core/ply/membrane.hpp laid out for speed: four groups side by side, in blocks
// whose nodes stay in a core's cache. What membrane.hpp computes one triangle after the other is
// the oracle of its test.
//
// A block gathers the places of its nodes, does its groups, and adds their forces up at its own
// nodes: no triangle's force goes to memory. core/ply/block_forces.hpp says how a node finds its
// sum.
#pragma once

#include "core/ply/block_forces.hpp"
#include "core/ply/membrane.hpp"
#include "core/ply/membrane_simd_kernel.hpp"

namespace plyform {

/// One block: ranges in the arrays of MembraneSimd.
struct SimdBlock {
  int first_node = 0, nodes = 0;
  int first_triangles = 0, first_group = 0;
  int pair_packs = 0, single_packs = 0;
};

struct MembraneSimd : BlockForces {
  std::vector<SimdBlock> blocks;
  std::vector<SimdTriangles> triangles; ///< of the blocks, pairs first
  std::vector<SimdViscosity> viscosity; ///< one a pack of four groups
};

/// Whether the kernel knows this membrane: it has yarns.
bool fits_simd(const Membrane& m);

/// x: the unformed ply, 2 or 3 coordinates alike in order; only says which groups are neighbours.
MembraneSimd make_membrane_simd(const Membrane& m, std::span<const Vec3> x);

/// Internal forces of a block's groups on its nodes, viscous ones included; dt and the report as
/// element_forces (core/ply/membrane.hpp).
GroupReport simd_forces(MembraneSimd& simd, const Membrane& m, std::span<const Vec3> x, double dt,
                        int block);

/// Energies of a block's groups; membrane_energy is their sum.
MembraneEnergy simd_energy(const MembraneSimd& simd, const Membrane& m, std::span<const Vec3> x,
                           int block);

} // namespace plyform
