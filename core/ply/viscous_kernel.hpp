// SPDX-License-Identifier: GPL-3.0-or-later
// What the kernels of membrane and bending need of laws with rates, core/ply/viscous_membrane.hpp
// and core/ply/viscous_bending.hpp: plain numbers and pointers, nothing inline (reason:
// base/simd.hpp). Symbols: core/model/viscous_shear.hpp. Seconds are those of the process.
#pragma once

#include "core/ply/simd_kernel.hpp"

namespace plyform {

struct SimdTriangles;
struct ViscousMembrane;

constexpr int most_viscous_terms = 8, most_branches = 8; ///< limits of the keys

/// A spring in line with a dashpot: K (N mm of a cell, N/mm of a melt), its inverse and K dt.
struct KernelSpring {
  double stiffness, per_stiffness, by_dt;
};

/// A branch in a step: (X), where nothing changes its time.
struct KernelBranch {
  double modulus, per_modulus; ///< G, N mm
  double keep, rise;
  double age; ///< dt / theta
};

struct KernelViscousCrossing {
  int crossing, first_state; ///< ViscousCrossing::state
  bool dashpot;
  double viscosity[most_viscous_terms]; ///< c, N mm s
  int terms;                            ///< 0: call `viscosity`
  KernelSpring shear, deviation;
  KernelBranch branch[most_branches];
  int branches;
  double smoothing; ///< of the told rate: dt / (dt + time)
  double cells;     ///< n_c, 1/mm^2
};

struct KernelMelt {
  double viscosity[2]; ///< of shear and of drawing apart, N s/mm
  KernelSpring spring;
  int first_state; ///< ViscousSheet::state
  double smoothing;
  double across[2]; ///< components of the direction across e_1
};

/// Laws with rates of a membrane in a step.
struct KernelViscous {
  double moves, per_dt; ///< 1 and 1/dt; both 0 at the start, where there is no motion yet
  int states;           ///< ViscousMembrane::states
  int crossings;
  KernelViscousCrossing crossing[most_kernel_crossings];
  bool has_melt;
  KernelMelt melt;
  /// States of the four triangles of each SimdTriangles from `first` on, and their factors of
  /// viscosities and times (null: 1).
  const SimdTriangles* first;
  const SimdNumbers* begin;
  SimdNumbers* end;
  const SimdNumbers* factors;
  const ViscousMembrane* law;
  /// c of four triangles, N mm s. index: into `crossing`; others: as ViscousShear::viscosity.
  void (*viscosity)(const KernelViscous&, int index, const double* angle, const double* driven,
                    const double* factor, double* out);
};

/// Dashpots of bending in a step.
struct KernelViscousBending {
  double moves;
  int families;                           ///< that have any
  int family[most_kernel_families];       ///< ascending
  double viscosity[most_kernel_families]; ///< eta, N mm s
  KernelSpring spring;
  /// States of the four nodes of each group of the block, ViscousBending::states, and factors of
  /// their viscosities (null: 1).
  int states;
  const SimdNumbers* begin;
  SimdNumbers* end;
  const SimdNumbers* factors;
};

} // namespace plyform
