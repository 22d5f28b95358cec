// SPDX-License-Identifier: GPL-3.0-or-later
// The membrane of core/ply/membrane.hpp, optimised: four strain groups at a time (SIMD), in blocks
// whose nodes stay in a core's cache. Its test compares it with the scalar implementation of
// membrane.hpp.
//
// A block gathers the positions of its nodes, computes its groups, and sums their forces in its own
// list of nodes, so that no element force is written to memory. core/ply/block_forces.hpp sums the
// blocks on a node.
//
// A pack is the unit of the kernel: four single triangles, or four pairs of triangles.
#pragma once

#include "core/ply/block_forces.hpp"
#include "core/ply/membrane.hpp"
#include "core/ply/membrane_simd_kernel.hpp"
#include "core/ply/shared_constants.hpp"

namespace plyform {

/// One block: ranges in the arrays of MembraneSimd.
struct SimdBlock {
  int first_node = 0, nodes = 0;
  int first_triangles = 0, first_group = 0;
  int pair_packs = 0, single_packs = 0;
};

struct MembraneSimd : BlockForces {
  std::vector<SimdBlock> blocks;
  SharedConstants<SimdTriangles> triangles; ///< of the blocks, pairs first
  int packs = 0;                            ///< of all blocks
  std::vector<std::int32_t> groups;         ///< strain groups of each pack, -1 where it has none
};

/// Calls each(i, lane, e) for all triangles e of the ply: their places in `triangles`.
template <class Each>
void each_place(const MembraneSimd& simd, const Membrane& m, const Each& each) {
  for (const SimdBlock& block : simd.blocks) {
    int i = block.first_triangles;
    for (int pack = 0; pack < block.pair_packs + block.single_packs; ++pack) {
      const int size = pack < block.pair_packs ? 2 : 1;
      for (int lane = 0; lane < simd_width; ++lane) {
        const std::int32_t group = simd.groups[at(simd_width * (block.first_group + pack) + lane)];
        for (int of = 0; of < size && group >= 0; ++of)
          each(at(i + of), at(lane), at(m.group_begin[at(group)] + of));
      }
      i += size;
    }
  }
}

/// What temperatures make of laws; each empty: 1.
struct LawFactors {
  std::span<const SimdNumbers> shear; ///< of Cs, in the order of MembraneSimd::triangles
  std::span<const SimdNumbers> times; ///< of the times of yarns, of the groups of each pack
};

/// Whether the kernel can compute this membrane: only if it has yarns.
bool fits_simd(const Membrane& m);

/// x: undeformed positions (mm, n), used only to put neighbouring groups into the same block.
/// Requires fits_simd(m).
MembraneSimd make_membrane_simd(const Membrane& m, std::span<const Vec3> x);

/// What its yarns remember at the start: families of the first pack, of the second ...
std::vector<SimdYarnStates> states_at_start(const MembraneSimd& simd, const Membrane& m);

/// m numbers, of each triangle number `state` of what the yarns of a family remember. states: as at
/// start.
std::vector<double> remembered_of(const MembraneSimd& simd, const Membrane& m,
                                  std::span<const SimdYarnStates> states, std::size_t family,
                                  std::size_t state);

/// The same of all families, as memory_at_start.
std::vector<YarnMemory> memory_of(const MembraneSimd& simd, const Membrane& m,
                                  std::span<const SimdYarnStates> states);

/// Internal forces (F), N, of a block's groups, viscous ones included, stored in simd.force;
/// simd_force (core/ply/block_forces.hpp) sums them. x: mm, n; dt, states (as at start)
/// and report: as of element_forces (core/ply/membrane.hpp). viscous: laws with rates
/// (kernel_viscous of core/ply/viscous_simd.hpp), or null.
GroupReport simd_forces(MembraneSimd& simd, const Membrane& m, std::span<const Vec3> x, double dt,
                        int block, const LawStates<SimdYarnStates>& states,
                        const KernelViscous* viscous = nullptr, const LawFactors& factors = {});

/// (E) of a block's groups, N mm; summed over the blocks it is membrane_energy. x: mm, n; begin:
/// what yarns remember of the begin of the step dt (s).
MembraneEnergy simd_energy(const MembraneSimd& simd, const Membrane& m, std::span<const Vec3> x,
                           double dt, int block, std::span<const SimdYarnStates> begin,
                           const LawFactors& factors = {});

/// sum over the triangles of a block of A0 sum_c n_c Es of (E), N mm, each triangle's times its
/// factor.
double simd_shear_energy(const MembraneSimd& simd, const Membrane& m, std::span<const Vec3> x,
                         int block, std::span<const SimdYarnStates> begin,
                         std::span<const SimdNumbers> factors);

} // namespace plyform
