// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a curve is one of monotonic loading from zero: curve_file.hpp.
#include "base/format.hpp"
#include "core/identify/curve_file.hpp"

#include <algorithm>
#include <numeric>

namespace plyform {
namespace {

/// Reports rows whose x decreases by more than noise: the test was unloaded, or the sign is wrong.
void report_falling(const Curve& curve, const std::string& word, std::size_t row, std::size_t peak,
                    Diagnostics& diagnostics) {
  const Place at{curve.file, curve.line[row], 1};
  const std::string value = written_x(curve, row);
  const double lowest = *std::min_element(curve.x.begin(), curve.x.end());
  if (curve.x.front() - curve.x.back() >= 0.5 * (curve.x.front() - lowest) &&
      *std::max_element(curve.x.begin(), curve.x.end()) - curve.x.front() <=
          back_share * (curve.x.front() - lowest))
    diagnostics.error(at, curve.x_name, value,
                      fmt::format("the {} falls from the first row on, it must rise", word),
                      "turn its sign round, or name another column with --x-column");
  else
    diagnostics.error(
        at, curve.x_name, value,
        fmt::format("the {} must rise, but falls from {} in line {}", word, written_x(curve, peak),
                    curve.line[peak]),
        fmt::format("if the test was unloaded there, take out the rows from line {} on; "
                    "else check --x-column",
                    curve.line[row]));
}

/// Sorts the rows if x decreases by noise only; reports and returns false if by more.
bool sort_rows(Curve& curve, const std::string& word, double share, Diagnostics& diagnostics) {
  const auto [least, most] = std::minmax_element(curve.x.begin(), curve.x.end());
  const double span = *most - *least;
  if (!(span > 0.0)) {
    diagnostics.error({curve.file, curve.line.front(), 1}, curve.x_name, written_x(curve, 0),
                      fmt::format("the {} is the same in every row, it must rise", word),
                      "choose another column with --x-column");
    return false;
  }
  std::size_t peak = 0;
  int steps = 0;
  double largest = 0.0;
  for (std::size_t i = 1; i < curve.size(); ++i) {
    if (curve.x[i] < curve.x[i - 1]) ++steps;
    if (curve.x[i] >= curve.x[peak]) peak = i;
    const double back = curve.x[peak] - curve.x[i];
    largest = std::max(largest, back);
    if (back <= share * span) continue;
    report_falling(curve, word, i, peak, diagnostics);
    return false;
  }
  if (steps == 0) return true;
  diagnostics.warning(
      {curve.file, curve.line.front(), 1},
      fmt::format("the {} steps back {} time{}, by {:.2g} % of its span at most: the "
                  "rows have been sorted",
                  word, steps, steps == 1 ? "" : "s", 100.0 * largest / span));
  curve = sorted_by_x(curve);
  return true;
}

/// Removes rows with x below 0; reports and returns false if x is below by more than noise.
bool cut_below_zero(Curve& curve, const std::string& word, Diagnostics& diagnostics) {
  const auto below = std::lower_bound(curve.x.begin(), curve.x.end(), 0.0) - curve.x.begin();
  if (below == 0) return true;
  const bool stretch = curve.x_is == Quantity::stretch;
  if (-curve.x.front() > back_share * curve.x.back()) {
    diagnostics.error(
        {curve.file, curve.line.front(), 1}, curve.x_name, written_x(curve, 0),
        stretch ? std::string("the stretch must not be below 1: these tests are of tension")
                : fmt::format("the {} must not be below 0", word),
        stretch ? "take the rows of compression out"
                : "give the extension at which the load begins to rise with --toe, or --toe fit to "
                  "have it found");
    return false;
  }
  diagnostics.warning({curve.file, curve.line.front(), 1},
                      fmt::format("{} row{} with {} below {}, down to {}: left out", below,
                                  below == 1 ? "" : "s", stretch ? "stretch" : word,
                                  stretch ? 1 : 0, written_x(curve, 0)));
  std::vector<std::size_t> rest(curve.size() - static_cast<std::size_t>(below));
  std::iota(rest.begin(), rest.end(), static_cast<std::size_t>(below));
  curve = rows_of(curve, rest);
  return true;
}

bool check_signs(const Curve& curve, const std::string& word, Diagnostics& diagnostics) {
  const auto top =
      static_cast<std::size_t>(std::max_element(curve.y.begin(), curve.y.end()) - curve.y.begin());
  const double most = curve.y[top];
  const auto least = std::min_element(curve.y.begin(), curve.y.end()) - curve.y.begin();
  const std::size_t row = static_cast<std::size_t>(least);
  constexpr double nothing = 1e-12, everything = 1e12; // N: beyond any unit taken for another
  if (most > everything || (most > 0.0 && most < nothing)) {
    diagnostics.error({curve.file, curve.line[top], 1}, curve.y_name, written_y(curve, top),
                      fmt::format("the largest {} must lie between {:g} and {:g} {}", word, nothing,
                                  everything, usual_unit(curve.y_is)),
                      "check the column and its unit (--y-column, --y-unit)");
    return false;
  }
  if (most > 0.0 && curve.y[row] >= -noise_share * most) return true;
  const Place at{curve.file, curve.line[row], 1};
  if (most == 0.0 && curve.y[row] == 0.0) {
    diagnostics.error(at, curve.y_name, "0",
                      fmt::format("the {} is 0 in every row, it must rise", word),
                      "choose another column with --y-column");
    return false;
  }
  const bool turned = !(most > -curve.y[row]);
  diagnostics.error(
      at, curve.y_name, written_y(curve, row),
      fmt::format("the {} must not be below 0 by more than {:g} % of its largest value, {}", word,
                  100.0 * noise_share, written_y(curve, top)),
      turned ? "turn the sign of the column round, or choose another with --y-column"
             : "give the value that the load cell shows without load with --zero, or --zero fit to "
               "have "
               "it found");
  return false;
}

} // namespace

bool check_rising(Curve& curve, const std::string& x_word, Diagnostics& diagnostics, double share) {
  return sort_rows(curve, x_word, share, diagnostics);
}

bool check_zeros(Curve& curve, const std::string& x_word, const std::string& y_word,
                 Diagnostics& diagnostics) {
  return cut_below_zero(curve, x_word, diagnostics) && check_signs(curve, y_word, diagnostics);
}

} // namespace plyform
