// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/identify/linear_law.hpp"

#include "core/identify/statistics.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {

Eigen::ArrayXd load_weights(const Eigen::VectorXd& fitted, const Eigen::VectorXd& measured) {
  return fitted.array().max(load_floor * measured.maxCoeff()).inverse();
}

FixedFit fit_fixed(const Eigen::MatrixXd& a, const Eigen::VectorXd& measured,
                   const Eigen::ArrayXd& weights) {
  FixedFit fit;
  const Eigen::MatrixXd weighted = weights.matrix().asDiagonal() * a;
  const Eigen::VectorXd target = (weights * measured.array()).matrix();
  fit.k = weighted.colPivHouseholderQr().solve(target);
  fit.residuals = target - weighted * fit.k;
  fit.squares = fit.residuals.squaredNorm();
  return fit;
}

double freedom_of(const Eigen::VectorXd& residuals, Eigen::Index coefficients, double least) {
  const Eigen::Index n = residuals.size();
  const double squares = residuals.squaredNorm();
  double correlation = 0.0;
  if (n > 2 && squares > 0.0)
    correlation = residuals.head(n - 1).dot(residuals.tail(n - 1)) / squares;
  correlation = std::clamp(correlation, 0.0, 0.95);
  const double independent = static_cast<double>(n) * (1.0 - correlation) / (1.0 + correlation);
  const double most = std::max(1.0, static_cast<double>(n - coefficients));
  return std::clamp(independent - static_cast<double>(coefficients), std::min(least, most), most);
}

LinearFit fit_linear(const Eigen::MatrixXd& a, const Eigen::VectorXd& measured,
                     const Eigen::ArrayXd& share) {
  LinearFit fit;
  fit.fitted = measured;
  FixedFit step;
  constexpr int repeats = 20; // converges in three or four iterations
  for (int i = 0; i < repeats; ++i) {
    fit.weights = load_weights(fit.fitted, measured);
    if (share.size() > 0) fit.weights *= share;
    step = fit_fixed(a, measured, fit.weights);
    const Eigen::VectorXd before = fit.fitted;
    fit.fitted = a * step.k;
    if ((fit.fitted - before).norm() <= 1e-12 * fit.fitted.norm()) break;
  }
  fit.k = step.k;
  fit.freedom = freedom_of(step.residuals, a.cols(), freedom_of_limits);
  const Eigen::MatrixXd weighted = fit.weights.matrix().asDiagonal() * a;
  const Eigen::MatrixXd inverse =
      (weighted.transpose() * weighted).completeOrthogonalDecomposition().pseudoInverse();
  fit.covariance = inverse * (step.squares / fit.freedom); // of the rows that are independent
  return fit;
}

Eigen::VectorXd limits_of_coefficients(const LinearFit& fit) {
  return student_95(fit.freedom) * fit.covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
}

Eigen::VectorXd limits_of_values(const LinearFit& fit, const Eigen::MatrixXd& probes) {
  const Eigen::ArrayXd variances =
      (probes * fit.covariance * probes.transpose()).diagonal().array();
  return (student_95(fit.freedom) * variances.max(0.0).sqrt()).matrix();
}

Eigen::VectorXd limits_of_law(const LinearFit& fit, const Eigen::MatrixXd& probes) {
  return limits_of_values(fit, probes).cwiseQuotient((probes * fit.k).cwiseAbs());
}

double law_change(const Eigen::MatrixXd& probes, const Eigen::VectorXd& k0,
                  const Eigen::VectorXd& k1) {
  const Eigen::ArrayXd before = (probes * k0).array(), after = (probes * k1).array();
  const double change = (after / before - 1.0).abs().maxCoeff();
  return std::isfinite(change) ? change : 1e9;
}

Eigen::VectorXd vector_of(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

} // namespace plyform
