// SPDX-License-Identifier: GPL-3.0-or-later
// (R) of fit_rates.hpp solved for all rows at once: linear in k and c, not in the unknowns of f(T).
#pragma once

#include "core/identify/flow_law.hpp"
#include "core/identify/linear_law.hpp"
#include "core/identify/normalised_force.hpp"
#include "core/identify/shear_rows.hpp"

#include <Eigen/Dense>
#include <vector>

namespace plyform {

/// One row of one specimen.
struct RatedRow {
  double extension, angle, rate, measured; ///< mm, rad, 1/s, N
  TorqueWeights weights;
  double temperature = 0.0;        ///< degC
  double share = 1.0, floor = 0.0; ///< of weights: of its specimen; N
  std::size_t specimen = 0;
};

struct RatedRows {
  std::vector<RatedRow> rows;
  double end = 0.0;                 ///< rad, the largest angle
  double rate = 1.0;                ///< 1/s, by which viscous columns are scaled
  double reference = 0.0;           ///< degC
  std::vector<double> temperatures; ///< degC, of the specimens
  bool warm = false;                ///< whether f(T) is looked for
};

/// Numbers of coefficients.
struct RatedSize {
  int elastic, viscous;
};

/// The law of a size.
struct RatedLaw {
  RatedSize size{};
  FlowLaw flow;
  Eigen::VectorXd p; ///< unknowns of f(T)
  FixedFit fit;
  Eigen::MatrixXd a; ///< (40, 41) of (R): elastic columns, then viscous ones
  Eigen::ArrayXd weights;

  /// N, of each row.
  Eigen::VectorXd viscous_load() const {
    return a.rightCols(size.viscous) * fit.k.tail(size.viscous);
  }
  Eigen::Index unknowns() const { return a.cols() + p.size(); }
};

/// form: of f(T), where all.warm.
RatedLaw solve_rated(const RatedRows& all, const RatedSize& size, FlowForm form);

/// Half widths of the 95 % limits, by the rows' residuals: of all coefficients, then of
/// FlowLaw::numbers.
Eigen::VectorXd limits_of(const RatedRows& all, const RatedLaw& law);

} // namespace plyform
