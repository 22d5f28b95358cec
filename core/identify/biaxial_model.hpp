// SPDX-License-Identifier: GPL-3.0-or-later
// Loads of biaxial tests by a crimped cell, and their least squares: the core of fit_biaxial.hpp.
#pragma once

#include "core/identify/fit_biaxial.hpp"

#include <Eigen/Dense>

namespace plyform {

/// What is fitted: ln of the slopes of each yarn's law, `pieces` of each, the crimps, and the zeros
/// of strain.
struct BiaxialModel {
  const std::vector<BiaxialCurve>* curves = nullptr;
  std::array<double, 2> half_wave{}; ///< mm
  int pieces = 1;                    ///< 1: a line
  std::array<double, 2> longest{};   ///< largest elongation of each yarn, of tables
  std::vector<StrainZero> zeros{};   ///< without their amounts

  Eigen::Index numbers() const { return 2 * pieces + 2 + static_cast<Eigen::Index>(zeros.size()); }
  TensionLaw yarn(const Eigen::VectorXd& p, std::size_t a) const;
  double crimp(const Eigen::VectorXd& p, std::size_t a) const;
  CrimpedCell cell(const Eigen::VectorXd& p) const;
  /// N per yarn, two for each row of each curve, one behind the other.
  Eigen::VectorXd loads(const Eigen::VectorXd& p) const;
  Eigen::VectorXd measured() const;
};

struct BiaxialSolution {
  Eigen::VectorXd p, fitted, residuals; ///< residuals: weighted
  Eigen::MatrixXd covariance;
  double squares = 0.0, freedom = 0.0;
  double limits(Eigen::Index i) const; ///< half width of the 95 % limits of p[i]
};

/// The best numbers from a start; weights follow the fitted loads.
BiaxialSolution solve_biaxial(const BiaxialModel& model, const Eigen::VectorXd& start);

/// The same from several starts: stiffnesses from the loads, crimps from 0.1 to 3 %.
BiaxialSolution solve_biaxial(const BiaxialModel& model);

/// A start for more pieces, or with more zeros, from a solution of fewer.
Eigen::VectorXd start_from(const BiaxialModel& model, const BiaxialModel& less,
                           const Eigen::VectorXd& p);

} // namespace plyform
