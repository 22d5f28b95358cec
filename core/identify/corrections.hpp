// SPDX-License-Identifier: GPL-3.0-or-later
// What a test machine adds to a curve, and how it is taken off.
//
//   load zero          the load cell shows F0 without load: F - F0
//   displacement zero  the specimen is taut from x0 on (slack, toe; negative: it was strained when
//                      the displacement was set to 0): x - x0, and rows below leave. Toe
//                      compensation of ASTM D638 and D5035, with the fabric's law in the place of
//                      the straight line
//   compliance         the machine, its load cell and clamps give way by c per N: x - c F
//   slip               a clamp lets go by s at once: x - s from there on
//
// F0, x0 and s may be given or found: the values with which the law fits best.
#pragma once

#include "core/identify/curve_file.hpp"
#include "core/identify/linear_law.hpp"

#include <optional>

namespace plyform {

struct Corrections {
  std::optional<double> load_zero;  ///< N
  std::optional<double> toe;        ///< x0, of the curve's x
  std::optional<double> compliance; ///< c, of the curve's x per N
  bool fit_load_zero = false, fit_toe = false, fit_slip = false;
  bool any_fit() const { return fit_load_zero || fit_toe || fit_slip; }
};

/// What has been taken off.
struct Corrected {
  double load_zero = 0.0, toe = 0.0, compliance = 0.0, slip = 0.0;
  double slip_at = 0.0; ///< x of the first row after the slip, corrected
  int slip_line = 0;    ///< first line after the slip
  double load_zero_limits = 0.0, toe_limits = 0.0, slip_limits = 0.0; ///< 95 %; 0: given
};

/// The rows that a law is fitted to.
struct LoadRows {
  Eigen::VectorXd x, y;
  Eigen::ArrayXd weights;
};

/// One disturbance with the size at which the law fits best.
struct Shift {
  double amount = 0.0, limits = 0.0; ///< 95 % limits
  std::size_t row = 0;               ///< of a slip: the first after it
  double error = 0.0;                ///< standard error, whatever the noise of each row
  FixedFit fit;                      ///< k of the law first; of a load zero that too
};
Shift best_load_zero(const LinearLaw& law, const LoadRows& rows);
Shift best_toe(const LinearLaw& law, const LoadRows& rows);
/// x too large by a share: amount = share of x.
Shift best_stretch(const LinearLaw& law, const LoadRows& rows);
Shift best_slip(const LinearLaw& law, const LoadRows& rows);

/// Takes given values off a curve and adds them to `done`; reports an error and returns false if
/// the compliance takes more than there is. `word`: "extension".
bool apply_given(Curve& curve, const Corrections& corrections, const std::string& word,
                 Corrected& done, Diagnostics& diagnostics);

/// Finds the values that are asked for, of rows with x in [from, to], and takes them off.
void apply_fitted(Curve& curve, const Corrections& corrections, const LinearLaw& law, double from,
                  double to, Corrected& done);

/// The covariance of a fit to corrected rows when what was found and taken off is as unsure as the
/// coefficients.
LinearFit with_found(LinearFit fit, const LinearLaw& law, const LoadRows& rows,
                     const Corrections& corrections, const Corrected& done);

/// Removes the rows below 0, which are before the specimen was taut; reports an error and returns
/// false if less than two are left. `word`: "extension".
bool drop_slack(Curve& curve, const std::string& word, Diagnostics& diagnostics);

} // namespace plyform
