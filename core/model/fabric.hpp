// SPDX-License-Identifier: GPL-3.0-or-later
// A woven or biaxial non-crimp fabric: its laws of tension, shear and bending.
//
// Units inside the program: mm, N, s, t (1 t = 1 N s^2/mm). Source of the law's form: Hamila and
// Boisse 2008, section 3.5 and table 1.
#pragma once

#include "core/model/sheet_law.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace plyform {

/// Value and slope of a law at one point, and its integral from 0 (the stored energy).
struct LawPoint {
  double value, slope, energy;
};

/// Tangent stiffness of a buckled yarn over its compression stiffness: small, but large enough that
/// further shortening does not localise in one row of elements.
constexpr double buckled_share = 0.01;

/// Tension of one yarn against its strain: N = stiffness * strain, or a table. For strain <= 0
/// N = compression * strain; with compression 0, the paper's law, exactly zero. Compressed by more
/// than buckling_force, i.e. at strains below -buckling_force / compression, the slope is
/// buckled_share times that; unloading follows the same path (nonlinear elastic).
struct TensionLaw {
  double stiffness = 0.0;              ///< N per yarn; used when the table is empty
  std::vector<double> strain, tension; ///< ascending from (0, 0), linear between, last slope beyond
  /// N per yarn; at most largest_slope(), on which the stable step relies
  double compression = 0.0;
  double buckling_force = std::numeric_limits<double>::infinity(); ///< N, at least 0
  /// N (N per yarn), dN/dstrain (N), W = integral of N (N, i.e. N mm per mm of yarn).
  LawPoint at(double eps) const;
  double largest_slope() const; ///< N, in tension
  /// Whether the law has no table: stiffness, compression and buckling_force define it.
  bool linear() const { return strain.empty(); }
  bool buckles() const { return compression > 0.0 && std::isfinite(buckling_force); }
  double buckling_strain() const { return buckling_force / compression; } ///< of one that buckles
};

/// Factor by which a yarn's tension is actually divided if a softening of `asked` (at least 1) is
/// requested: limited so that the yarn stays as stiff in tension as in compression, which is never
/// softened. More would not lengthen the stable time step, which the stiffer of the two determines.
double effective_softening(const TensionLaw& law, double asked);

/// The law of a yarn effective_softening(law, asked) times as soft in tension. Compression is not
/// changed.
TensionLaw softened(TensionLaw law, double asked);

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

/// Bending of a sheet: core/ply/bending.hpp (M). All zero: none.
struct BendingLaw {
  MomentLaw warp, weft;
  double coupling = 0.0, twist = 0.0; ///< D_c, D_t, N mm
  std::array<double, 2> in_plane{};   ///< D_g of warp and weft, N mm
  bool any() const;
};

/// Where a number of a fabric comes from.
enum class ValueSource {
  given,     ///< in the fabric file, or by the code that made the fabric
  missing,   ///< not in the fabric file; the property is then zero
  estimated, ///< was missing and has been estimated: core/model/fabric_estimates.hpp
};

/// Sources of those properties of one family of yarns that a file may leave out.
struct YarnSources {
  ValueSource compression = ValueSource::given, bending = ValueSource::given,
              in_plane_bending = ValueSource::given;
};

/// mm/s^2, turns mass per area into weight.
inline constexpr double standard_gravity = 9810.0;

struct Fabric {
  std::string name;
  TensionLaw warp, weft;
  double warp_density = 0.0, weft_density = 0.0; ///< d1, d2: yarns per mm across the yarns
  ShearLaw shear;
  BendingLaw bending;
  double surface_density = 0.0;            ///< t/mm^2 (1 g/m^2 = 1e-12 t/mm^2)
  double thickness = 0.0;                  ///< mm
  double fibre_angle = 1.5707963267948966; ///< rad from warp to weft before forming, in (0, pi)
  std::optional<double> locking_angle;     ///< rad, shear angle beyond which the fabric wrinkles
  std::array<YarnSources, 2> sources;      ///< of warp and weft
  bool twist_given = true;                 ///< else bending.twist is usual_twist
  /// Law of a sheet without yarns: then the laws and densities above are all zero, and warp and
  /// weft are two orthogonal material directions without mechanical meaning.
  std::optional<SheetLaw> sheet;

  bool has_yarns() const { return !sheet; }
  double weight() const { return surface_density * standard_gravity; } ///< N/mm^2
};

/// Whether warp and weft have the same yarns at the same density.
bool balanced(const Fabric& fabric);

} // namespace plyform
