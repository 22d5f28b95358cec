// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/identify/stitch_rows.hpp"

#include "core/identify/fit_quality.hpp"
#include "core/identify/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plyform {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// F of unit stiffness, taut from e0 on and gone beyond `breaks`.
struct UnitLine {
  double e0, breaks;
  double operator()(double e) const { return e > e0 && e <= breaks ? e - e0 : 0.0; }
};

struct LineFit {
  UnitLine shape{0.0, never};
  FixedFit fit;
  double stiffness() const { return fit.k[0]; }
};

LineFit line_of(const StitchRows& rows, const UnitLine& shape) {
  LineFit line{shape, fit_fixed(rows.loads(shape), rows.added, rows.weights)};
  if (line.stiffness() >= 0.0) return line;
  line.fit.k[0] = 0.0; // a stitch does not push
  line.fit.residuals = (rows.weights * rows.added.array()).matrix();
  line.fit.squares = line.fit.residuals.squaredNorm();
  return line;
}

/// The best e0 for a break.
LineFit best_line(const StitchRows& rows, double largest, double breaks) {
  const double most = 0.95 * std::min(largest, breaks), least = -most;
  constexpr int steps = 24;
  const auto squares = [&](double e0) { return line_of(rows, {e0, breaks}).fit.squares; };
  int best = 0;
  double lowest = never;
  for (int i = 0; i <= steps; ++i)
    if (const double s = squares(least + (most - least) * i / steps); s < lowest)
      lowest = s, best = i;
  const double step = (most - least) / steps, middle = least + step * best;
  const double found = minimum_of(squares, middle - step, std::min(middle + step, most));
  return line_of(rows, {found, breaks});
}

/// Elongations in the middle between two rows, thinned.
std::vector<double> candidates_of(const std::vector<double>& strains) {
  constexpr std::size_t most = 60;
  std::vector<double> middles;
  for (std::size_t i = 1; i < strains.size(); ++i)
    if (strains[i] > strains[i - 1] && strains[i] > 0.1 * strains.back())
      middles.push_back(0.5 * (strains[i - 1] + strains[i]));
  std::vector<double> thinned;
  const std::size_t step = middles.size() / most + 1;
  for (std::size_t i = 0; i < middles.size(); i += step)
    thinned.push_back(middles[i]);
  return thinned;
}

/// Chance (t of one parameter more) of so much smaller squares. Sides whose shear differs leave
/// residuals that go together over all rows, which count as independent here all the same.
double chance_of(double plain, const FixedFit& better, Eigen::Index coefficients) {
  const double freedom = std::max(1.0, static_cast<double>(better.residuals.size() - coefficients));
  return chance_of_gain(plain, better.squares, freedom);
}

/// Narrows the break down to the rows beside it.
LineFit refine_break(const StitchRows& rows, const std::vector<double>& strains, LineFit best) {
  for (std::size_t i = 1; i < strains.size(); ++i) {
    const double middle = 0.5 * (strains[i - 1] + strains[i]);
    if (std::abs(middle - best.shape.breaks) > 0.06 * strains.back()) continue;
    const LineFit here = best_line(rows, strains.back(), middle);
    if (here.fit.squares < best.fit.squares) best = here;
  }
  return best;
}

/// The line, with the break that explains the rows, if one does.
LineFit line_with_break(const StitchRows& rows, const std::vector<double>& strains) {
  const double largest = strains.back();
  const LineFit whole = best_line(rows, largest, never);
  LineFit best = whole;
  const std::vector<double> candidates = candidates_of(strains);
  for (const double breaks : candidates) {
    const LineFit here = best_line(rows, largest, breaks);
    if (here.fit.squares < best.fit.squares) best = here;
  }
  if (best.shape.breaks == never) return whole;
  best = refine_break(rows, strains, best);
  constexpr double most_of_it = 0.25;
  const double chance =
      chance_of(whole.fit.squares, best.fit, 3) * static_cast<double>(candidates.size());
  const bool much = best.fit.squares < most_of_it * whole.fit.squares;
  return chance < by_chance && much ? best : whole;
}

