// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/identify/compaction_forms.hpp"

#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/NonLinearOptimization>
#include <unsupported/Eigen/NumericalDiff>

namespace plyform {
namespace {

/// Numbers as logarithms: V0, scale, and n, or Va - V0.
FormNumbers numbers_of(CompactionForm form, const Eigen::VectorXd& p) {
  const double rest = std::exp(p[0]), third = std::exp(p[2]);
  return {rest, std::exp(p[1]), form == CompactionForm::gutowski ? rest + third : third};
}

struct LogVolumes {
  using Scalar = double;
  using InputType = Eigen::VectorXd;
  using ValueType = Eigen::VectorXd;
  using JacobianType = Eigen::MatrixXd;
  enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };

  CompactionForm form;
  const CompactionRows* rows;

  int inputs() const { return 3; }
  int values() const { return static_cast<int>(rows->size()); }
  int operator()(const Eigen::VectorXd& p, Eigen::VectorXd& residuals) const {
    const FormNumbers law = numbers_of(form, p);
    residuals.resize(values());
    for (std::size_t i = 0; i < rows->size(); ++i)
      residuals[static_cast<Eigen::Index>(i)] =
          std::log(volume_at(form, law, (*rows)[i].pressure) / (*rows)[i].volume);
    return residuals.allFinite() ? 0 : -1;
  }
};

/// Where the search begins: through the last row.
Eigen::VectorXd first_guess(CompactionForm form, const CompactionRows& rows, double third) {
  const double rest = 0.98 * rows.front().volume;
  Eigen::VectorXd p(3);
  p << std::log(rest), 0.0, std::log(third);
  const double there = pressure_at(form, numbers_of(form, p), rows.back().volume);
  p[1] = std::log(rows.back().pressure / there);
  return p;
}

} // namespace

double pressure_at(CompactionForm form, const FormNumbers& law, double v) {
  if (form == CompactionForm::gutowski)
    return law.scale * (v / law.free_volume - 1.0) / std::pow(1.0 / v - 1.0 / law.shape, 4.0);
  return law.scale * (std::pow(v, law.shape) - std::pow(law.free_volume, law.shape));
}

double volume_at(CompactionForm form, const FormNumbers& law, double pressure) {
  if (form != CompactionForm::gutowski)
    return std::pow(std::pow(law.free_volume, law.shape) + pressure / law.scale, 1.0 / law.shape);
  double low = law.free_volume, high = law.shape; // the pressure rises between them without end
  for (int i = 0; i < 100 && high - low > 1e-15 * high; ++i) {
    const double middle = 0.5 * (low + high);
    (pressure_at(form, law, middle) < pressure ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

FormFit fit_form(CompactionForm form, const CompactionRows& rows) {
  const bool gutowski = form == CompactionForm::gutowski;
  const LogVolumes function{form, &rows};
  Eigen::VectorXd best;
  double least = std::numeric_limits<double>::infinity();
  const double room = rows.back().volume;
  for (const double third : gutowski ? std::vector{0.1 * room + 0.05, 0.3 * room, 0.6 * room}
                                     : std::vector{3.0, 8.0, 16.0}) {
    Eigen::VectorXd p =
        first_guess(form, rows, gutowski ? third + room - rows.front().volume : third);
    Eigen::NumericalDiff<LogVolumes, Eigen::Central> differences(function);
    Eigen::LevenbergMarquardt<Eigen::NumericalDiff<LogVolumes, Eigen::Central>> search(differences);
    search.parameters.maxfev = 2000;
    search.parameters.ftol = search.parameters.xtol = 1e-12;
    search.minimize(p);
    Eigen::VectorXd residuals;
    if (function(p, residuals) != 0 || !(residuals.squaredNorm() < least)) continue;
    least = residuals.squaredNorm(), best = p;
  }
  FormFit fit;
  if (best.size() == 0) { // no start led anywhere: what follows tells so
    fit.rms = fit.largest = std::numeric_limits<double>::infinity();
    return fit;
  }
  fit.numbers = numbers_of(form, best);
  Eigen::VectorXd residuals;
  function(best, residuals);
  fit.rms = std::sqrt(least / static_cast<double>(rows.size()));
  fit.largest = residuals.cwiseAbs().maxCoeff();
  const double freedom = static_cast<double>(rows.size()) - 3.0;
  if (freedom < 1.0) return fit;
  Eigen::MatrixXd slopes(residuals.size(), 3);
  Eigen::NumericalDiff<LogVolumes, Eigen::Central>(function).df(best, slopes);
  const Eigen::MatrixXd covariance =
      (slopes.transpose() * slopes).completeOrthogonalDecomposition().pseudoInverse() *
      (least / freedom);
  const Eigen::Vector3d wide =
      student_95(freedom) * covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  fit.limits = {wide[0] * fit.numbers.free_volume, wide[1] * fit.numbers.scale,
                wide[2] * fit.numbers.shape};
  if (gutowski) { // Va = V0 + third
    const double third = fit.numbers.shape - fit.numbers.free_volume,
                 rest = fit.numbers.free_volume;
    const double variance = rest * rest * covariance(0, 0) + third * third * covariance(2, 2) +
                            2.0 * rest * third * covariance(0, 2);
    fit.limits.shape = student_95(freedom) * std::sqrt(std::max(variance, 0.0));
  }
  return fit;
}

std::vector<double> rising_volumes(const CompactionRows& rows) {
  std::vector<double> volumes;
  for (const CompactionRow& row : rows)
    volumes.push_back(row.volume);
  return nearest_rising(volumes);
}

double scatter_of_rows(const CompactionRows& rows) {
  constexpr std::size_t many = 10;
  if (rows.size() < many) return 0.0;
  double squares = 0.0;
  for (std::size_t i = 1; i + 1 < rows.size(); ++i) // 6: 1 + 4 + 1, of three that scatter alike
    squares +=
        std::pow((rows[i - 1].volume - 2.0 * rows[i].volume + rows[i + 1].volume) / rows[i].volume,
                 2.0) /
        6.0;
  return std::sqrt(squares / static_cast<double>(rows.size() - 2));
}

double volume_between(const CompactionRows& rows, double pressure) {
  std::size_t i = 1;
  while (i + 1 < rows.size() && rows[i].pressure < pressure)
    ++i;
  const CompactionRow &a = rows[i - 1], &b = rows[i];
  const double share =
      b.pressure > a.pressure ? (pressure - a.pressure) / (b.pressure - a.pressure) : 0.5;
  return a.volume + share * (b.volume - a.volume);
}

double rest_of(const CompactionRows& rows) {
  const std::vector<double> rising = rising_volumes(rows);
  for (std::size_t i = 1; i < rows.size(); ++i)
    if (rows[i].pressure > rows[0].pressure && rising[i] > rising[0])
      return std::max(0.5 * rising[0], rising[0] - rows[0].pressure * (rising[i] - rising[0]) /
                                                       (rows[i].pressure - rows[0].pressure));
  return rising[0];
}

} // namespace plyform
