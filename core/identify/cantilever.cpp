// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/format.hpp"
#include "core/identify/bending_tests.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace plyform {
namespace {

constexpr double steepest =
    85.0 * degree; // of the chord: beyond, a strip hangs whatever its stiffness

/// A strip by (a): L, sag and horizontal reach over c.
struct Hanging {
  double length = 0.0, sag = 0.0, reach = 0.0;
};

/// Integrates (a) from the free end, whose tangent is `tip` (rad) below the horizontal, to the
/// edge.
Hanging hanging_with(double tip) {
  constexpr double h = 2e-3; // of t; fourth-order Runge-Kutta: an error of 1e-11
  Hanging strip;
  double theta = tip, slope = 0.0;
  const auto bend = [](double t, double angle) { return -t * std::cos(angle); };
  while (true) {
    const double t = strip.length;
    const double k1 = slope, m1 = bend(t, theta);
    const double k2 = slope + 0.5 * h * m1, m2 = bend(t + 0.5 * h, theta + 0.5 * h * k1);
    const double k3 = slope + 0.5 * h * m2, m3 = bend(t + 0.5 * h, theta + 0.5 * h * k2);
    const double k4 = slope + h * m3, m4 = bend(t + h, theta + h * k3);
    const double next = theta + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    const double middle = theta + h / 4.0 * (k1 + k2); // at half the step, for the integrals
    // the last step ends where theta is 0, nearly straight there
    const double part = next > 0.0 ? 1.0 : theta / (theta - next);
    const double end = std::max(next, 0.0);
    const double mean = part < 1.0 ? 0.5 * theta : middle;
    strip.sag += part * h / 6.0 * (std::sin(theta) + 4.0 * std::sin(mean) + std::sin(end));
    strip.reach += part * h / 6.0 * (std::cos(theta) + 4.0 * std::cos(mean) + std::cos(end));
    strip.length += part * h;
    if (next <= 0.0) return strip;
    theta = next;
    slope += h / 6.0 * (m1 + 2.0 * m2 + 2.0 * m3 + m4);
  }
}

/// L/c at which a measure of the strip, which grows with the angle of its tip, has a value.
template <class Measure>
double overhang_where(const Measure& measure, double value) {
  double low = 1e-6, high = 0.5 * std::numbers::pi - 1e-9;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (measure(hanging_with(middle)) < value ? low : high) = middle;
  }
  return hanging_with(0.5 * (low + high)).length;
}

/// Bending length of one reading, mm; reports an error and returns nothing if it cannot be.
std::optional<double> length_of(const Curve& curve, std::size_t row, CantileverReading reading,
                                Diagnostics& diagnostics) {
  const double overhang = curve.x[row], y = curve.y[row];
  const auto wrong = [&](const std::string& item, const std::string& value, const std::string& rule,
                         const std::string& remedy) {
    diagnostics.error(place_of(curve, row), item, value, rule, remedy);
    return std::nullopt;
  };
  if (!(overhang > 0.0))
    return wrong(curve.x_name, written_x(curve, row), "the overhang must be greater than 0",
                 "give the length that hangs over the edge, in mm");
  if (reading == CantileverReading::chord_angle) {
    if (y > 0.0 && y <= steepest) return overhang / overhang_at_chord(y);
    return wrong(curve.y_name, written_y(curve, row),
                 "the angle must be above 0 and at most 85 degrees",
                 "give the angle of the line from the edge to the tip below the horizontal; of "
                 "angles near 90 degrees nothing follows, let less hang over");
  }
  if (y > 0.0 && y <= 0.95 * overhang) return overhang / overhang_at_sag(y / overhang);
  return wrong(curve.y_name, written_y(curve, row),
               "the deflection must be above 0 and at most 0.95 of the overhang",
               "give how much lower the tip is than the edge, in mm; let less hang over");
}

