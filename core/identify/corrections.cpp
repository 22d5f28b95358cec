// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/identify/corrections.hpp"

#include "base/format.hpp"
#include "core/identify/statistics.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// Largest displacement zero and slip that are looked for, over the largest x; largest stretch.
constexpr double largest_toe = 0.1, largest_slip = 0.25, largest_stretch = 0.25;

/// dF/dx of the law with coefficients k.
VectorXd slope_of(const LinearLaw& law, const VectorXd& x, const VectorXd& k) {
  const double h = 1e-4 * x.maxCoeff();
  const VectorXd below = (x.array() - h).max(0.0).matrix(), above = (x.array() + h).matrix();
  return ((law.loads(above) - law.loads(below)) * k).cwiseQuotient(above - below);
}

/// 1 from row `row` on.
VectorXd step_at(Index rows, std::size_t row) {
  VectorXd step = VectorXd::Zero(rows);
  step.tail(rows - std::min(rows, static_cast<Index>(row))).setOnes();
  return step;
}

Eigen::MatrixXd beside(const Eigen::MatrixXd& a, const VectorXd& column) {
  Eigen::MatrixXd both(a.rows(), a.cols() + 1);
  both << a, column;
  return both;
}

/// Limits and standard error of a further coefficient with this column. Limits: from the covariance
/// of all. Error: from each row's own residual over 1 - its leverage, as small loads have other
/// noise than large ones (MacKinnon and White 1985, HC3).
void put_errors(const Eigen::MatrixXd& a, const VectorXd& column, const Eigen::ArrayXd& weights,
                Shift& shift) {
  const Eigen::MatrixXd j = weights.matrix().asDiagonal() * beside(a, column);
  const Eigen::MatrixXd inverse =
      (j.transpose() * j).completeOrthogonalDecomposition().pseudoInverse();
  const VectorXd& residuals = shift.fit.residuals;
  const double freedom = freedom_of(residuals, j.cols());
  shift.limits =
      student_95(freedom) * std::sqrt(shift.fit.squares / freedom * inverse(a.cols(), a.cols()));
  const VectorXd influence = j * inverse.col(a.cols());
  const Eigen::ArrayXd leverage = (j * inverse).cwiseProduct(j).rowwise().sum().array();
  const Eigen::ArrayXd own = residuals.array() / (1.0 - leverage.min(0.99));
  const double neighbours = (static_cast<double>(j.rows() - j.cols())) / freedom;
  shift.error = std::sqrt(neighbours * (influence.array() * own).square().sum());
}

/// Best amount of a disturbance that moves x by amount * direction.
Shift best_move(const LinearLaw& law, const LoadRows& rows, const VectorXd& direction, double least,
                double most) {
  Shift shift;
  const auto moved = [&](double amount) { return VectorXd(rows.x - amount * direction); };
  shift.amount = minimum_of(
      [&](double amount) {
        return fit_fixed(law.loads(moved(amount)), rows.y, rows.weights).squares;
      },
      least, most);
  const VectorXd x = moved(shift.amount);
  const Eigen::MatrixXd a = law.loads(x);
  shift.fit = fit_fixed(a, rows.y, rows.weights);
  const VectorXd column = -slope_of(law, x, shift.fit.k).cwiseProduct(direction);
  put_errors(a, column, rows.weights, shift);
  return shift;
}

/// The row before which a slip reduces the residuals most, to first order in the slip.
std::size_t slip_row(const LinearLaw& law, const LoadRows& rows) {
  const Eigen::MatrixXd a = law.loads(rows.x);
  const FixedFit plain = fit_fixed(a, rows.y, rows.weights);
  const VectorXd slope = slope_of(law, rows.x, plain.k);
  const auto n = static_cast<std::size_t>(rows.x.size());
  constexpr std::size_t ends = 3, places = 200; // rows before and after; rows tried at first
  std::size_t best = 0;
  double least = plain.squares;
  const auto attempt = [&](std::size_t row) {
    const VectorXd column = -slope.cwiseProduct(step_at(rows.x.size(), row));
    const FixedFit fit = fit_fixed(beside(a, column), rows.y, rows.weights);
    if (!(fit.squares < least) || !(fit.k[a.cols()] > 0.0)) return;
    least = fit.squares;
    best = row;
  };
  const std::size_t apart = std::max<std::size_t>(1, n / places);
  for (std::size_t row = ends; row + ends < n; row += apart)
    attempt(row);
  const std::size_t around = best;
  for (std::size_t row = around > apart + ends ? around - apart : ends;
       apart > 1 && around > 0 && row < std::min(around + apart, n - ends); ++row)
    attempt(row);
  return best;
}

