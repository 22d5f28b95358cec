// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/identify/rated_law.hpp"

#include "core/identify/statistics.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

constexpr double most_energy = 4e5; // J/mol

Eigen::MatrixXd columns_of(const RatedRows& all, const RatedSize& size, const FlowLaw& flow,
                           const Eigen::VectorXd& p) {
  Eigen::MatrixXd a(static_cast<Eigen::Index>(all.rows.size()), size.elastic + size.viscous);
  for (Eigen::Index i = 0; i < a.rows(); ++i) {
    const RatedRow& row = all.rows[static_cast<std::size_t>(i)];
    const double u = row.angle / all.end, whole = row.weights.whole, half = row.weights.half;
    for (int c = 0; c < size.elastic; ++c)
      a(i, c) = whole * std::pow(u, 2 * c + 1) + half * std::pow(0.5 * u, 2 * c + 1);
    const double rate = flow.factor(p, row.temperature) * row.rate / all.rate;
    for (int c = 0; c < size.viscous; ++c)
      a(i, size.elastic + c) =
          rate * (whole * std::pow(u, 2 * c) + 0.5 * half * std::pow(0.5 * u, 2 * c));
  }
  return a;
}

Eigen::VectorXd measured_of(const RatedRows& all) {
  Eigen::VectorXd y(static_cast<Eigen::Index>(all.rows.size()));
  for (Eigen::Index i = 0; i < y.size(); ++i)
    y[i] = all.rows[static_cast<std::size_t>(i)].measured;
  return y;
}

Eigen::ArrayXd weights_by(const RatedRows& all, const Eigen::VectorXd& fitted) {
  Eigen::ArrayXd w(fitted.size());
  for (Eigen::Index i = 0; i < w.size(); ++i) {
    const RatedRow& row = all.rows[static_cast<std::size_t>(i)];
    w[i] = row.share / std::max(fitted[i], row.floor);
  }
  return w;
}

/// The best coefficients for given unknowns of f(T).
void fit_coefficients(const RatedRows& all, const Eigen::VectorXd& measured, RatedLaw& law) {
  law.a = columns_of(all, law.size, law.flow, law.p);
  law.fit = fit_fixed(law.a, measured, law.weights);
}

/// Derivatives of the fitted load by FlowLaw::numbers, by central differences.
Eigen::MatrixXd slopes(const RatedRows& all, const RatedLaw& law) {
  const Eigen::VectorXd numbers = law.flow.numbers(law.p);
  Eigen::MatrixXd d(law.a.rows(), numbers.size());
  for (Eigen::Index i = 0; i < numbers.size(); ++i) {
    const double step = 1e-4 * std::max(numbers[i], 1e-6);
    const auto load = [&](double by) {
      Eigen::VectorXd at = numbers;
      at[i] += by;
      return Eigen::VectorXd(columns_of(all, law.size, law.flow, law.flow.unknowns_of(at)) *
                             law.fit.k);
    };
    d.col(i) = (load(step) - load(-step)) / (2.0 * step);
  }
  return d;
}

/// Gauss and Newton's step of p with all coefficients, shortened until squares fall: coefficients
/// are then solved for anew. Returns whether they fell by more than rounding.
bool step_flow(const RatedRows& all, const Eigen::VectorXd& measured, RatedLaw& law) {
  const Eigen::Index n = law.a.cols(), m = law.p.size();
  Eigen::MatrixXd j(law.a.rows(), n + m);
  j.leftCols(n) = law.a;
  for (Eigen::Index i = 0; i < m; ++i) {
    Eigen::VectorXd other = law.p;
    const double step = 1e-6 * std::max(std::abs(other[i]), 1e-6);
    other[i] += step;
    j.col(n + i) =
        (columns_of(all, law.size, law.flow, other) * law.fit.k - law.a * law.fit.k) / step;
  }
  const Eigen::VectorXd lengths = (law.weights.matrix().asDiagonal() * j).colwise().norm();
  const Eigen::VectorXd scale = lengths.cwiseMax(1e-300).cwiseInverse();
  const Eigen::MatrixXd scaled = law.weights.matrix().asDiagonal() * j * scale.asDiagonal();
  const Eigen::VectorXd residual = (law.weights * (measured - law.a * law.fit.k).array()).matrix();
  const Eigen::VectorXd way =
      scale.cwiseProduct(scaled.completeOrthogonalDecomposition().solve(residual)).tail(m);
  constexpr int halvings = 20;
  double by = 1.0;
  for (int i = 0; i < halvings; ++i, by *= 0.5) {
    RatedLaw next = law;
    next.p = law.p + by * way;
    if (!next.flow.allowed(next.p)) continue;
    fit_coefficients(all, measured, next);
    if (!(next.fit.squares < law.fit.squares)) continue;
    const bool fell = next.fit.squares < (1.0 - 1e-9) * law.fit.squares;
    law = std::move(next);
    return fell;
  }
  return false;
}

/// Solves for the unknowns of f(T), from where they are.
void solve_flow(const RatedRows& all, const Eigen::VectorXd& measured, RatedLaw& law) {
  fit_coefficients(all, measured, law);
  constexpr int most = 50;
  for (int i = 0; i < most && law.p.size() > 0; ++i)
    if (!step_flow(all, measured, law)) return;
}

/// Where that begins: at the best law of Arrhenius.
Eigen::VectorXd start_of(const RatedRows& all, const Eigen::VectorXd& measured,
                         const RatedLaw& law) {
  if (law.flow.unknowns() == 0) return {};
  const auto squares = [&](double energy) {
    return fit_fixed(columns_of(all, law.size, law.flow, law.flow.as_arrhenius(energy)), measured,
                     law.weights)
        .squares;
  };
  return law.flow.as_arrhenius(minimum_of(squares, 0.0, most_energy));
}

} // namespace

RatedLaw solve_rated(const RatedRows& all, const RatedSize& size, FlowForm form) {
  const Eigen::VectorXd measured = measured_of(all);
  const FlowLaw flow(all.warm ? form : FlowForm::none, all.reference, all.temperatures);
  RatedLaw law{size, flow, {}, {}, {}, weights_by(all, measured)};
  law.p = start_of(all, measured, law);
  constexpr int repeats = 12; // weights follow the fitted loads
  for (int i = 0; i < repeats; ++i) {
    solve_flow(all, measured, law);
    const Eigen::ArrayXd before = law.weights;
    law.weights = weights_by(all, law.a * law.fit.k);
    if (((law.weights - before) / before).abs().maxCoeff() < 1e-6) break;
  }
  return law;
}

Eigen::VectorXd limits_of(const RatedRows& all, const RatedLaw& law) {
  Eigen::MatrixXd a(law.a.rows(), law.unknowns());
  a << law.a, slopes(all, law);
  Eigen::MatrixXd w = law.weights.matrix().asDiagonal() * a;
  const Eigen::VectorXd scale = w.colwise().norm().cwiseMax(1e-300).cwiseInverse().transpose();
  w = w * scale.asDiagonal();
  const double freedom = freedom_of(law.fit.residuals, law.unknowns(), freedom_of_limits);
  const Eigen::MatrixXd inverse =
      (w.transpose() * w).completeOrthogonalDecomposition().pseudoInverse();
  return student_95(freedom) *
         scale.cwiseProduct(
             (inverse.diagonal() * (law.fit.squares / freedom)).cwiseMax(0.0).cwiseSqrt());
}

} // namespace plyform