/// Warns if longer overhangs, which bend more, give another stiffness.
void warn_of_trend(const Curve& curve, const std::vector<double>& lengths,
                   Diagnostics& diagnostics) {
  const auto [shortest, longest] = std::minmax_element(curve.x.begin(), curve.x.end());
  if (curve.size() < 4 || *longest < 1.2 * *shortest) return;
  Eigen::MatrixXd a(static_cast<Eigen::Index>(curve.size()), 2);
  Eigen::VectorXd b(a.rows());
  for (Eigen::Index i = 0; i < a.rows(); ++i) {
    a.row(i) << std::log(*longest / curve.x[static_cast<std::size_t>(i)]), 1.0;
    b[i] = std::log(lengths[static_cast<std::size_t>(i)]);
  }
  const FixedFit fit = fit_fixed(a, b, Eigen::ArrayXd::Ones(a.rows()));
  const double freedom = static_cast<double>(a.rows() - 2);
  const double error = std::sqrt(fit.squares / freedom * (a.transpose() * a).inverse()(0, 0));
  if (student_beyond(fit.k[0] / error, freedom) > 0.01) return;
  const double ratio = std::pow(*longest / *shortest, -3.0 * fit.k[0]);
  diagnostics.warning(place_of(curve),
                      fmt::format("the longest overhang has {:.2g} times the bending stiffness of "
                                  "the shortest: the fabric does not bend linearly; take overhangs "
                                  "with the curvature of the part, or bending_table from "
                                  "three-point bending",
                                  ratio));
}

} // namespace

double overhang_at_chord(double angle) {
  if (!(angle > 0.0 && angle < 0.5 * std::numbers::pi))
    throw std::invalid_argument("the chord's angle must be above 0 and below 90 degrees");
  return overhang_where([](const Hanging& s) { return std::atan2(s.sag, s.reach); }, angle);
}

double overhang_at_sag(double share) {
  if (!(share > 0.0 && share < 1.0))
    throw std::invalid_argument("the sag over the length must be above 0 and below 1");
  return overhang_where([](const Hanging& s) { return s.sag / s.length; }, share);
}

std::optional<BendingFit> identify_cantilever(const std::vector<Curve>& curves,
                                              CantileverReading reading, const Fabric& fabric,
                                              const FitOptions& options, Diagnostics& diagnostics) {
  const double weight = fabric.weight();
  const std::size_t errors = diagnostics.errors.size();
  BendingFit result;
  std::vector<double> all, of_specimen;
  for (std::size_t n = 0; n < curves.size(); ++n) {
    std::vector<double> lengths;
    for (std::size_t i = 0; i < curves[n].size(); ++i) {
      const auto length = length_of(curves[n], i, reading, diagnostics);
      if (!length) return std::nullopt;
      lengths.push_back(*length);
      result.x.push_back(curves[n].x[i]);
      result.measured.push_back(weight * std::pow(*length, 3));
      result.specimen.push_back(n);
    }
    warn_of_trend(curves[n], lengths, diagnostics);
    all.insert(all.end(), lengths.begin(), lengths.end());
    double mean = 0.0;
    for (const double length : lengths)
      mean += length / static_cast<double>(lengths.size());
    of_specimen.push_back(mean);
    result.of_specimen.push_back(weight * std::pow(mean, 3));
    result.bending_length += mean / static_cast<double>(curves.size());
  }
  if (diagnostics.errors.size() > errors ||
      !check_usual(place_of(curves.front()), "bending length", result.bending_length,
                   usual_bending_length, "mm", options.doubtful, diagnostics))
    return std::nullopt;
  result.stiffness = weight * std::pow(result.bending_length, 3);
  result.fitted.assign(all.size(), result.stiffness);
  result.quality = quality_of(result.x, result.measured, result.fitted);
  const std::vector<double>& sample = of_specimen.size() > 1 ? of_specimen : all;
  if (sample.size() > 1) // dB = 3 w c^2 dc
    result.limits = 3.0 * weight * std::pow(result.bending_length, 2) * spread_of(sample).limits;
  if (of_specimen.size() > 1) result.scatter = spread_of(result.of_specimen).deviation;
  return result;
}

} // namespace plyform
