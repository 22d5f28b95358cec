// SPDX-License-Identifier: GPL-3.0-or-later
// A woven or biaxial non-crimp fabric: what its yarns and cells answer to stretch and shear.
//
// Units inside the program: mm, N, s, t (1 t = 1 N s^2/mm). Source of the law's form: Hamila and
// Boisse 2008, section 3.5 and table 1.
#pragma once

#include "core/isotropic.hpp"

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace plyform {

/// Value and slope of a law at one point, and its integral from 0 (the stored energy).
struct LawPoint {
  double value, slope, energy;
};

/// Tension of one yarn against its strain: N = stiffness * strain, or a table. For strain <= 0
/// N = compression * strain; with compression 0, the paper's law, exactly zero.
struct TensionLaw {
  double stiffness = 0.0;              ///< N per yarn; used when the table is empty
  std::vector<double> strain, tension; ///< ascending from (0, 0), linear between, last slope beyond
  double compression = 0.0; ///< N per yarn; no more than largest_slope(), or steps are not stable
  /// N: a yarn pressed with more gives way and takes hardly more.
  double buckling_force = std::numeric_limits<double>::infinity();
  /// N (N per yarn), dN/dstrain (N), W = integral of N (N, i.e. N mm per mm of yarn).
  LawPoint at(double eps) const;
  double largest_slope() const; ///< N, in tension
};

/// The law of a yarn `by` times as soft in tension. Compression stays as it is, but for what would
/// be stiffer than the tension that is left.
TensionLaw softened(TensionLaw law, double by);

/// Torque that warp and weft exert on each other in one unit cell against the shear angle: odd
/// polynomial k[0] g + k[1] g^3 + k[2] g^5 ..., or an odd table (given for g >= 0).
struct ShearLaw {
  std::vector<double> k;             ///< N mm, coefficients of g, g^3, g^5 ...
  std::vector<double> angle, torque; ///< rad and N mm, ascending from (0, 0); last slope beyond
  /// Cs (N mm), dCs/dg (N mm/rad), Ws (N mm); g in rad, of either sign.
  LawPoint at(double g) const;
  double secant(double g) const; ///< Cs(g) / g, N mm; its limit at 0
};

/// Moment per width against curvature, odd: M = stiffness * kappa, or a table for kappa >= 0.
struct MomentLaw {
  double stiffness = 0.0;                ///< N mm (per mm of width: N mm^2/mm)
  std::vector<double> curvature, moment; ///< 1/mm and N, ascending from (0, 0); last slope beyond
  /// M (N), dM/dkappa (N mm), W (N/mm); kappa in 1/mm, of either sign.
  LawPoint at(double kappa) const;
  double largest_slope() const; ///< N mm
};

/// Bending of a sheet: core/bending.hpp (M). All zero: none.
struct BendingLaw {
  MomentLaw warp, weft;
  double coupling = 0.0, twist = 0.0; ///< D_c, D_t, N mm
  std::array<double, 2> in_plane{};   ///< D_g of warp and weft, N mm
  bool any() const;
};

struct Fabric {
  std::string name;
  TensionLaw warp, weft;
  double warp_density = 0.0, weft_density = 0.0; ///< d1, d2: yarns per mm across the yarns
  ShearLaw shear;
  BendingLaw bending;
  double surface_density = 0.0;            ///< t/mm^2 (1 g/m^2 = 1e-12 t/mm^2)
  double thickness = 0.0;                  ///< mm
  double fibre_angle = 1.5707963267948966; ///< rad from warp to weft before forming, in (0, pi)
  std::optional<double> locking_angle;     ///< rad of shear, beyond which it wrinkles
  /// A sheet without yarns: then the laws and densities above are all zero, and the directions of
  /// warp and weft, at right angles, only mark the material.
  std::optional<IsotropicLaw> isotropic;
};

/// Whether warp and weft are the same yarn at the same distance.
bool balanced(const Fabric& fabric);

} // namespace plyform
