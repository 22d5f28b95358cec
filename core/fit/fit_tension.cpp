// SPDX-License-Identifier: GPL-3.0-or-later
// Identifies a yarn's law of tension against strain from a strip or yarn test.
#include "core/fit/fit_shear.hpp"
#include "core/fit/weighted_fit.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>

namespace plyform {
namespace {

constexpr double much_strain = 0.1, impossible_strain = 0.5;

Place place_of(const Curve& curve, std::size_t row = 0) {
  return {curve.file, curve.line[row], 1};
}

/// Converts x and y to strain and tension (N) of one yarn, and keeps only the rows in the range.
void scale_curve(Curve& curve, const Strip& strip, const FitOptions& options) {
  Curve scaled = curve;
  scaled.x.clear();
  scaled.y.clear();
  scaled.line.clear();
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const double strain = curve.x[i] / strip.gauge_length;
    if (strain < options.from || strain > options.to) continue;
    scaled.x.push_back(strain);
    scaled.y.push_back(curve.y[i] / strip.yarns);
    scaled.line.push_back(curve.line[i]);
  }
  curve = std::move(scaled);
}

bool enough(const Curve& curve, const Place& start, Diagnostics& diagnostics) {
  const auto strained =
      std::count_if(curve.x.begin(), curve.x.end(), [](double strain) { return strain > 0.0; });
  if (strained < 2) {
    diagnostics.error(
        start, "", "",
        fmt::format("{} row{} with a strain above 0 within the range, a law of tension "
                    "needs at least 2",
                    strained, strained == 1 ? "" : "s"),
        "record more rows, or widen --from and --to");
    return false;
  }
  const double most = curve.x.back();
  if (most >= impossible_strain) {
    diagnostics.error(place_of(curve, curve.size() - 1), curve.x_name, fmt::format("{:g}", most),
                      fmt::format("the strain must be less than {:g}", impossible_strain),
                      "give --gauge-length if the column is a displacement in mm, 100 if it is a "
                      "strain in %");
    return false;
  }
  if (most > much_strain)
    diagnostics.warning(place_of(curve, curve.size() - 1),
                        fmt::format("a strain of {:.3g} is much for a yarn: if the column is in %, "
                                    "give --gauge-length 100",
                                    most));
  return true;
}

Eigen::VectorXd vector_of(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

/// Strains of the table after 0, up to the last: those of the curve if they are few, else a
/// selection at even distances. None closer than 1/200 of the largest, where noise would give large
/// slopes.
std::vector<double> knots_of(const Curve& curve) {
  const double last = curve.x.back(), apart = 0.005 * last;
  std::vector<double> strains;
  for (const double strain : curve.x)
    if (strain > (strains.empty() ? 0.0 : strains.back() + apart)) strains.push_back(strain);
  strains.back() = last;
  if (strains.size() < table_rows) return strains;
  std::vector<double> knots;
  for (std::size_t i = 1; i < table_rows; ++i)
    knots.push_back(strains[i * strains.size() / (table_rows - 1) - 1]);
  return knots;
}

/// Tensions at the knots of the piecewise linear law from 0 that fits the rows best.
std::vector<double> tensions_at(const std::vector<double>& knots, const Curve& curve) {
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(curve.size()),
                                            static_cast<Eigen::Index>(knots.size()));
  for (std::size_t r = 0; r < curve.size(); ++r) {
    const auto above = std::lower_bound(knots.begin(), knots.end(), curve.x[r]) - knots.begin();
    const auto k = static_cast<std::size_t>(above); // the last knot is the last strain
    const double left = k > 0 ? knots[k - 1] : 0.0;
    const double share = (curve.x[r] - left) / (knots[k] - left);
    a(static_cast<Eigen::Index>(r), above) = share;
    if (k > 0) a(static_cast<Eigen::Index>(r), above - 1) = 1.0 - share;
  }
  const Eigen::VectorXd k = weighted_least_squares(a, vector_of(curve.y));
  return {k.begin(), k.end()};
}

/// Replaces the tensions by the nearest non-decreasing ones (pool adjacent violators); returns the
/// largest change.
double make_rising(std::vector<double>& tension) {
  struct Pool {
    double sum;
    std::size_t count;
    double mean() const { return sum / static_cast<double>(count); }
  };
  std::vector<Pool> pools;
  for (const double value : tension) {
    pools.push_back({value, 1});
    while (pools.size() > 1 && pools[pools.size() - 2].mean() > pools.back().mean()) {
      pools[pools.size() - 2].sum += pools.back().sum;
      pools[pools.size() - 2].count += pools.back().count;
      pools.pop_back();
    }
  }
  double change = 0.0;
  std::size_t i = 0;
  for (const Pool& pool : pools)
    for (std::size_t n = 0; n < pool.count; ++n, ++i) {
      const double risen = std::max(pool.mean(), 0.0);
      change = std::max(change, std::abs(risen - tension[i]));
      tension[i] = risen;
    }
  return change;
}

/// The table; reports an error and returns nothing if the curve softens.
std::optional<TensionLaw> table_of(const Curve& curve, Diagnostics& diagnostics) {
  std::vector<double> knots = knots_of(curve), tension = tensions_at(knots, curve);
  const double most = *std::max_element(tension.begin(), tension.end());
  const auto peak = std::max_element(curve.y.begin(), curve.y.end()) - curve.y.begin();
  if (const double change = make_rising(tension); change > noise_share * most) {
    diagnostics.error(
        place_of(curve, static_cast<std::size_t>(peak)), curve.y_name,
        fmt::format("{:g}", curve.y[peak]),
        fmt::format("the tension falls with rising strain, by more than {:g} % of its "
                    "largest value: a yarn that softens is not modelled",
                    100.0 * noise_share),
        "end the curve before it breaks, with --to, or smooth it");
    return std::nullopt;
  }
  while (knots.size() > 1 && tension[tension.size() - 2] == tension.back()) {
    knots.pop_back(); // the last slope is used beyond the table: noise must not make it 0
    tension.pop_back();
  }
  TensionLaw law{.strain = {0.0}, .tension = {0.0}};
  law.strain.insert(law.strain.end(), knots.begin(), knots.end());
  law.tension.insert(law.tension.end(), tension.begin(), tension.end());
  return law;
}

TensionFit result_of(const TensionLaw& law, const Curve& curve) {
  TensionFit result;
  result.law = law;
  result.strain = curve.x;
  result.measured = curve.y;
  for (const double strain : curve.x)
    result.fitted.push_back(law.at(strain).value);
  result.quality = quality_of(result.strain, result.measured, result.fitted);
  return result;
}

} // namespace

