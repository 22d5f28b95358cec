// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/model/monotone_curve.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

double chord(const MonotoneCurve& curve, std::size_t i) {
  return (curve.y[i + 1] - curve.y[i]) / (curve.x[i + 1] - curve.x[i]);
}

/// m at an end. h_1, s_1: of the piece that ends there; h_2, s_2: of the next one.
double slope_at_end(double h_1, double s_1, double h_2, double s_2) {
  const double m = ((2.0 * h_1 + h_2) * s_1 - h_1 * s_2) / (h_1 + h_2);
  return s_1 >= 0.0 ? std::clamp(m, 0.0, 3.0 * s_1) : std::clamp(m, 3.0 * s_1, 0.0);
}

} // namespace

double CubicPiece::largest_slope() const {
  double largest = std::max(m, slope(length));
  if (const double top = -c / (3.0 * d); d < 0.0 && top > 0.0 && top < length)
    largest = std::max(largest, slope(top));
  return largest;
}

double MonotoneCurve::slope(std::size_t i) const {
  const std::size_t last = x.size() - 1;
  if (last == 1 || (odd && i == 0)) return chord(*this, 0);
  const auto h = [&](std::size_t piece) { return x[piece + 1] - x[piece]; };
  if (i == 0) return slope_at_end(h(0), chord(*this, 0), h(1), chord(*this, 1));
  if (i == last)
    return slope_at_end(h(last - 1), chord(*this, last - 1), h(last - 2), chord(*this, last - 2));
  const double before = chord(*this, i - 1), after = chord(*this, i);
  if (!(before * after > 0.0)) return 0.0;
  const double w_1 = 2.0 * h(i) + h(i - 1), w_2 = h(i) + 2.0 * h(i - 1);
  return (w_1 + w_2) / (w_1 / before + w_2 / after);
}

CubicPiece MonotoneCurve::piece(std::size_t i) const {
  const double h = x[i + 1] - x[i], s = chord(*this, i), m = slope(i), end = slope(i + 1);
  return {x[i], h, y[i], m, (3.0 * s - 2.0 * m - end) / h, (m + end - 2.0 * s) / (h * h)};
}

LawPoint MonotoneCurve::at(double a) const {
  if (odd && a < 0.0) {
    const LawPoint p = at(-a);
    return {-p.value, p.slope, p.energy};
  }
  const auto first_above = [&](double value) {
    return static_cast<std::size_t>(std::upper_bound(x.begin(), x.end(), value) - x.begin());
  };
  const std::size_t last = x.size() - 1, origin = first_above(0.0) - 1,
                    above = std::min(first_above(a), last + 1);
  if (above == 0 || above > last) { // beyond an end
    const std::size_t end = above == 0 ? 0 : last;
    const double m = slope(end), t = a - x[end];
    double energy = t * (y[end] + 0.5 * m * t);
    for (std::size_t i = origin; i < end; ++i)
      energy += piece(i).integral(x[i + 1] - x[i]);
    for (std::size_t i = end; i < origin; ++i)
      energy -= piece(i).integral(x[i + 1] - x[i]);
    return {y[end] + m * t, m, energy};
  }
  const CubicPiece own = piece(above - 1);
  const double t = a - own.begin;
  double energy = own.integral(t);
  for (std::size_t i = origin; i < above - 1; ++i)
    energy += piece(i).integral(x[i + 1] - x[i]);
  for (std::size_t i = above - 1; i < origin; ++i)
    energy -= piece(i).integral(x[i + 1] - x[i]);
  return {own.value(t), own.slope(t), energy};
}

double MonotoneCurve::largest_slope() const {
  double largest = slope(0);
  for (std::size_t i = 0; i < pieces(); ++i)
    largest = std::max(largest, piece(i).largest_slope());
  return largest;
}

} // namespace plyform
