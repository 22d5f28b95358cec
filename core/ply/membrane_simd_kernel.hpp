// SPDX-License-Identifier: GPL-3.0-or-later
// Interface of the compiled copies of the kernel of core/ply/membrane_simd.hpp: plain numbers
// and pointers, nothing inline (reason: base/simd.hpp).
#pragma once

#include "core/ply/shear_piece.hpp"
#include "core/ply/simd_kernel.hpp"

namespace plyform {

struct Membrane;
struct KernelViscous;

constexpr int most_shear_terms = 8;  ///< longer polynomials are evaluated by callback
constexpr double least_shear = 1e-9; ///< rad: below it Cs(g) / g equals the slope at 0 to rounding

/// One triangle of each of four strain groups.
struct alignas(32) SimdTriangles {
  double c11[simd_width], c12[simd_width], c21[simd_width],
      c22[simd_width];               ///< 1/mm, AxesGradients
  double area[simd_width];           ///< mm^2, A0; 0 in SIMD lanes without a triangle
  double share[simd_width];          ///< A0 / A of the group
  std::uint16_t node[3][simd_width]; ///< byte offsets: 32 times the index in the block's list
};

/// Numbers that a law of core/model/yarn_law.hpp may remember of a yarn. Those that the kernel
/// knows itself: mean stretch and viscous tension, this times d_a (N/mm).
constexpr int most_yarn_states = 2;

/// What the yarns of one family in four groups remember.
struct alignas(32) SimdYarnStates {
  double of[most_yarn_states][simd_width];
};

/// Answers of a law at four points, times d_a: tension, energy stored, lost and flowed, N/mm
/// (LawAnswer).
struct alignas(32) KernelAnswers {
  double value[simd_width], stored[simd_width], lost[simd_width], flowed[simd_width];
};

/// Answers of a sheet's law at four points: stresses S_11, S_22, S_12 with respect to the material
/// axes (N/mm) and energy (N/mm).
struct alignas(32) SheetAnswers {
  double s11[simd_width], s22[simd_width], s12[simd_width], energy[simd_width];
};

/// Constants of (N) for one family of yarns or stitches, each times their density d_a: per mm, not
/// per yarn.
struct KernelYarns {
  double along[2]; ///< v_a
  double stiffness, compression, viscosity, stabilisation, collapse_penalty;
  bool by_law;            ///< call `evaluate`: the kernel does not know their law
  bool buckles;           ///< the next two members apply
  double buckling_strain; ///< -, above 0: compressive strain at which the yarn buckles
  double buckling_drop;   ///< N/mm, decrease of the slope there
  bool breaks;            ///< of stitches: whether they have a force at which they break
  double taut_at;         ///< -, of stitches: stretch at which they become taut
  double breaking;        ///< N/mm, of stitches
};

/// A crimped cell of two families: core/model/crimp.hpp.
struct KernelCell {
  double half_wave[2], length[2]; ///< p_a, L_a0, mm
  double heights;                 ///< D, mm
  double stiffness[2];            ///< n k_a / L_a0, N/mm per mm^2, n cells per area; linear yarns
};

/// A crossing of the families `first` and `second`.
struct KernelCrossing {
  int first, second;
  double angle; ///< rad, omega0 - pi/2
  double sine;  ///< area between v_first and v_second over that between the axes, above 0
  double shear[most_shear_terms]; ///< N/mm, n_c times the coefficients of g, g^3 ..., 0 beyond
  int shear_terms;                ///< 0: a table, or call `shear`
  bool both_signs;                ///< whether there is an even part: the next member applies
  double even[most_shear_terms];  ///< likewise, of C_e for g > 0
  const ShearPiece* piece;        ///< of a table, two behind the last
  const ShearInterval* interval;
  int intervals;    ///< 0: no table
  double per_width; ///< 1/rad
  bool crimped;     ///< the next member applies
  KernelCell cell;
};

struct KernelLaw {
  int families, stitches, crossings;       ///< families: of yarns; stitches: directions
  KernelYarns yarns[most_kernel_families]; ///< of the families, then of stitches
  KernelCrossing crossing[most_kernel_crossings];
  /// Two families, along the axes, with one crossing and no law of the sheet: no more than these
  /// and stitches has to be computed.
  bool weave;
  double beta, side_cubic;
  const Membrane* membrane; ///< whose laws the callbacks evaluate
  bool crimped;             ///< a crossing is
  bool cells_by_law;        ///< call `evaluate_cells`: the kernel does not know all laws of cells
  bool sheet;               ///< call `sheet_law`
  const KernelViscous* viscous; ///< laws with rates, or null
  /// What temperatures make of C_e, of the four triangles of each SimdTriangles from `first` on;
  /// null: 1.
  const SimdNumbers* shear_factors;
  const SimdTriangles* first;
  /// What temperatures make of the times of yarns, of the groups of each pack, of which the states
  /// begin at `states`; null: 1.
  const SimdNumbers* time_factors;
  const SimdYarnStates* states;
  /// Four yarns of a family. begin: of all families of their pack; end: SimdYarnStates::of; per_dt:
  /// 1/s.
  void (*evaluate)(const KernelLaw&, int family, double per_dt, const double* strain,
                   const SimdYarnStates* begin, double (*end)[simd_width], KernelAnswers& answers);
  /// Four yarns of each family, by family.
  void (*evaluate_cells)(const KernelLaw&, double per_dt, const double (*strain)[simd_width],
                         const SimdYarnStates* begin, SimdYarnStates* end, KernelAnswers* answers);
  /// n_c p and n_c T (N/mm) of four triangles with these shear angles and squared measures g^2.
  void (*shear)(const KernelLaw&, int crossing, const double* gamma, const double* measure2,
                double* p, double* torque);
  /// Likewise n_c Es (N/mm).
  void (*shear_energy)(const KernelLaw&, int crossing, const double* gamma, const double* measure2,
                       double* energy);
  /// Four triangles with a = k_1.k_1, b = k_2.k_2, d = k_1.k_2.
  void (*sheet_law)(const KernelLaw&, const double* a, const double* b, const double* d,
                    SheetAnswers& answers);
};

/// Strain groups that share a list of nodes; pairs first. All arrays are those of the block.
struct KernelBlock {
  const std::int32_t* nodes; ///< node numbers in the ply
  int node_count;            ///< at most most_block_nodes
  const SimdTriangles* triangles;
  /// Families and stitches of the first pack, of the second ...: before the step.
  const SimdYarnStates* begin;
  SimdYarnStates* end; ///< likewise, at its end
  int pair_packs, single_packs;
  SimdForce* force; ///< N, one per node of the block
};

struct KernelReport {
  double lost, torn, flowed; ///< N mm, in the step: as GroupReport
  bool collapsed;
};

/// Sums of (E), N mm.
struct KernelEnergy {
  double fibre, shear, stitch;
};

/// Forces (F), N, of a block's groups on its nodes, stored in block.force; writes block.end.
/// x: mm, 3 numbers per node of the ply; per_dt: 1/s, inverse of the time step that led to x, or 0.
KernelReport membrane_kernel_generic(const KernelBlock& block, const KernelLaw& law,
                                     const double* x, double per_dt);
KernelReport membrane_kernel_avx2(const KernelBlock& block, const KernelLaw& law, const double* x,
                                  double per_dt);
KernelReport membrane_kernel_avx512(const KernelBlock& block, const KernelLaw& law, const double* x,
                                    double per_dt);

/// (E) of a block's groups, its yarns with what they remember; block.end and force are not used.
KernelEnergy membrane_energy_generic(const KernelBlock& block, const KernelLaw& law,
                                     const double* x, double per_dt);
KernelEnergy membrane_energy_avx2(const KernelBlock& block, const KernelLaw& law, const double* x,
                                  double per_dt);
KernelEnergy membrane_energy_avx512(const KernelBlock& block, const KernelLaw& law, const double* x,
                                    double per_dt);

} // namespace plyform
