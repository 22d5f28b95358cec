// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/identify/stitch_start.hpp"

#include "core/identify/fit_signs.hpp"
#include "core/identify/shear_rows.hpp"
#include "core/identify/stitch_load.hpp"

#include <algorithm>
#include <limits>

namespace plyform {
namespace {

constexpr double never_breaks = std::numeric_limits<double>::infinity();

/// Rows up to an angle of both sides, those of the slack one last, for a first law.
struct FirstRows {
  std::vector<double> extension, load;
  std::size_t drawn = 0;
};

FirstRows first_rows(const StitchTest& t, const SignedCurves& curves, double to) {
  FirstRows rows;
  for (const bool slack : {false, true}) {
    const bool negative = slack != t.negative;
    const auto& side = negative ? curves.negative : curves.positive;
    for (const Curve& curve :
         without_stitches(side, t.test, t.fabric, t.others, negative, t.options))
      for (std::size_t i = 0; i < curve.size(); ++i)
        if (curve.x[i] >= 0.0 && curve.x[i] <= extension_at(t.test, to)) {
          rows.extension.push_back(curve.x[i]);
          rows.load.push_back(curve.y[i]);
        }
    if (!slack) rows.drawn = rows.extension.size();
  }
  return rows;
}

/// A line of pre-tension beside a polynomial of shear, fitted to both sides at once.
struct FirstFit {
  const StitchTest& t;
  const FirstRows& rows;
  Eigen::MatrixXd a; ///< loads by each coefficient of shear, then by the stitch's stiffness
  Eigen::VectorXd y;

  /// With the stitch taut from the elongation e0 on, and gone beyond `breaks`.
  FixedFit at(double e0, double breaks) {
    const Eigen::Index stitch = a.cols() - 1;
    for (Eigen::Index r = 0; r < a.rows(); ++r) {
      const auto row = static_cast<std::size_t>(r);
      a(r, stitch) = stitch_load(
          t.test, t.fabric, t.own, rows.extension[row], (row >= rows.drawn) != t.negative,
          [=](double e) { return e > breaks ? 0.0 : std::max(0.0, e - e0); });
    }
    return fit_fixed(a, y, Eigen::ArrayXd::Ones(a.rows()));
  }
};

/// The line that, with a polynomial for shear, follows both sides best up to the angle `to` (rad);
/// nothing where they have few rows.
std::optional<StitchLaw> first_line(const StitchTest& t, const SignedCurves& curves, double breaks,
                                    double to) {
  constexpr double tautest = -0.3;
  constexpr int coefficients = 3, steps = 60;
  const FirstRows rows = first_rows(t, curves, to);
  const auto count = static_cast<Eigen::Index>(rows.extension.size());
  if (count < 2 * (coefficients + 2)) return std::nullopt;
  FirstFit first{t, rows, Eigen::MatrixXd(count, coefficients + 1), vector_of(rows.load)};
  first.a.leftCols(coefficients) =
      linear_shear({t.test, t.fabric, coefficients, to, 1.0}).loads(vector_of(rows.extension));
  const auto taut_at = [](double step) { return tautest * step * step / (steps * steps); };
  const auto squares = [&](double step) {
    const FixedFit fit = first.at(taut_at(step), breaks);
    return fit.k[coefficients] > 0.0 ? fit.squares : never_breaks;
  };
  int best = 1;
  for (int i = 2; i <= steps; ++i) // denser where pre-tensions are small
    if (squares(i) < squares(best)) best = i;
  const double step = minimum_of(squares, best - 1.0, best + 1.0);
  StitchLaw law = t.fabric.stitches[t.own.front()].law;
  law.tension = {};
  law.tension.stiffness = first.at(taut_at(step), breaks).k[coefficients];
  law.taut_at = taut_at(step);
  return law.tension.stiffness > 0.0 ? std::optional(law) : std::nullopt;
}

} // namespace

std::vector<StitchLaw> first_laws(const StitchTest& t, const SignedCurves& curves,
                                  std::optional<double> breaks) {
  const StitchLaw& own = t.fabric.stitches[t.own.front()].law;
  std::vector<StitchLaw> laws;
  if (own.at(0.0).value > 0.0) {
    const double by_own =
        own.breaking_force < own.at(1.0).value
            ? own.taut_at + own.breaking_force / own.at(1.0).value * (1.0 - own.taut_at)
            : never_breaks;
    constexpr double usual = 20.0 * degree, early = 10.0 * degree; // before most breaks
    for (const auto& [at, to] :
         {std::pair{breaks.value_or(by_own), usual}, {never_breaks, usual}, {never_breaks, early}})
      if (const auto line = first_line(t, curves, at, to)) laws.push_back(*line);
  }
  laws.push_back(own);
  return laws;
}

} // namespace plyform
