// SPDX-License-Identifier: GPL-3.0-or-later
// Compression of yarns: fit_tension.hpp.
#include "base/format.hpp"
#include "core/identify/tension_rows.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace plyform {
namespace {

/// N / C of a yarn that gives way at the shortening `kink`.
Eigen::VectorXd shape_of(const Eigen::VectorXd& shortening, double kink) {
  return (shortening.array().min(kink) + buckled_share * (shortening.array() - kink).max(0.0))
      .matrix();
}

/// Place of the kink with the least residuals: tried at even steps, then refined.
double best_kink(const LoadRows& rows) {
  const double most = rows.x.maxCoeff();
  const auto squares = [&](double kink) {
    return fit_fixed(shape_of(rows.x, kink), rows.y, rows.weights).squares;
  };
  constexpr int steps = 50;
  int best = steps;
  for (int i = 1; i <= steps; ++i)
    if (squares(most * i / steps) < squares(most * best / steps)) best = i;
  return minimum_of(squares, most * std::max(best - 1, 0) / steps + 1e-6 * most,
                    most * std::min(best + 1, steps) / steps);
}

} // namespace

std::optional<CompressionFit> identify_compression(Curve curve, const Strip& strip,
                                                   const FitOptions& options,
                                                   Diagnostics& diagnostics) {
  if (!(strip.yarns > 0.0 && strip.gauge_length > 0.0))
    throw std::invalid_argument("yarns and gauge length must be greater than 0");
  const auto specimen =
      tension_specimen(std::move(curve), strip, options, "shortening", diagnostics);
  if (!specimen) return std::nullopt;
  LoadRows rows = specimen->rows();
  rows.weights = load_weights(rows.y, rows.y);
  const FixedFit line = fit_fixed(rows.x, rows.y, rows.weights);
  const double kink = best_kink(rows);
  LinearFit fit = fit_linear(shape_of(rows.x, kink), rows.y);
  const FixedFit bent = fit_fixed(shape_of(rows.x, kink), rows.y, rows.weights);
  const double n = static_cast<double>(rows.x.size());
  const bool straight = std::sqrt(line.squares / n) <= noisy || bent.squares > 0.5 * line.squares;
  CompressionFit result;
  if (straight)
    fit = fit_linear(rows.x, rows.y);
  else
    result.buckling_force = fit.k[0] * kink;
  result.stiffness = fit.k[0];
  result.stiffness_limits = limits_of_coefficients(fit)[0];
  result.strain = specimen->curve.x;
  result.measured = specimen->curve.y;
  result.fitted = {fit.fitted.begin(), fit.fitted.end()};
  result.quality = quality_of(result.strain, result.measured, result.fitted);
  if (!check_quality(specimen->curve, result.quality,
                     fmt::format("a shortening of {:.3g}", result.quality.largest_at),
                     "the law of a pressed yarn is a line and then a plateau: end the curve before "
                     "it locks, with --to",
                     diagnostics))
    return std::nullopt;
  return result;
}

void check_compression(double stiffness, const std::string& yarns, const Fabric& fabric,
                       const Place& at, Diagnostics& diagnostics) {
  const double pulled = fabric.families[yarns == "warp" ? 0 : 1].tension.largest_slope();
  if (pulled > 0.0 && stiffness > pulled)
    diagnostics.error(at, yarns + ".compression_stiffness", fmt::format("{:.5g}", stiffness),
                      fmt::format("must be at most the stiffness in tension, {:.5g}", pulled),
                      "check units, number of yarns and gauge length");
}

} // namespace plyform
