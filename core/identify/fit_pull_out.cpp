// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/identify/fit_pull_out.hpp"

#include "base/format.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace plyform {
namespace {

constexpr int most_hersey_points = 8;

/// Weights of the points of a curve at x, straight between them.
Eigen::MatrixXd hersey_hats(const std::vector<double>& x, const std::vector<double>& knots) {
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(x.size()),
                                            static_cast<Eigen::Index>(knots.size()));
  for (std::size_t i = 0; i < x.size(); ++i) {
    std::size_t k = 0;
    while (k + 2 < knots.size() && x[i] > knots[k + 1])
      ++k;
    const double t = (x[i] - knots[k]) / (knots[k + 1] - knots[k]);
    a(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) = 1.0 - t;
    a(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k) + 1) = t;
  }
  return a;
}

/// The curve of logarithms through `points` places that lie evenly in the ranks of the tests.
struct HerseyCurve {
  std::vector<double> knots;
  Eigen::VectorXd values, residuals;
  bool known = false; ///< whether each point has tests beside it
};

HerseyCurve curve_through(const std::vector<double>& x, const std::vector<double>& y, int points) {
  const auto [least, most] = std::minmax_element(x.begin(), x.end());
  HerseyCurve c;
  for (int k = 0; k < points; ++k)
    c.knots.push_back(*least + (*most - *least) * k / (points - 1));
  const Eigen::MatrixXd a = hersey_hats(x, c.knots);
  const auto solver = a.colPivHouseholderQr();
  c.known = solver.rank() == a.cols();
  c.values = solver.solve(vector_of(y));
  c.residuals = vector_of(y) - a * c.values;
  return c;
}

HerseyCurve chosen_curve(const std::vector<double>& x, const std::vector<double>& y, int points) {
  HerseyCurve best = curve_through(x, y, points > 0 ? points : 2);
  const int most = std::min(most_hersey_points, static_cast<int>(x.size()) - 1);
  for (int more = 3; points == 0 && more <= most; ++more) {
    HerseyCurve next = curve_through(x, y, more);
    if (!next.known) continue;
    const double freedom = std::max(1.0, static_cast<double>(x.size()) - more);
    const double extra = static_cast<double>(next.knots.size() - best.knots.size());
    const double gain = (best.residuals.squaredNorm() - next.residuals.squaredNorm()) / extra,
                 noise = next.residuals.squaredNorm() / freedom;
    constexpr double resolved = 1e-6; // relative: less is rounding
    if (best.residuals.squaredNorm() < resolved * resolved) break;
    if (gain > 0.0 && fisher_beyond(gain / noise, extra, freedom) < by_chance)
      best = std::move(next);
  }
  return best;
}

/// The steady load of a test; reports an error and returns nothing if there is none.
std::optional<PullOutPoint> steady_of(const PullOutTest& test, double area, double from, double to,
                                      Diagnostics& diagnostics) {
  const Curve& c = test.curve;
  PullOutPoint point{c.file, test.viscosity * test.speed / test.pressure};
  std::vector<double> loads;
  for (std::size_t i = 0; i < c.size(); ++i)
    if (c.x[i] >= from && c.x[i] <= to) loads.push_back(c.y[i]);
  const auto error = [&](const std::string& rule, const std::string& remedy) {
    diagnostics.error(place_of(c), c.y_name, "", rule, remedy);
    return std::nullopt;
  };
  if (loads.size() < 2)
    return error(fmt::format("has {} rows between {:g} and {:g} mm", loads.size(), from, to),
                 "give --from and --to, the displacements between which the pull is steady");
  const Spread spread = spread_of(loads);
  if (!(spread.mean > 0.0))
    return error(fmt::format("a steady load of {:.3g} N", spread.mean),
                 "give loads of the pull as positive numbers");
  point.steady = spread.mean, point.scatter = spread.deviation / spread.mean;
  point.friction = spread.mean / (2.0 * area * test.pressure);
  for (std::size_t i = 0; i < c.size() && c.x[i] <= to; ++i)
    point.peak = std::max(point.peak, c.y[i] / spread.mean);
  return point;
}

} // namespace

std::optional<PullOutFit> identify_pull_out(const std::vector<PullOutTest>& tests, double area,
                                            double from, double to, int points,
                                            Diagnostics& diagnostics) {
  if (tests.empty() || !(area > 0.0) || points < 0 || points > most_hersey_points)
    throw std::invalid_argument("no tests, no area, or a curve of no size");
  PullOutFit fit;
  std::vector<double> x, y;
  for (const PullOutTest& test : tests) {
    const auto point = steady_of(test, area, from, to, diagnostics);
    if (!point) return std::nullopt;
    fit.tests.push_back(*point);
    x.push_back(std::log(point->hersey)), y.push_back(std::log(point->friction));
  }
  const auto [least, most] = std::minmax_element(x.begin(), x.end());
  const Place at = place_of(tests.front().curve);
  if (tests.size() < 3 || !(*most - *least >= std::log(2.0))) {
    diagnostics.error(at, "--speeds", "",
                      fmt::format("{} tests with Hersey numbers from {:.3g} to {:.3g} mm: three "
                                  "tests and a factor of two are the least",
                                  tests.size(), std::exp(*least), std::exp(*most)),
                      "add tests that are faster, or have less pressure");
    return std::nullopt;
  }
  const HerseyCurve curve = chosen_curve(x, y, points);
  if (!curve.known) {
    diagnostics.error(at, "--points", fmt::format("{}", points),
                      "is more than the tests bear: no test lies between two points",
                      "ask for fewer points");
    return std::nullopt;
  }
  for (std::size_t k = 0; k < curve.knots.size(); ++k) {
    fit.hersey.push_back(std::exp(curve.knots[k]));
    fit.friction.push_back(std::exp(curve.values[static_cast<Eigen::Index>(k)]));
  }
  std::vector<double> hersey, measured, fitted;
  for (std::size_t i = 0; i < x.size(); ++i) {
    fit.tests[i].fitted = std::exp(y[i] - curve.residuals[static_cast<Eigen::Index>(i)]);
    hersey.push_back(fit.tests[i].hersey), measured.push_back(fit.tests[i].friction);
    fitted.push_back(fit.tests[i].fitted);
  }
  fit.quality = quality_of(hersey, measured, fitted);
  const double freedom =
      std::max(1.0, static_cast<double>(x.size()) - static_cast<double>(curve.knots.size()));
  fit.limits = student_95(freedom) * std::sqrt(curve.residuals.squaredNorm() / freedom);
  if (!check_quality(tests.front().curve, fit.quality,
                     fmt::format("a Hersey number of {:.3g} mm", fit.quality.largest_at),
                     "the tests do not lie on one curve: check pressures, speeds and viscosities",
                     diagnostics))
    return std::nullopt;
  return fit;
}

} // namespace plyform
