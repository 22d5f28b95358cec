// SPDX-License-Identifier: GPL-3.0-or-later
// What slip does to a law of shear, where a shear angle was measured beside the extension; and what
// it may do where none was.
//
// A law of measured angles takes (40, 41) of shear_tests.hpp at the extension d_a that belongs to
// the measured angle by (a), not the measured rate dgamma/dd. The yarns that slide bear the load F
// too, in a row with the cells that shear: of the work F dd the part F dd_a shears, and
//
//   slip_work = integral of F (dd - dd_a) / integral of F dd
//
// is friction. Power balance with dgamma/dd of the measured curve, F dd = cells * Cs dgamma, would
// count this friction as shear: the torque would be larger by 1 / (1 - slip_work) in the mean. That
// is its upper bound, where slip costs nothing.
//
// How large slip is. Without a measured angle, that of a plain weave of 150 x 450 mm is taken (J.
// Cao et al. 2008, Composites A 39, 1037, figure 36): the middle lags behind (a) by 4 degrees where
// (a) says 26, by 8 to 9 at 44. Straight between. Not all of it is slip: a net of yarns of constant
// length has 2.8 and 3.4 degrees less in its very middle (docs/verification/measured.md).
#pragma once

#include "core/identify/fit_shear.hpp"

#include <string>
#include <vector>

namespace plyform {

/// rad (30 degrees): from about there yarns slip in bias-extension tests.
inline constexpr double slip_begins = 0.5235987755982988;

/// rad by which the measured angle lags behind that of (a), of the fabric above.
double usual_slip(double formula_angle);

/// What the formula without slip does at a measured angle.
struct SlipAt {
  double angle;   ///< rad
  double formula; ///< rad: what (a) says at the same rows; NaN where no angle was measured
  double torque;  ///< of the law of the formula over that of the measured angle, less 1
};

struct SlipEffect {
  std::vector<SlipAt> at; ///< at 10, 20, 30, 40 degrees within the range of both laws
  double work = 0.0;      ///< slip_work, of all curves
  std::string refusal;    ///< why the formula gives no law; then torques are NaN
};

/// Of curves with an extension and measured angles, and the law found from the angles. Curves,
/// test, fabric and options as for identify_shear.
SlipEffect slip_effect(const std::vector<Curve>& curves, const ShearTest& test,
                       const Fabric& fabric, const FitOptions& options, const ShearLaw& law);

/// What usual_slip would do, if it were there, to the law of curves without measured angles: the
/// law as found over the one of the angles that lag. `formula` is NaN.
SlipEffect possible_slip(const std::vector<Curve>& curves, const ShearTest& test,
                         const Fabric& fabric, const FitOptions& options, const ShearLaw& law);

/// Puts the shear angles of a second curve (x: displacement, y: angle, rad) beside the extensions
/// of a curve, by the monotone curve through them (PCHIP). Rows beyond its range leave, with a
/// warning; reports an error and returns false if less than two are left, or displacements fall.
bool put_angles(Curve& curve, Curve angles, Diagnostics& diagnostics);

} // namespace plyform