/// What is left of a slip that has been taken off before this row.
Shift more_slip(const LinearLaw& law, const LoadRows& rows, std::size_t row) {
  const double most = 0.2 * largest_slip * rows.x.maxCoeff();
  Shift shift = best_move(law, rows, step_at(rows.x.size(), row), -most, most);
  shift.row = row;
  return shift;
}

/// The rows with x in [from, to], and the number of the first.
LoadRows load_rows(const Curve& curve, double from, double to, std::size_t& first) {
  std::vector<double> x, y;
  first = curve.size();
  for (std::size_t i = 0; i < curve.size(); ++i) {
    if (curve.x[i] < from || curve.x[i] > to) continue;
    first = std::min(first, i);
    x.push_back(curve.x[i]);
    y.push_back(curve.y[i]);
  }
  return {vector_of(x), vector_of(y), {}};
}

void subtract(std::vector<double>& values, double amount, std::size_t first = 0) {
  for (std::size_t i = first; i < values.size(); ++i)
    values[i] -= amount;
}

} // namespace

Shift best_load_zero(const LinearLaw& law, const LoadRows& rows) {
  const Eigen::MatrixXd a = law.loads(rows.x);
  const VectorXd ones = VectorXd::Ones(rows.x.size());
  Shift shift;
  shift.fit = fit_fixed(beside(a, ones), rows.y, rows.weights);
  shift.amount = shift.fit.k[a.cols()];
  put_errors(a, ones, rows.weights, shift);
  return shift;
}

Shift best_toe(const LinearLaw& law, const LoadRows& rows) {
  const double most = largest_toe * rows.x.maxCoeff();
  return best_move(law, rows, VectorXd::Ones(rows.x.size()), -most, most);
}

Shift best_stretch(const LinearLaw& law, const LoadRows& rows) {
  return best_move(law, rows, rows.x, 0.0, largest_stretch);
}

Shift best_slip(const LinearLaw& law, const LoadRows& rows) {
  const std::size_t row = slip_row(law, rows);
  if (row == 0) {
    Shift none;
    none.fit = fit_fixed(law.loads(rows.x), rows.y, rows.weights);
    return none;
  }
  Shift shift =
      best_move(law, rows, step_at(rows.x.size(), row), 0.0, largest_slip * rows.x.maxCoeff());
  shift.row = row;
  return shift;
}

bool apply_given(Curve& curve, const Corrections& corrections, const std::string& word,
                 Corrected& done, Diagnostics& diagnostics) {
  done.load_zero += corrections.load_zero.value_or(0.0);
  done.toe += corrections.toe.value_or(0.0);
  done.compliance = corrections.compliance.value_or(0.0);
  subtract(curve.y, corrections.load_zero.value_or(0.0));
  subtract(curve.x, corrections.toe.value_or(0.0));
  if (done.compliance == 0.0) return true;
  const auto most =
      static_cast<std::size_t>(std::max_element(curve.y.begin(), curve.y.end()) - curve.y.begin());
  const double taken = done.compliance * curve.y[most];
  if (!(taken < 0.9 * curve.x[most])) {
    diagnostics.error({curve.file, curve.line[most], 1}, "compliance",
                      fmt::format("{:g}", done.compliance),
                      fmt::format("takes {:.3g} off the {} of {:.3g}: nine tenths or more", taken,
                                  word, curve.x[most]),
                      "give the compliance of machine and clamps in mm/N, and check the units of "
                      "the columns; a machine so soft needs an extensometer");
    return false;
  }
  for (std::size_t i = 0; i < curve.size(); ++i)
    curve.x[i] -= done.compliance * curve.y[i];
  curve = sorted_by_x(curve);
  return true;
}