/// Slopes of a piecewise linear F over knots from the first on, none below 0: those that would be
/// are set to 0, the most negative first.
Eigen::VectorXd rising(const Eigen::MatrixXd& a, const StitchRows& rows) {
  std::vector<Eigen::Index> free;
  for (Eigen::Index c = 0; c < a.cols(); ++c)
    free.push_back(c);
  Eigen::VectorXd slopes = Eigen::VectorXd::Zero(a.cols());
  while (!free.empty()) {
    Eigen::MatrixXd columns(a.rows(), static_cast<Eigen::Index>(free.size()));
    for (std::size_t c = 0; c < free.size(); ++c)
      columns.col(static_cast<Eigen::Index>(c)) = a.col(free[c]);
    const Eigen::VectorXd k = fit_fixed(columns, rows.added, rows.weights).k;
    Eigen::Index lowest = 0;
    const double least = k.minCoeff(&lowest);
    slopes.setZero();
    for (std::size_t c = 0; c < free.size(); ++c)
      slopes[free[c]] = std::max(0.0, k[static_cast<Eigen::Index>(c)]);
    if (least >= 0.0) break;
    free.erase(free.begin() + lowest);
  }
  return slopes;
}

/// A table from where the line is taut, up to its break or the last elongation.
StitchSolution table_of(const StitchRows& rows, const LineFit& line, double largest) {
  constexpr int pieces = 8;
  StitchSolution solution;
  solution.line = false;
  const double breaks = line.shape.breaks;
  const double start = std::min(line.shape.e0, 0.0); // slack shows as slopes of 0
  const double end = std::min(largest, breaks), width = (end - start) / pieces;
  Eigen::MatrixXd a(rows.added.size(), pieces);
  for (int c = 0; c < pieces; ++c)
    a.col(c) = rows.loads([&](double e) {
      const double from = start + width * c;
      return e <= breaks ? std::clamp(e - from, 0.0, width) : 0.0;
    });
  const Eigen::VectorXd slopes = rising(a, rows);
  solution.law.taut_at = start;
  solution.law.tension.strain = {0.0};
  solution.law.tension.tension = {0.0};
  for (int c = 0; c < pieces; ++c) {
    solution.law.tension.strain.push_back(width * (c + 1));
    solution.law.tension.tension.push_back(solution.law.tension.tension.back() + width * slopes[c]);
  }
  solution.fitted = a * slopes;
  solution.squares =
      (rows.weights.matrix().asDiagonal() * (rows.added - solution.fitted)).squaredNorm();
  return solution;
}

/// The two elongations of rows between which it breaks.
void place_break(const std::vector<double>& strains, double breaks, StitchSolution& solution) {
  if (breaks == never) return;
  const auto above = std::upper_bound(strains.begin(), strains.end(), breaks);
  solution.breaks_at = breaks;
  solution.breaks_from = above == strains.begin() ? 0.0 : *(above - 1);
  solution.breaks_to = above == strains.end() ? breaks : *above;
  solution.law.breaking_force = solution.law.at(breaks).value;
}

} // namespace

Eigen::VectorXd StitchRows::loads(const StitchForce& force) const {
  Eigen::VectorXd loads(static_cast<Eigen::Index>(extension.size()));
  for (std::size_t i = 0; i < extension.size(); ++i)
    loads[static_cast<Eigen::Index>(i)] =
        stitch_load(test, fabric, stitches, extension[i], negative, force);
  return loads;
}

std::vector<double> StitchRows::elongations() const {
  std::vector<double> strains;
  for (const double x : extension)
    for (const double part : {1.0, 0.5}) {
      if (part < 1.0 && test.half_area == 0.0) continue;
      const double gamma = (negative ? -part : part) * shear_angle(test, x);
      for (const std::size_t i : stitches)
        if (const double e = elongation_of(fabric, fabric.stitches[i], gamma).strain; e > 0.0)
          strains.push_back(e);
    }
  std::sort(strains.begin(), strains.end());
  return strains;
}

double StitchSolution::force(double strain) const {
  return breaks_at > 0.0 && strain > breaks_at ? 0.0 : law.at(strain).value;
}

StitchSolution solve_stitch(const StitchRows& rows, std::optional<double> breaks) {
  const std::vector<double> strains = rows.elongations();
  LineFit line = breaks ? best_line(rows, strains.back(), *breaks) : line_with_break(rows, strains);
  const LineFit from_zero = line_of(rows, {0.0, line.shape.breaks});
  if (chance_of(from_zero.fit.squares, line.fit, 2) > 1e-3) line = from_zero;
  StitchSolution solution;
  solution.law.tension.stiffness = line.stiffness();
  solution.law.taut_at = line.shape.e0;
  solution.fitted = rows.loads(line.shape) * line.stiffness();
  solution.squares = line.fit.squares;
  const double rms = std::sqrt(line.fit.squares / static_cast<double>(rows.added.size()));
  if (rms > noisy) {
    StitchSolution table = table_of(rows, line, strains.back());
    if (table.squares < 0.25 * solution.squares) solution = std::move(table);
  }
  place_break(strains, line.shape.breaks, solution);
  return solution;
}

} // namespace plyform
