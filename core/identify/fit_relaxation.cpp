// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/identify/fit_relaxation.hpp"

#include "base/format.hpp"
#include "core/identify/linear_law.hpp"
#include "core/identify/nonnegative.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace plyform {
namespace {

constexpr std::size_t least_relaxation_rows = 8, most_branches = 8;
constexpr double per_decade = 2.0;
constexpr double no_branch = 1e-3;  // of the load at the stop
constexpr double ramp_share = 0.05; // of the largest load: a load that rises by more is of the ramp
constexpr double as_good = 1.05;    // residuals of merged_branches branches over those of all

/// Columns 1, e^(-t/theta_k).
Eigen::MatrixXd prony_columns(const std::vector<double>& t, const std::vector<double>& times) {
  Eigen::MatrixXd a(static_cast<Eigen::Index>(t.size()),
                    static_cast<Eigen::Index>(times.size()) + 1);
  for (Eigen::Index i = 0; i < a.rows(); ++i) {
    a(i, 0) = 1.0;
    for (std::size_t k = 0; k < times.size(); ++k)
      a(i, static_cast<Eigen::Index>(k) + 1) = std::exp(-t[static_cast<std::size_t>(i)] / times[k]);
  }
  return a;
}

/// A Prony series of some times, with loads of at least 0.
struct PronySeries {
  std::vector<double> times;
  Eigen::VectorXd loads; ///< of rest, then of each time
  double squares = 0.0;
};

PronySeries series_of(const Curve& c, std::vector<double> times) {
  PronySeries s{std::move(times), {}, 0.0};
  const Eigen::MatrixXd a = prony_columns(c.x, s.times);
  const Eigen::VectorXd y = vector_of(c.y);
  s.loads = nonnegative_least_squares(a, y);
  s.squares = (a * s.loads - y).squaredNorm();
  return s;
}

/// The times with a load that counts.
PronySeries without_none(const Curve& c, const PronySeries& s) {
  std::vector<double> kept;
  for (std::size_t k = 0; k < s.times.size(); ++k)
    if (s.loads[static_cast<Eigen::Index>(k) + 1] > no_branch * s.loads.sum())
      kept.push_back(s.times[k]);
  return series_of(c, std::move(kept));
}

/// Moves each time to where the series fits best, one after the other.
PronySeries settled_times(const Curve& c, PronySeries s) {
  constexpr int rounds = 30;
  for (int round = 0; round < rounds; ++round) {
    const double before = s.squares;
    for (std::size_t k = 0; k < s.times.size(); ++k) {
      const double low = k > 0 ? s.times[k - 1] * 1.05 : s.times[k] / 4.0;
      const double high = k + 1 < s.times.size() ? s.times[k + 1] / 1.05 : s.times[k] * 4.0;
      if (!(high > low)) continue;
      const auto with = [&](double log_time) {
        std::vector<double> times = s.times;
        times[k] = std::exp(log_time);
        return series_of(c, std::move(times));
      };
      const double best =
          minimum_of([&](double x) { return with(x).squares; }, std::log(low), std::log(high));
      if (PronySeries moved = with(best); moved.squares < s.squares) s = std::move(moved);
    }
    if (!(s.squares < before * (1.0 - 1e-4))) break;
  }
  return s;
}

/// The fewest branches that fit as well as all: neighbours merge, the pair first that costs least.
PronySeries merged_branches(const Curve& c, PronySeries s) {
  const double noise = s.squares / static_cast<double>(c.size());
  const double floor = 1e-12 * vector_of(c.y).squaredNorm();
  while (s.times.size() > 1) {
    std::optional<PronySeries> best;
    for (std::size_t k = 0; k + 1 < s.times.size(); ++k) {
      const double a = s.loads[static_cast<Eigen::Index>(k) + 1],
                   b = s.loads[static_cast<Eigen::Index>(k) + 2];
      std::vector<double> times = s.times;
      const double share = a + b > 0.0 ? b / (a + b) : 0.5;
      times[k] *= std::pow(times[k + 1] / times[k], share);
      times.erase(times.begin() + static_cast<std::ptrdiff_t>(k) + 1);
      PronySeries one = settled_times(c, series_of(c, std::move(times)));
      if (!best || one.squares < best->squares) best = std::move(one);
    }
    const double allowed = as_good * as_good * noise * static_cast<double>(c.size()) + floor;
    if (best->squares > allowed && s.times.size() <= most_branches) break;
    s = std::move(*best);
  }
  return s;
}

/// Reports an error and returns true if the curve begins with rows of the ramp, where the load
/// rises.
bool has_ramp(const Curve& c, const RelaxationTest& test, Diagnostics& diagnostics) {
  const auto top = static_cast<std::size_t>(std::max_element(c.y.begin(), c.y.end()) - c.y.begin());
  if (c.y.front() >= (1.0 - ramp_share) * c.y[top] || c.y.back() >= c.y[top]) return false;
  const double stop = test.ramp > 0.0 && test.ramp <= c.x[top] ? test.ramp : c.x[top];
  diagnostics.error(
      place_of(c, top), c.y_name, written_y(c, top),
      fmt::format("the load rises up to here, at {} = {}, and falls only then: the rows before are "
                  "of the ramp",
                  c.x_name, written_x(c, top)),
      fmt::format("take the rows before line {} out, and let time 0 be the stop: take {:g} s, when "
                  "the ramp ended, off all times",
                  c.line[top], stop));
  return true;
}

/// Warns of times that seem to count from the start of the ramp: rows close to each other, of which
/// the first comes just when the ramp has ended. Loads of a series that begins later do not show
/// it, as each branch is only smaller then.
void warn_of_late_zero(const Curve& c, const RelaxationTest& test, const RelaxationFit& fit,
                       Diagnostics& diagnostics) {
  constexpr double just = 0.95, close = 10.0;
  const double first = c.x.front();
  if (!(test.ramp > 0.0) || first < just * test.ramp || first < close * (c.x[1] - first)) return;
  std::string larger;
  for (const RelaxationBranch& branch : fit.branches)
    larger += fmt::format("{}that of {:.3g} s {:.3g} times", larger.empty() ? "" : ", ",
                          branch.time, std::exp(test.ramp / branch.time));
  diagnostics.warning(
      place_of(c), fmt::format("{} = {}: the first row comes after a ramp of {:g} s, and the next "
                               "one soon: if the time counts from the start of the ramp, take {:g} "
                               "s off all times, or branches come out too large, {}",
                               c.x_name, written_x(c, 0), test.ramp, test.ramp, larger));
}

bool check_decay(const Curve& c, const RelaxationTest& test, Diagnostics& diagnostics) {
  const auto error = [&](std::size_t row, const std::string& rule, const std::string& remedy) {
    row = std::min(row, c.size() - 1);
    diagnostics.error(place_of(c, row), c.x_name, written_x(c, row), rule, remedy);
    return false;
  };
  if (c.size() < least_relaxation_rows)
    return error(0,
                 fmt::format("has {} rows, relaxation needs {}", c.size(), least_relaxation_rows),
                 "record more rows after the stop");
  for (std::size_t i = 1; i < c.size(); ++i)
    if (!(c.x[i] > c.x[i - 1]))
      return error(i, "the time does not rise", "take out the row, or sort the rows");
  if (c.x.front() < 0.0)
    return error(0, "times before the stop are of the ramp", "let time 0 be the stop");
  if (has_ramp(c, test, diagnostics)) return false;
  const double first = c.x.front() > 0.0 ? c.x.front() : c.x[1];
  if (!(c.x.back() >= 10.0 * first))
    return error(c.size() - 1, "the times cover less than a decade",
                 "record from the stop on, and longer");
  if (!test.times.empty() || c.y.back() < c.y.front()) return true;
  return error(c.size() - 1, "the load does not fall: nothing relaxes",
               "check the columns, or leave the branches out of the fabric");
}

} // namespace