void apply_fitted(Curve& curve, const Corrections& corrections, const LinearLaw& law, double from,
                  double to, Corrected& done) {
  constexpr int rounds = 4; // each finds one with the others taken off
  Corrected found;
  std::size_t slip_at = 0;
  std::size_t first = 0;
  const auto rows_now = [&] {
    LoadRows rows = load_rows(curve, from, to, first);
    rows.weights = fit_linear(law.loads(rows.x), rows.y).weights;
    return rows;
  };
  const auto enough = [&] { // what was found may have moved rows out of the range
    return load_rows(curve, from, to, first).x.size() > law.probes.cols() + 2;
  };
  for (int round = 0; round < rounds; ++round) {
    if (corrections.fit_load_zero && enough()) {
      const Shift shift = best_load_zero(law, rows_now());
      found.load_zero += shift.amount;
      found.load_zero_limits = shift.limits;
      subtract(curve.y, shift.amount);
    }
    const bool slip_within = enough() && (round == 0 || slip_at > first);
    if (corrections.fit_slip && slip_within) {
      const LoadRows rows = rows_now();
      const Shift shift = round == 0 ? best_slip(law, rows) : more_slip(law, rows, slip_at - first);
      if (round == 0 && shift.row > 0) slip_at = first + shift.row;
      if (slip_at > 0) {
        found.slip += shift.amount;
        found.slip_limits = shift.limits;
        found.slip_line = curve.line[slip_at];
        subtract(curve.x, shift.amount, slip_at);
      }
    }
    if (corrections.fit_toe && enough()) {
      const Shift shift = best_toe(law, rows_now());
      found.toe += shift.amount;
      found.toe_limits = shift.limits;
      subtract(curve.x, shift.amount);
    }
  }
  if (slip_at > 0) done.slip_at = curve.x[slip_at];
  curve = sorted_by_x(curve);
  done.load_zero += found.load_zero;
  done.toe += found.toe;
  done.slip = found.slip;
  done.slip_line = found.slip_line;
  done.load_zero_limits = found.load_zero_limits;
  done.toe_limits = found.toe_limits;
  done.slip_limits = found.slip_limits;
}

LinearFit with_found(LinearFit fit, const LinearLaw& law, const LoadRows& rows,
                     const Corrections& corrections, const Corrected& done) {
  const VectorXd slope = slope_of(law, rows.x, fit.k);
  Eigen::MatrixXd a = law.loads(rows.x);
  const Index coefficients = a.cols();
  if (corrections.fit_load_zero) a = beside(a, VectorXd::Ones(rows.x.size()));
  if (corrections.fit_toe) a = beside(a, -slope);
  if (done.slip != 0.0) {
    const VectorXd after = (rows.x.array() >= done.slip_at).cast<double>().matrix();
    a = beside(a, -slope.cwiseProduct(after));
  }
  if (a.cols() == coefficients) return fit;
  const Eigen::ArrayXd residuals = fit.weights * (rows.y - fit.fitted).array();
  fit.freedom = freedom_of(residuals.matrix(), a.cols(), freedom_of_limits);
  const Eigen::MatrixXd weighted = fit.weights.matrix().asDiagonal() * a;
  const Eigen::MatrixXd inverse =
      (weighted.transpose() * weighted).completeOrthogonalDecomposition().pseudoInverse();
  fit.covariance =
      inverse.topLeftCorner(coefficients, coefficients) * (residuals.square().sum() / fit.freedom);
  return fit;
}

bool drop_slack(Curve& curve, const std::string& word, Diagnostics& diagnostics) {
  std::vector<std::size_t> taut;
  for (std::size_t i = 0; i < curve.size(); ++i)
    if (curve.x[i] >= 0.0) taut.push_back(i);
  if (taut.size() < 2) {
    diagnostics.error({curve.file, curve.line.front(), 1}, curve.x_name, "",
                      fmt::format("{} row{} of the curve {} beyond the {} at which the specimen is "
                                  "taut",
                                  taut.size(), taut.size() == 1 ? "" : "s",
                                  taut.size() == 1 ? "lies" : "lie", word),
                      "check --toe and its unit, and the column");
    return false;
  }
  if (taut.size() < curve.size()) curve = rows_of(curve, taut);
  return true;
}

} // namespace plyform
