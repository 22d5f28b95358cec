// SPDX-License-Identifier: GPL-3.0-or-later
// From the curve of a strip or yarn test to the rows that a law is fitted to, and the table of a
// law that is no line.
#pragma once

#include "core/identify/fit_tension.hpp"

namespace plyform {

/// Rows after corrections, in the range asked for: strain, and N of one yarn.
struct TensionSpecimen {
  Curve curve; ///< x: strain, y: N per yarn
  Corrected corrected;
  LoadRows rows() const { return {vector_of(curve.x), vector_of(curve.y), {}}; }
};

/// Reports errors and returns nothing where identify_tension says so. `word`: strain or shortening.
std::optional<TensionSpecimen> tension_specimen(Curve curve, const Strip& strip,
                                                const FitOptions& options, const std::string& word,
                                                Diagnostics& diagnostics);

/// N = k e, 0 below 0: a slack yarn bears nothing.
LinearLaw line_law();

/// Whether a line that does not begin at zero follows the rows: then it is a line with a wrong
/// zero, not a curve, unless the user has given the zeros.
bool is_shifted_line(const Curve& curve, const Eigen::ArrayXd& weights,
                     const Corrections& corrections);

/// Piecewise linear from 0, with its tensions at the knots as coefficients, compared from a tenth
/// of the last knot on.
LinearLaw knots_law(const std::vector<double>& knots);

/// Strains of the table after 0, up to the last: those of the curve if they are few, else a
/// selection at even distances. None closer than 1/200 of the largest, where noise would give large
/// slopes.
std::vector<double> knots_of(const Curve& curve);

/// The table through these tensions, made to rise where noise makes it fall; reports an error and
/// returns nothing if the curve softens.
std::optional<TensionLaw> table_of(const Curve& curve, std::vector<double> knots,
                                   std::vector<double> tension, Diagnostics& diagnostics);

} // namespace plyform
