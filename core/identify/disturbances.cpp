// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/identify/disturbances.hpp"

#include "core/identify/statistics.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

constexpr double least_change = 0.02;
constexpr double least_rms = 1e-4; ///< residuals below are those of the digits of a file
constexpr double indistinct = 4.0; ///< t^2 of two that the rows do not tell apart

Shift best_of(DisturbanceKind kind, const LinearLaw& law, const LoadRows& rows) {
  switch (kind) {
  case DisturbanceKind::load_zero:
    return best_load_zero(law, rows);
  case DisturbanceKind::displacement_zero:
    return best_toe(law, rows);
  case DisturbanceKind::stretch:
    return best_stretch(law, rows);
  default:
    return best_slip(law, rows);
  }
}

/// t^2 of the step from one sum of squares to a smaller one.
double t_squared(double more, double less, double freedom) {
  return less > 0.0 ? std::max(0.0, more - less) / (less / freedom) : 1e9;
}

/// The change of the law from rows to others.
double change_by(const LinearLaw& law, const LoadRows& rows, const Eigen::VectorXd& x,
                 const Eigen::VectorXd& y) {
  const LinearFit before = fit_linear(law.loads(rows.x), rows.y);
  if (!(x.minCoeff() >= 0.0) && x.maxCoeff() <= 0.0) return 1e9;
  return law_change(law.probes, before.k, fit_linear(law.loads(x), y).k);
}

} // namespace

std::vector<Disturbance> fit_disturbances(const LinearLaw& law, const LoadRows& rows,
                                          const std::vector<DisturbanceKind>& looked_for) {
  const Eigen::Index coefficients = law.probes.cols();
  std::vector<Disturbance> all;
  if (rows.x.size() < coefficients + 4) return all;
  const FixedFit plain = fit_fixed(law.loads(rows.x), rows.y, rows.weights);
  const double n = static_cast<double>(rows.x.size());
  if (std::sqrt(plain.squares / n) < least_rms) return all;
  double richer = plain.squares;
  if (law.richer) richer = fit_fixed(law.richer(rows.x), rows.y, rows.weights).squares;
  for (const DisturbanceKind kind : looked_for) {
    const Shift shift = best_of(kind, law, rows);
    const double freedom = freedom_of(shift.fit.residuals, coefficients + 1);
    const double t2 = t_squared(plain.squares, shift.fit.squares, freedom);
    const double places = kind == DisturbanceKind::slip ? n : 1.0;
    const double t = shift.error > 0.0 ? std::abs(shift.amount) / shift.error : 1e9;
    Disturbance d{kind, shift.amount, shift.limits, shift.row};
    d.change = law_change(law.probes, shift.fit.k.head(coefficients), plain.k);
    d.squares = shift.fit.squares;
    d.plain_squares = plain.squares;
    d.chance = places * student_beyond(std::min(std::sqrt(t2), t), freedom);
    d.is_no_shape = shift.fit.squares < richer;
    d.freedom = freedom;
    d.k = shift.fit.k.head(coefficients);
    all.push_back(d);
  }
  std::stable_sort(all.begin(), all.end(), [](const Disturbance& a, const Disturbance& b) {
    return a.squares < b.squares;
  });
  return all;
}

bool is_found(const Disturbance& d) {
  return d.chance <= by_chance && d.change >= least_change;
}

std::vector<Disturbance> find_disturbances(const LinearLaw& law, const LoadRows& rows,
                                           const std::vector<DisturbanceKind>& looked_for) {
  std::vector<Disturbance> found = fit_disturbances(law, rows, looked_for);
  std::erase_if(found, [](const Disturbance& d) { return !is_found(d); });
  while (found.size() > 1 &&
         t_squared(found.back().squares, found.front().squares, found.front().freedom) > indistinct)
    found.pop_back();
  return found;
}

Sensitivity sensitivities(const LinearLaw& law, const LoadRows& rows, double length,
                          double compliance) {
  const Eigen::VectorXd& x = rows.x;
  const Eigen::VectorXd& y = rows.y;
  const double most = x.maxCoeff();
  const auto positive = [](const Eigen::VectorXd& values) {
    return Eigen::VectorXd(values.cwiseMax(0.0));
  };
  Sensitivity result;
  result.load_zero = change_by(law, rows, x, (y.array() - 0.01 * y.maxCoeff()).matrix());
  result.toe = change_by(law, rows, (x.array() + length).matrix(), y);
  result.slip = change_by(law, rows, x * std::max(0.0, 1.0 - length / most), y);
  result.compliance = change_by(law, rows, positive(x - compliance * y), y);
  return result;
}

} // namespace plyform
