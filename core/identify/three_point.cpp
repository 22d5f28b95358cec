// SPDX-License-Identifier: GPL-3.0-or-later
// Three-point bending: bending_tests.hpp.
#include "base/format.hpp"
#include "core/identify/bending_tests.hpp"
#include "core/identify/tension_rows.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

constexpr int moments = 6; ///< of a table, after 0

CurveWords words_of(double span) {
  CurveWords words;
  words.length_unit = "mm";
  words.x_scale = span;
  words.length = 0.1 / span;
  words.can_stretch = false;
  return words;
}

/// x: deflection over the span, y: N, after corrections; and the line through each.
struct Specimens {
  std::vector<TensionSpecimen> all;
  std::vector<LinearFit> lines;
  bool straight = true; ///< a line follows each of them
};

std::optional<Specimens> specimens_of(const std::vector<Curve>& curves, double span,
                                      const FitOptions& options, Diagnostics& diagnostics) {
  Specimens specimens;
  FitOptions small = options;
  small.to = std::min(options.to, small_deflection);
  for (const Curve& curve : curves) {
    auto specimen = tension_specimen(curve, {1.0, span}, small, "deflection", diagnostics);
    if (!specimen) return std::nullopt;
    const LoadRows rows = specimen->rows();
    LinearFit line = fit_linear(rows.x, rows.y);
    const Curve& c = specimen->curve;
    const FitQuality quality = quality_of(c.x, c.y, {line.fitted.begin(), line.fitted.end()});
    if (quality.rms > noisy && !is_shifted_line(c, line.weights, options.corrections))
      specimens.straight = false;
    specimens.all.push_back(std::move(*specimen));
    specimens.lines.push_back(std::move(line));
  }
  return specimens;
}

void put_rows(const Specimens& specimens, double span, BendingFit& result) {
  for (std::size_t n = 0; n < specimens.all.size(); ++n) {
    const Curve& curve = specimens.all[n].curve;
    for (std::size_t i = 0; i < curve.size(); ++i) {
      result.x.push_back(span * curve.x[i]);
      result.measured.push_back(curve.y[i]);
      result.specimen.push_back(n);
    }
  }
}

/// One stiffness: the mean of the specimens'.
bool fit_lines(const Specimens& specimens, double factor, double span, const FitOptions& options,
               BendingFit& result, Diagnostics& diagnostics) {
  const LinearLaw law = line_law();
  const CurveWords words = words_of(span);
  for (std::size_t n = 0; n < specimens.all.size(); ++n) {
    const Curve& curve = specimens.all[n].curve;
    const LinearFit& line = specimens.lines[n];
    LoadRows rows = specimens.all[n].rows();
    rows.weights = line.weights;
    if (!check_disturbances(curve, law, rows, options, words, diagnostics)) return false;
    warn_of_unknowns(curve, law, rows,
                     sensitivities(law, rows, words.length, common_compliance / span), options,
                     words, diagnostics);
    result.of_specimen.push_back(factor * line.k[0]);
    result.stiffness += factor * line.k[0] / static_cast<double>(specimens.all.size());
    const LinearFit sure =
        with_found(line, law, rows, options.corrections, specimens.all[n].corrected);
    result.limits = factor * limits_of_coefficients(sure)[0];
  }
  for (const double x : result.x)
    result.fitted.push_back(result.stiffness / factor * x / span);
  if (specimens.all.size() < 2) return true;
  const Spread spread = spread_of(result.of_specimen);
  result.limits = spread.limits;
  result.scatter = spread.deviation;
  return true;
}

