// SPDX-License-Identifier: GPL-3.0-or-later
// Identifies Maxwell branches of shear (core/model/viscous_shear.hpp) from the load after a stop.
//
// A frame or bias test is drawn to a shear angle g_0 at a constant rate within the ramp T and held.
// Its load falls, from the end of the ramp (t = 0) on, by
//
//   F(t) = F_e + sum_k F_k e^(-t/theta_k)                                                      (P)
//
// a Prony series: times evenly over the logarithm of time, two a decade, or given, with loads that
// are not negative (nonnegative.hpp); neighbours that share one branch become one. By (40, 41) the
// load of a branch is that of its torque q_k at the end of the ramp, which is
//
//   q_k = G_k theta_k (1 - e^(-T/theta_k)) dg/dt,  dg/dt = g_0 / T                             (G)
//
// and G_k g_0 for a ramp short against theta_k; half of it in zones that shear by g/2. F_e is the
// elastic load, or of what relaxes more slowly than was waited.
#pragma once

#include "core/identify/curve_file.hpp"
#include "core/identify/fit_quality.hpp"
#include "core/identify/shear_tests.hpp"

#include <optional>
#include <vector>

namespace plyform {

struct RelaxationTest {
  ShearTest test;
  double angle = 0.0;             ///< g_0, rad
  double ramp = 0.0;              ///< T, s; 0: at once
  std::vector<double> times = {}; ///< theta_k, s, ascending; empty: looked for
};

/// One branch: G (N mm of a unit cell) and theta (s).
struct RelaxationBranch {
  double modulus = 0.0, time = 0.0;
};

struct RelaxationFit {
  std::vector<RelaxationBranch> branches;     ///< ascending by time; may be empty: nothing relaxes
  double rest_torque = 0.0;                   ///< N mm, of F_e
  double elastic_torque = 0.0;                ///< N mm, of the fabric's own law at g_0
  double relaxed_share = 0.0;                 ///< of the load at the stop
  FitQuality quality;                         ///< from, to, largest_at: s
  std::vector<double> time, measured, fitted; ///< s, N, N
};

/// Curve: x time (s) since the stop, y load (N). Reports an error and returns nothing for fewer
/// than eight rows, times that do not rise or cover less than a decade, a load that does not fall
/// where branches are looked for, rows of the ramp, and residuals of more than 20 %. Warns where
/// times seem to count from the start of the ramp.
std::optional<RelaxationFit> identify_relaxation(Curve curve, const RelaxationTest& test,
                                                 const Fabric& fabric, Diagnostics& diagnostics);

} // namespace plyform
