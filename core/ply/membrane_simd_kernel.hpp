// SPDX-License-Identifier: GPL-3.0-or-later
// Interface of the compiled copies of the kernel of core/ply/membrane_simd.hpp: plain numbers
// and pointers, nothing inline (reason: contact/simd/simd.hpp).
#pragma once

#include "core/ply/simd_kernel.hpp"

namespace plyform {

struct Membrane;

constexpr int most_shear_terms = 8; ///< longer polynomials are evaluated by callback, as tables

/// One triangle of each of four strain groups.
struct alignas(32) SimdTriangles {
  double c11[simd_width], c12[simd_width], c21[simd_width],
      c22[simd_width];               ///< 1/mm, FibreGradients
  double area[simd_width];           ///< mm^2, A0; 0 in SIMD lanes without a triangle
  double share[simd_width];          ///< A0 / A of the group
  std::uint16_t node[3][simd_width]; ///< byte offsets: 32 times the index in the block's list
};

/// State variables of the viscosity of four groups: mean stretches and viscous tensions (times d_a,
/// N/mm) of the last step.
struct alignas(32) SimdViscosity {
  double lambda[2][simd_width], tension[2][simd_width];
};

/// Constants of (N) for one family of yarns, each times their density d_a: per mm, not per yarn.
struct KernelYarns {
  double stiffness, compression, viscosity, stabilisation, collapse_penalty;
  bool table;             ///< call KernelLaw::tension: the law is not TensionLaw::linear
  bool buckles;           ///< if not by table: the next two members apply
  double buckling_strain; ///< -, above 0: compressive strain at which the yarn buckles
  double buckling_drop;   ///< N/mm, decrease of the slope there
};

struct KernelLaw {
  KernelYarns yarns[2];
  double angle; ///< rad, omega0 - pi/2
  double beta;
  double shear[most_shear_terms]; ///< N/mm, n_c times the coefficients of g, g^3 ..., 0 beyond
  int shear_terms;                ///< 0: a table, call `secant`
  const Membrane* membrane;       ///< whose laws the callbacks evaluate
  double cells;                   ///< n_c
  /// d_a N (N/mm) of four strains of a family; n_c p (N/mm) of four squared shear measures g^2.
  void (*tension)(const KernelLaw&, int family, const double* strain, double* n);
  void (*secant)(const KernelLaw&, const double* measure2, double* p);
  /// Likewise d_a W_a (N/mm), n_c Ws (N/mm).
  void (*tension_energy)(const KernelLaw&, int family, const double* strain, double* energy);
  void (*shear_energy)(const KernelLaw&, const double* measure2, double* energy);
};

/// Strain groups that share a list of nodes; pairs first. All arrays are those of the block.
struct KernelBlock {
  const std::int32_t* nodes; ///< node numbers in the ply
  int node_count;            ///< at most most_block_nodes
  const SimdTriangles* triangles;
  const SimdViscosity* begin; ///< one per pack, of the begin of the step
  SimdViscosity* end;         ///< one per pack, of its end
  int pair_packs, single_packs;
  SimdForce* force; ///< N, one per node of the block
};

struct KernelReport {
  double viscous_work;
  bool collapsed;
};

/// Sums of (E), N mm.
struct KernelEnergy {
  double fibre, shear;
};

/// Forces (F), N, of a block's groups on its nodes, stored in block.force; writes block.end.
/// x: mm, 3 numbers per node of the ply; per_dt: 1/s, inverse of the time step that led to x, or 0.
KernelReport membrane_kernel_generic(const KernelBlock& block, const KernelLaw& law,
                                     const double* x, double per_dt);
KernelReport membrane_kernel_avx2(const KernelBlock& block, const KernelLaw& law, const double* x,
                                  double per_dt);
KernelReport membrane_kernel_avx512(const KernelBlock& block, const KernelLaw& law, const double* x,
                                    double per_dt);

/// (E) of a block's groups; block.begin, end and force are not used.
KernelEnergy membrane_energy_generic(const KernelBlock& block, const KernelLaw& law,
                                     const double* x);
KernelEnergy membrane_energy_avx2(const KernelBlock& block, const KernelLaw& law, const double* x);
KernelEnergy membrane_energy_avx512(const KernelBlock& block, const KernelLaw& law,
                                    const double* x);

} // namespace plyform
