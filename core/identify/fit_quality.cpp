// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/identify/fit_quality.hpp"

#include "base/format.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

std::vector<double> values_of(const Eigen::VectorXd& values) {
  return {values.begin(), values.end()};
}

/// The largest of the values and its place.
void largest_of(const Eigen::VectorXd& values, const std::vector<double>& places, double& largest,
                double& at) {
  Eigen::Index row = 0;
  largest = values.maxCoeff(&row);
  at = places[static_cast<std::size_t>(row)];
}

/// Spread of each row of a matrix with a column for each specimen.
std::vector<Spread> spreads_of(const Eigen::MatrixXd& values) {
  std::vector<Spread> spreads;
  for (Eigen::Index i = 0; i < values.rows(); ++i)
    spreads.push_back(spread_of(values_of(values.row(i).transpose())));
  return spreads;
}

Eigen::MatrixXd beside_each_other(const std::vector<Eigen::VectorXd>& columns) {
  Eigen::MatrixXd all(columns.front().size(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t i = 0; i < columns.size(); ++i)
    all.col(static_cast<Eigen::Index>(i)) = columns[i];
  return all;
}

} // namespace

Place place_of(const Curve& curve, std::size_t row) {
  return {curve.file, curve.line[row], 1};
}

FitQuality quality_of(const std::vector<double>& at, const std::vector<double>& measured,
                      const std::vector<double>& fitted) {
  FitQuality quality{.rows = at.size(), .from = at.front(), .to = at.back()};
  const double floor = load_floor * *std::max_element(measured.begin(), measured.end());
  double squares = 0.0;
  for (std::size_t i = 0; i < at.size(); ++i) {
    quality.from = std::min(quality.from, at[i]);
    quality.to = std::max(quality.to, at[i]);
    const double residual = std::abs(measured[i] - fitted[i]) / std::max(fitted[i], floor);
    squares += residual * residual;
    if (residual <= quality.largest) continue;
    quality.largest = residual;
    quality.largest_at = at[i];
  }
  quality.rms = std::sqrt(squares / static_cast<double>(at.size()));
  return quality;
}

bool check_quality(const Curve& curve, const FitQuality& quality, const std::string& where,
                   const std::string& remedy, Diagnostics& diagnostics) {
  const std::string figures = fmt::format("{:.3g} % rms of the load, {:.3g} % at most, at {}",
                                          100.0 * quality.rms, 100.0 * quality.largest, where);
  if (!(quality.rms <= useless)) {
    diagnostics.error(
        place_of(curve), "", "",
        fmt::format("the curve is no law's: residuals {}; they must be less than {:g} %", figures,
                    100.0 * useless),
        remedy);
    return false;
  }
  if (quality.rms > noisy)
    diagnostics.warning(place_of(curve),
                        fmt::format("noise, or a shape that the law does not have: "
                                    "residuals {}; {}",
                                    figures, remedy));
  return true;
}

Confidence confidence_of(const LinearFit& fit, const Eigen::MatrixXd& probes,
                         const std::vector<double>& places) {
  Confidence confidence{values_of(limits_of_coefficients(fit)), 0.0, 0.0};
  largest_of(limits_of_law(fit, probes), places, confidence.law, confidence.law_at);
  return confidence;
}

Scatter scatter_of(const std::vector<Eigen::VectorXd>& k, const Eigen::MatrixXd& probes,
                   const std::vector<double>& places) {
  const Eigen::MatrixXd all = beside_each_other(k);
  Scatter scatter{spreads_of(all), 0.0, 0.0};
  Eigen::VectorXd shares(probes.rows());
  const std::vector<Spread> law = spreads_of(probes * all);
  for (Eigen::Index i = 0; i < shares.size(); ++i)
    shares[i] = law[static_cast<std::size_t>(i)].deviation /
                std::abs(law[static_cast<std::size_t>(i)].mean);
  largest_of(shares, places, scatter.law, scatter.law_at);
  return scatter;
}

Confidence confidence_between(const std::vector<Eigen::VectorXd>& k, const Eigen::MatrixXd& probes,
                              const std::vector<double>& places) {
  const Scatter scatter = scatter_of(k, probes, places);
  const double n = static_cast<double>(k.size());
  Confidence confidence{{}, student_95(n - 1.0) * scatter.law / std::sqrt(n), scatter.law_at};
  for (const Spread& spread : scatter.coefficient)
    confidence.coefficient.push_back(spread.limits);
  return confidence;
}

bool check_usual(const Place& at, const std::string& what, double value, const UsualRange& usual,
                 const std::string& unit, bool doubtful, Diagnostics& diagnostics) {
  if (usual.holds(value)) return true;
  const std::string rule =
      fmt::format("is no fabric's: usually {:g} to {:g} {}", usual.least, usual.most, unit);
  if (doubtful) {
    diagnostics.warning(at, fmt::format("{} = {:.4g} {} {}", what, value, unit, rule));
    return true;
  }
  diagnostics.error(at, what, fmt::format("{:.4g}", value), rule,
                    "check the units of the columns (--x-unit, --y-unit: N or kN?), the size and "
                    "number of yarns of the specimen and the densities of the fabric; "
                    "--yes-doubtful takes it as it is");
  return false;
}

} // namespace plyform