std::optional<TensionFit> identify_tension(Curve curve, const Strip& strip,
                                           const FitOptions& options, Diagnostics& diagnostics) {
  if (!(strip.yarns > 0.0 && strip.gauge_length > 0.0))
    throw std::invalid_argument("yarns and gauge length must be greater than 0");
  if (!(options.from >= 0.0 && options.to > options.from))
    throw std::invalid_argument("the range must start at 0 or above and end above its start");
  if (!check_curve(curve, "strain", "tension", diagnostics)) return std::nullopt;
  const Place start = place_of(curve);
  scale_curve(curve, strip, options);
  if (!enough(curve, start, diagnostics)) return std::nullopt;
  TensionLaw line;
  line.stiffness = weighted_least_squares(vector_of(curve.x), vector_of(curve.y))[0];
  TensionFit result = result_of(line, curve);
  if (result.quality.rms > noisy) {
    const std::optional<TensionLaw> table = table_of(curve, diagnostics);
    if (!table) return std::nullopt;
    const TensionFit with_table = result_of(*table, curve);
    if (with_table.quality.rms < 0.5 * result.quality.rms) result = with_table;
  }
  if (!check_quality(curve, result.quality,
                     fmt::format("a strain of {:.3g}", result.quality.largest_at),
                     "check the columns, or smooth the curve", diagnostics))
    return std::nullopt;
  return result;
}

} // namespace plyform