std::optional<RelaxationFit> identify_relaxation(Curve c, const RelaxationTest& test,
                                                 const Fabric& fabric, Diagnostics& diagnostics) {
  if (!(test.angle > 0.0) || test.ramp < 0.0)
    throw std::invalid_argument("a stop at no angle, or a ramp of no time");
  if (!check_decay(c, test, diagnostics)) return std::nullopt;
  std::vector<double> times = test.times;
  const double first = c.x.front() > 0.0 ? c.x.front() : c.x[1];
  for (double t = first; times.size() < 60 && test.times.empty() && t <= c.x.back();
       t *= std::pow(10.0, 1.0 / per_decade))
    times.push_back(t);
  PronySeries s = without_none(c, series_of(c, std::move(times)));
  if (test.times.empty()) s = without_none(c, merged_branches(c, settled_times(c, std::move(s))));

  RelaxationFit fit;
  const TorqueWeights w = torque_weights(test.test, fabric, extension_at(test.test, test.angle));
  const double whole = w.whole + 0.5 * w.half; // a branch has half of its torque at g/2
  for (std::size_t k = 0; k < s.times.size(); ++k) {
    const double theta = s.times[k], torque = s.loads[static_cast<Eigen::Index>(k) + 1] / whole;
    const double strain =
        test.ramp > 0.0 ? theta * (1.0 - std::exp(-test.ramp / theta)) * test.angle / test.ramp
                        : test.angle;
    fit.branches.push_back({torque / strain, theta});
  }
  fit.rest_torque = s.loads[0] / whole;
  const ShearLaw& elastic = fabric.crossings[0].shear;
  fit.elastic_torque =
      (w.whole * elastic.at(w.angle).value + w.half * elastic.at(0.5 * w.angle).value) / whole;
  fit.relaxed_share = 1.0 - s.loads[0] / s.loads.sum();
  const Eigen::VectorXd fitted = prony_columns(c.x, s.times) * s.loads;
  fit.time = c.x, fit.measured = c.y, fit.fitted = {fitted.begin(), fitted.end()};
  fit.quality = quality_of(fit.time, fit.measured, fit.fitted);
  if (!check_quality(c, fit.quality, fmt::format("{:.3g} s", fit.quality.largest_at),
                     "take out rows of the ramp, or check the load's zero", diagnostics))
    return std::nullopt;
  warn_of_late_zero(c, test, fit, diagnostics);
  return fit;
}

} // namespace plyform
