// SPDX-License-Identifier: GPL-3.0-or-later
// Laws that are linear in their coefficients k, so that the load is F = A(x) k, and their least
// squares.
//
// Weights. The load grows by two to three orders of magnitude over a shear test. Least squares of
// the load itself would fit the law near locking and hardly constrain the first 20 degrees, in
// which most of a part lies; least squares of the relative error would fit the noise of the load
// cell at the start. Therefore each row has the weight 1 / max(F, load_floor x the largest F):
// relative accuracy down to the load that a load cell can resolve. F is the fitted load, found by
// iteration: with the measured load, rows that read low would get more weight and the law would be
// biased low. Simulated bias tests of a glass weave, 60 rows up to 55 degrees, largest error of the
// law over the range in the worst 5 % of 300 tests, for a floor of 0.01, 0.1 and infinity (least
// squares of the load): 1 % noise of the load 0.9, 1.3 and 4.7 %; 0.5 % of the load and 0.2 % of
// the largest 8.4, 4.1 and 3.9 %.
//
// Limits of confidence. Covariance of the coefficients s^2 (A' W^2 A)^-1, s^2 = sum of squared
// weighted residuals over n - p; t of Student. Residuals of neighbouring rows that go together (a
// shape that the law does not have, a smoothed curve) count as fewer rows: n (1 - r) / (1 + r) with
// their correlation r (Bayley and Hammersley 1946, first order).
#pragma once

#include <Eigen/Dense>
#include <functional>
#include <vector>

namespace plyform {

/// Fraction of the largest load below which rows have equal weight.
inline constexpr double load_floor = 0.1;

struct LinearLaw {
  using Loads = std::function<Eigen::MatrixXd(const Eigen::VectorXd& x)>;
  Loads loads;            ///< A: a row for each x, a column for each coefficient
  Loads richer;           ///< with one coefficient more; empty if there is no such law
  Eigen::MatrixXd probes; ///< the law itself, P k, at the places where laws are compared
};

/// Coefficients of a law, and how sure they are.
struct LinearFit {
  Eigen::VectorXd k, fitted; ///< of each coefficient, of each row
  Eigen::ArrayXd weights;    ///< of each row
  Eigen::MatrixXd covariance;
  double freedom = 0.0; ///< of Student's t; at least 1
};

/// Weights 1 / max(fitted, floor).
Eigen::ArrayXd load_weights(const Eigen::VectorXd& fitted, const Eigen::VectorXd& measured);

/// Fits a k to `measured`, both with a row each, by load_weights; `share`: further weights of the
/// rows, or empty.
LinearFit fit_linear(const Eigen::MatrixXd& a, const Eigen::VectorXd& measured,
                     const Eigen::ArrayXd& share = Eigen::ArrayXd());

/// Sum of squared weighted residuals of the best k for given weights, and that k.
struct FixedFit {
  double squares = 0.0;
  Eigen::VectorXd k, residuals; ///< residuals: weighted
};
FixedFit fit_fixed(const Eigen::MatrixXd& a, const Eigen::VectorXd& measured,
                   const Eigen::ArrayXd& weights);

/// Degrees of freedom of residuals with p coefficients: of the rows that count as independent, and
/// `least` at least. Limits take four: a smooth misfit of a tenth of a percent would otherwise have
/// the t of a single row, 12.7.
double freedom_of(const Eigen::VectorXd& residuals, Eigen::Index coefficients, double least = 1.0);
inline constexpr double freedom_of_limits = 4.0;

/// Half widths of the 95 % limits: of each coefficient; of the law at each probe over its value.
Eigen::VectorXd limits_of_coefficients(const LinearFit& fit);
Eigen::VectorXd limits_of_values(const LinearFit& fit, const Eigen::MatrixXd& probes); // of P k
Eigen::VectorXd limits_of_law(const LinearFit& fit, const Eigen::MatrixXd& probes);

/// Largest change |P k1 / P k0 - 1| from k0 to k1 over the probes.
double law_change(const Eigen::MatrixXd& probes, const Eigen::VectorXd& k0,
                  const Eigen::VectorXd& k1);

Eigen::VectorXd vector_of(const std::vector<double>& values);

} // namespace plyform
