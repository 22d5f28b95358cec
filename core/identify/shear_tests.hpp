// SPDX-License-Identifier: GPL-3.0-or-later
// The two tests for the shear law of a woven fabric: their load from its torque.
//
// Symbols: d extension (mm), gamma shear angle (rad), F load (N), d1, d2 yarns per mm across warp
// and weft, Cs(gamma) torque of one unit cell of 1/(d1 d2) mm^2 (N mm), D the diagonal that
// lengthened by the extension (mm). In both tests the net of inextensible yarns at 90 degrees
// deforms like a hinged square of that diagonal:
//
//   cos((pi/2 - gamma) / 2) = (D + d) / (sqrt(2) D),  or  sin(gamma) = (1 + d/D)^2 - 1         (a)
//   dgamma/dd = 2 / (sqrt(2) D sqrt(1 - ((D + d) / (sqrt(2) D))^2)) = 2 (1 + d/D) / (D cos gamma)
//                                                                                             (b)
//
// and the power of the load equals that of the cells, with gamma/2 in the half-sheared zones:
//
//   F = d1 d2 (S_whole Cs(gamma) + S_half Cs(gamma/2) / 2) dgamma/dd                      (40, 41)
//
// Bias extension, specimen L x w, yarns at +-45 degrees to L: D = L - w, S_whole = w (2L - 3w)/2,
// S_half = w^2; the rest, w^2/2 at the clamps, does not shear. Picture frame of side a, filled by
// the fabric: D = sqrt(2) a, S_whole = a^2, S_half = 0, then (40, 41) is
// F = d1 d2 a^2 sqrt(2) Cs / (a (cos(gamma/2) - sin(gamma/2))).
//
// Source: Hamila and Boisse 2008, equations (40) and (41). Valid for 0 <= gamma < 90 degrees and
// L >= 2w: in a shorter specimen some yarns are clamped at one end while those that cross them are
// clamped at the other, and its zones are not those of (40). Uniform shear in the zones is an
// assumption: the minimum energy of an inextensible net is 1 to 2 % below (40).
#pragma once

#include "core/model/fabric.hpp"

#include <optional>
#include <string>

namespace plyform {

/// Whether a fabric has two families and one crossing of them, and no sheet beside them; stitches
/// add what core/identify/stitch_load.hpp says.
bool is_biaxial(const Fabric& fabric);

/// Free length between the clamps and width, mm.
struct BiasSpecimen {
  double length, width;
};

/// Side from hinge to hinge, mm.
struct FrameSpecimen {
  double side;
};

/// Geometry of either test for (a), (b) and (40, 41): D (mm), S_whole, S_half (mm^2).
struct ShearTest {
  double diagonal, whole_area, half_area;
};

/// Reason why the equations do not hold for a specimen: size, its value (mm), rule and remedy.
struct SpecimenFault {
  std::string size; ///< length, width or side
  double value;
  std::string rule, remedy;
};
std::optional<SpecimenFault> fault_of(const BiasSpecimen& specimen);
std::optional<SpecimenFault> fault_of(const FrameSpecimen& specimen);

/// Throw std::invalid_argument for a specimen with a fault.
ShearTest shear_test(const BiasSpecimen& specimen);
ShearTest shear_test(const FrameSpecimen& specimen);

/// Side (mm) of the frame that a test is of.
double side_of(const ShearTest& frame);

/// Extension (mm) at which gamma would be 90 degrees; (40, 41) hold below it.
double locking_extension(const ShearTest& test);

/// gamma (rad) by (a), of the extension's sign; NaN where |gamma| would exceed 90 degrees.
double shear_angle(const ShearTest& test, double extension);

/// Extension (mm) at a shear angle (rad), by (a).
double extension_at(const ShearTest& test, double angle);

/// The load is linear in the torque: F = whole Cs(gamma) + half Cs(gamma/2), weights in 1/mm.
struct TorqueWeights {
  double angle; ///< gamma, rad
  double whole, half;
};
TorqueWeights torque_weights(const ShearTest& test, const Fabric& fabric, double extension);

/// F (N) by (40, 41), from the fabric's densities and shear law. negative: of a specimen that lies
/// the other way round, so that the angle from the first family to the second opens and
/// Cs(gamma) is -Cs(-gamma) of a law of both signs.
double test_load(const ShearTest& test, const Fabric& fabric, double extension,
                 bool negative = false);

/// What bending of the yarns in their plane adds to F of a bias-extension test, over F by (40).
///
/// A net of inextensible yarns shears by phi(s) + phi(t) along its two families, with phi = 0 where
/// a clamp holds the yarns. Bending (core/ply/bending.hpp) lets phi come up like 1 - exp(-s/l),
/// l^2 = D_g / (n_c Cs'(0)), at both ends of the D / sqrt(2) of each yarn between the clamps: the
/// same extension needs phi larger by the share 2 sqrt(2) l / D, and so the load. Slack yarns
/// shorten in the corners at the clamps, which take half of the step, at half of the energy. What
/// a specimen adds lies in between, by what its yarns bear when pressed: docs/users/identify.md has
/// both ends beside simulated tests. First order in l / D.
struct BendingShare {
  double least = 0.0, most = 0.0; ///< of slack yarns, of yarns of constant length
  double mean() const { return 0.5 * (least + most); }
};

/// Mean of warp and weft; 0 in a picture frame, whose clamps turn with the yarns, and without D_g.
BendingShare in_plane_bending_share(const ShearTest& test, const Fabric& fabric);

} // namespace plyform
