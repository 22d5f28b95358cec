// SPDX-License-Identifier: GPL-3.0-or-later
// The kernel of core/ply/membrane_simd.hpp as its two compiled copies see it: plain numbers and
// pointers, nothing inline (contact/simd/simd.hpp says why).
#pragma once

#include "core/ply/simd_kernel.hpp"

namespace plyform {

struct Fabric;

constexpr int most_shear_terms = 8; ///< longer polynomials are asked for like tables

/// One triangle of each of four patches.
struct alignas(32) LaneTriangles {
  double c11[lanes], c12[lanes], c21[lanes], c22[lanes]; ///< 1/mm, FibreGradients
  double area[lanes];           ///< mm^2, A0; 0 where a lane only fills up the group
  double share[lanes];          ///< A0 / A of the patch
  std::uint16_t node[3][lanes]; ///< bytes: 32 times the number in the block's list
};

/// Viscosity of four patches: mean stretches and viscous tensions of the last step.
struct alignas(32) LaneViscosity {
  double lambda[2][lanes], tension[2][lanes];
};

/// Constants of (N) for one family of yarns, each times their density d_a: per mm, not per yarn.
struct KernelYarns {
  double stiffness, compression, viscosity, stabilisation, guard;
  bool table;             ///< ask KernelLaw::tension
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
  const Fabric* fabric;
  double cells; ///< n_c
  /// d_a N (N/mm) of four strains of a family; n_c p (N/mm) of four squared shear measures g^2.
  void (*tension)(const KernelLaw&, int family, const double* strain, double* n);
  void (*secant)(const KernelLaw&, const double* measure2, double* p);
  /// Likewise d_a W_a (N/mm), n_c Ws (N/mm).
  void (*tension_energy)(const KernelLaw&, int family, const double* strain, double* energy);
  void (*shear_energy)(const KernelLaw&, const double* measure2, double* energy);
};

/// Patches that share a list of nodes; pairs first. All arrays are the block's own.
struct KernelBlock {
  const std::int32_t* nodes; ///< in the ply
  int node_count;            ///< at most most_block_nodes
  const LaneTriangles* triangles;
  LaneViscosity* viscosity; ///< one a group
  int pair_groups, single_groups;
  LaneForce* force; ///< one a node
};

struct KernelReport {
  double viscous_work;
  bool collapsed;
};

/// N mm, sums of (E).
struct KernelEnergy {
  double fibre, shear;
};

/// Forces (F) of a block's patches on its nodes. x: 3 a node of the ply, mm; per_dt: 1/s, of the
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