/// Integral of h(M) M dM from 0 to `moment`, h the hat function at knot i of even knots.
double hat_integral(int i, double step, double moment) {
  const auto rising = [&](double from, double to) { // of (M - knot) M / step
    const double knot = (i - 1) * step;
    const auto primitive = [&](double m) { return (m * m * m / 3.0 - knot * m * m / 2.0) / step; };
    return primitive(to) - primitive(from);
  };
  const auto falling = [&](double from, double to) {
    const double knot = (i + 1) * step;
    const auto primitive = [&](double m) { return (knot * m * m / 2.0 - m * m * m / 3.0) / step; };
    return primitive(to) - primitive(from);
  };
  const double low = (i - 1) * step, top = i * step, high = (i + 1) * step;
  double sum = 0.0;
  if (moment > low) sum += rising(low, std::min(moment, top));
  if (moment > top) sum += falling(top, std::min(moment, high));
  return sum;
}

/// Curvatures at even moments, by (b); reports an error and returns false if they do not rise.
bool fit_table(const Specimens& specimens, const ThreePointSpecimen& sizes,
               const FitOptions& options, BendingFit& result, Diagnostics& diagnostics) {
  const Curve& first = specimens.all.front().curve;
  const double most = *std::max_element(result.measured.begin(), result.measured.end());
  const double unit = sizes.span / (4.0 * sizes.width); // M = unit F
  const double step = unit * most / moments;
  const auto rows = static_cast<Eigen::Index>(result.x.size());
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(rows, moments);
  for (Eigen::Index r = 0; r < rows; ++r) {
    const double moment = unit * result.measured[static_cast<std::size_t>(r)];
    if (!(moment > 0.0)) continue;
    for (int i = 1; i <= moments; ++i)
      a(r, i - 1) = std::pow(0.5 * sizes.span / moment, 2) * hat_integral(i, step, moment); // (b)
  }
  const LinearFit fit = fit_linear(a, vector_of(result.x));
  result.table = {.stiffness = 0.0, .curvature = {0.0}, .moment = {0.0}};
  for (int i = 0; i < moments; ++i) {
    if (!(fit.k[i] > result.table.curvature.back())) {
      diagnostics.error(place_of(first), "", "",
                        "no curvature that rises with the moment follows from the curve",
                        "leave out its toe with --toe, its end with --to, or smooth it");
      return false;
    }
    result.table.curvature.push_back(fit.k[i]);
    result.table.moment.push_back((i + 1) * step);
  }
  result.fitted = {fit.fitted.begin(), fit.fitted.end()}; // deflections
  std::swap(result.x, result.measured);
  result.stiffness = result.table.largest_slope();
  result.limits = limits_of_law(fit, Eigen::MatrixXd::Identity(moments, moments)).maxCoeff();
  if (!options.corrections.compliance)
    diagnostics.warning(place_of(first), "the compliance of machine and clamps is not given: give "
                                         "--compliance, 0 where there is none");
  return true;
}

} // namespace

std::optional<BendingFit> identify_three_point(const std::vector<Curve>& curves,
                                               const ThreePointSpecimen& sizes,
                                               const Fabric& fabric, const FitOptions& options,
                                               Diagnostics& diagnostics) {
  const auto specimens = specimens_of(curves, sizes.span, options, diagnostics);
  if (!specimens) return std::nullopt;
  BendingFit result;
  put_rows(*specimens, sizes.span, result);
  const double factor = std::pow(sizes.span, 2) / (48.0 * sizes.width); // B = factor dF / d(d / S)
  const bool good = specimens->straight
                        ? fit_lines(*specimens, factor, sizes.span, options, result, diagnostics)
                        : fit_table(*specimens, sizes, options, result, diagnostics);
  if (!good) return std::nullopt;
  const Curve& first = specimens->all.front().curve;
  result.quality = quality_of(result.x, result.measured, result.fitted);
  result.bending_length = std::cbrt(result.stiffness / fabric.weight());
  if (!check_quality(first, result.quality, fmt::format("{:.3g}", result.quality.largest_at),
                     "leave out its toe with --toe, its end with --to, or smooth the curve",
                     diagnostics) ||
      !check_usual(place_of(first), "bending length", result.bending_length, usual_bending_length,
                   "mm", options.doubtful, diagnostics))
    return std::nullopt;
  return result;
}

} // namespace plyform
