// SPDX-License-Identifier: GPL-3.0-or-later
// How cloth gives way through its thickness: pressure against thickness of one unformed ply between
// flat plates, down to its densest packing.
//
//   t    mm      thickness;  rho_A  t/mm^2  surface density;  rho_f  t/mm^3  density of its fibres
//   V    -       fibre volume fraction, rho_A / (rho_f t); V0 at the thickness without pressure
//   p    N/mm^2  pressure
//   p = s (V^n - V0^n)                                                                       (TM)
//
// (TM): S. Toll, J.-A. E. Manson, Elastic compression of a fiber network, J. Appl. Mech. 62, 1995,
// with its constants in one, s; n is about 3 for random mats, 5 for planar ones, 7 to 15 for
// rovings and cloth.
#pragma once

#include <vector>

namespace plyform {

/// Fibre volume fraction of circles that touch all round, pi / (2 sqrt(3)): no fibres are denser.
inline constexpr double densest_packing = 0.9069;

/// Thickness and pressure at successive points: from the unformed thickness without pressure down
/// to the densest packing.
struct ThicknessCurve {
  std::vector<double> thickness; ///< mm, descending
  std::vector<double> pressure;  ///< N/mm^2, ascending from 0
};

struct Compaction {
  ThicknessCurve loading;
  ThicknessCurve unloading; ///< from the densest packing, same order; empty: back as it came
  double nesting = 0.0;     ///< mm by which two of these plies on each other are thinner than apart

  double densest() const { return loading.thickness.back(); } ///< mm
};

/// (TM) from thickness t0 (mm) to the fibre volume `densest`, as points. weight: rho_A / rho_f, mm:
/// the thickness of its fibres alone.
ThicknessCurve toll_manson(double scale, double exponent, double densest, double weight, double t0);

} // namespace plyform
