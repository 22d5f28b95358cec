// SPDX-License-Identifier: GPL-3.0-or-later
// Ellipses and splines of drawings, divided into pieces with ends on the curve.
//
//   ellipse   x(t) = c + a cos t + b sin t,  b = ratio (n x a), n the entity's normal, +-z
//   spline    x(u) = sum N_i,p(u) w_i P_i / sum N_i,p(u) w_i, by de Boor's recursion on the points
//             (w_i P_i, w_i); degree p, knots u_0 .. u_m, m = number of points + p; from u_p to
//             u_(m - p)
#pragma once

#include "contact/shapes/tool_shape.hpp"

#include <functional>
#include <string>
#include <vector>

namespace plyform {

/// A curve in the plane.
struct DxfCurve {
  std::function<Vec2(double)> at; ///< of the parameter, in the drawing's unit
  /// Ascending parameters, as close as the curve needs to be measured; a new list begins where it
  /// may have a corner.
  std::vector<std::vector<double>> runs;
  bool closed = false; ///< its end is its beginning
};

struct DxfEllipse {
  Vec2 centre, major;      ///< drawing's unit; from the centre to the end of the major axis
  double ratio, from, to;  ///< minor over major axis; rad, parameters of the ends
  bool from_below = false; ///< its normal is -z
};

struct DxfSpline {
  int degree;
  std::vector<double> knots;
  std::vector<Vec3> points; ///< (w x, w y, w)
  /// By its flags. Then the first p points follow the last once more, unless they do so already,
  /// where the knots repeat with the period that this takes:
  ///   P_n+i = P_i,  u_n+i - u_n = u_i - u_0,  i = 1 .. p                                      (1)
  bool closed = false;
};

/// Why it is no curve ("has ..."); empty if it is one.
std::string fault_of(const DxfEllipse& ellipse);
std::string fault_of(const DxfSpline& spline);

/// The curves of what has no fault.
DxfCurve curve_of(const DxfEllipse& ellipse);
DxfCurve curve_of(const DxfSpline& spline);

/// Lines whose ends lie on the curve, each along `spacing` (drawing's unit) of it at most and an
/// eighth of a turn, and no more than `most` of them. Empty if it has no length.
Profile divided(const DxfCurve& curve, double spacing, std::size_t most);

} // namespace plyform
