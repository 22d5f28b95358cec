// SPDX-License-Identifier: GPL-3.0-or-later
// The kernel of core/ply/membrane_simd.hpp as its two compiled copies see it: plain numbers and
// pointers, nothing inline (contact/simd/simd.hpp says why).
#pragma once

#include "core/ply/simd_kernel.hpp"

namespace plyform {

struct Membrane;

constexpr int most_shear_terms = 8; ///< longer polynomials are asked for like tables

/// One triangle of each of four groups.
struct alignas(32) SimdTriangles {
  double c11[simd_width], c12[simd_width], c21[simd_width],
      c22[simd_width];               ///< 1/mm, FibreGradients
  double area[simd_width];           ///< mm^2, A0; 0 where a lane only fills up the pack
  double share[simd_width];          ///< A0 / A of the group
  std::uint16_t node[3][simd_width]; ///< bytes: 32 times the number in the block's list
};

/// Viscosity of four groups: mean stretches and viscous tensions of the last step.
struct alignas(32) SimdViscosity {
  double lambda[2][simd_width], tension[2][simd_width];
};

/// Constants of (N) for one family of yarns, each times their density d_a: per mm, not per yarn.
struct KernelYarns {
  double stiffness, compression, viscosity, stabilisation, collapse_penalty;
  bool table;             ///< ask KernelLaw::tension: the law is not TensionLaw::linear
  bool buckles;           ///< if not by table: the two below hold
  double buckling_strain; ///< -, above 0: pressed beyond it, the slope is less ...
  double buckling_drop;   ///< N/mm: ... by this
};

struct KernelLaw {
  KernelYarns yarns[2];
  double angle; ///< rad, omega0 - pi/2
  double beta;
  double shear[most_shear_terms]; ///< N/mm, n_c times the coefficients of g, g^3 ..., 0 beyond
  int shear_terms;                ///< 0: a table, ask `secant`
  const Membrane* membrane;       ///< whose laws are asked where they are tables
  double cells;                   ///< n_c
  /// d_a N (N/mm) of four strains of a family; n_c p (N/mm) of four squared shear measures g^2.
  void (*tension)(const KernelLaw&, int family, const double* strain, double* n);
  void (*secant)(const KernelLaw&, const double* measure2, double* p);
  /// Likewise d_a W_a (N/mm), n_c Ws (N/mm).
  void (*tension_energy)(const KernelLaw&, int family, const double* strain, double* energy);
  void (*shear_energy)(const KernelLaw&, const double* measure2, double* energy);
};

/// StrainGroups that share a list of nodes; pairs first. All arrays are the block's own.
struct KernelBlock {
  const std::int32_t* nodes; ///< in the ply
  int node_count;            ///< at most most_block_nodes
  const SimdTriangles* triangles;
  SimdViscosity* viscosity; ///< one a pack
  int pair_packs, single_packs;
  SimdForce* force; ///< one a node
};

struct KernelReport {
  double viscous_work;
  bool collapsed;
};

/// N mm, sums of (E).
struct KernelEnergy {
  double fibre, shear;
};

/// Forces (F) of a block's groups on its nodes. x: 3 a node of the ply, mm; per_dt: 1/s, of the
/// step that led to x, or 0.
KernelReport membrane_kernel_generic(const KernelBlock& block, const KernelLaw& law,
                                     const double* x, double per_dt);
KernelReport membrane_kernel_avx2(const KernelBlock& block, const KernelLaw& law, const double* x,
                                  double per_dt);

/// Their energy; viscosity and forces are left alone.
KernelEnergy membrane_energy_generic(const KernelBlock& block, const KernelLaw& law,
                                     const double* x);
KernelEnergy membrane_energy_avx2(const KernelBlock& block, const KernelLaw& law, const double* x);

} // namespace plyform
