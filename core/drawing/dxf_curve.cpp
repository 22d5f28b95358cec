// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/drawing/dxf_curve.hpp"

#include "base/format.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace plyform {
namespace {

constexpr double whole_turn = 2.0 * std::numbers::pi;
constexpr int steps_per_turn = 720, steps_per_span = 48; // chords within 1e-5 of the radius

void append_steps(std::vector<double>& run, double from, double to, int steps) {
  if (run.empty()) run.push_back(from);
  for (int i = 1; i < steps; ++i)
    run.push_back(from + (to - from) * i / steps);
  run.push_back(to);
}

/// de Boor's recursion at u in the span [u_k, u_k+1).
Vec2 point_of(const DxfSpline& s, double u) {
  const auto p = static_cast<std::size_t>(s.degree);
  const auto begin = s.knots.begin(), from = begin + s.degree + 1,
             to = begin + static_cast<std::ptrdiff_t>(s.points.size());
  const auto k = static_cast<std::size_t>(std::upper_bound(from, to, u) - begin) - 1;
  std::vector<Vec3> d(s.points.begin() + static_cast<std::ptrdiff_t>(k - p),
                      s.points.begin() + static_cast<std::ptrdiff_t>(k) + 1);
  for (std::size_t r = 1; r <= p; ++r)
    for (std::size_t j = p; j >= r; --j) {
      const double low = s.knots[j + k - p], high = s.knots[j + 1 + k - r];
      const double share = high > low ? (u - low) / (high - low) : 0.0;
      d[j] = (1.0 - share) * d[j - 1] + share * d[j];
    }
  return d[p].head<2>() / d[p].z();
}

/// Whether the points that close a spline follow its others once more.
bool repeats_points(const DxfSpline& s) {
  const auto p = static_cast<std::ptrdiff_t>(s.degree);
  constexpr double rounding = 1e-9;
  return std::equal(s.points.begin(), s.points.begin() + p, s.points.end() - p,
                    [](const Vec3& a, const Vec3& b) {
                      return (a - b).norm() <= rounding * (a.norm() + b.norm());
                    });
}

/// A closed spline with all its points, (1); others as they are.
DxfSpline with_period(const DxfSpline& said) {
  DxfSpline s = said;
  if (!s.closed || s.degree < 1 || s.points.size() < static_cast<std::size_t>(s.degree) + 1)
    return s;
  const auto p = static_cast<std::size_t>(s.degree);
  const std::size_t n = s.points.size();
  const bool all_knots = s.knots.size() == n + 2 * p + 1;
  if (!all_knots && (s.knots.size() != n + p + 1 || repeats_points(s))) return s;
  const double period = s.knots[n] - s.knots[0];
  constexpr double rounding = 1e-6; // of knots written with some digits
  for (std::size_t i = 1; i <= p; ++i)
    if (!(std::abs(s.knots[n + i] - s.knots[i] - period) <= rounding * period)) return s;
  for (std::size_t i = p + 1; s.knots.size() < n + 2 * p + 1; ++i)
    s.knots.push_back(s.knots[i] + period);
  s.points.insert(s.points.end(), said.points.begin(),
                  said.points.begin() + static_cast<std::ptrdiff_t>(p));
  return s;
}

double angle_between(const Vec2& a, const Vec2& b) {
  return std::abs(std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b)));
}

/// How far along a run each parameter is, in pieces.
std::vector<double> measured(const DxfCurve& curve, const std::vector<double>& run,
                             double spacing) {
  constexpr double largest_turn = 0.25 * std::numbers::pi;
  std::vector<double> pieces{0.0};
  Vec2 x = curve.at(run[0]), before = Vec2::Zero();
  for (std::size_t i = 1; i < run.size(); ++i) {
    const Vec2 next = curve.at(run[i]), chord = next - x;
    const double length = chord.norm();
    const double turn = length > 0.0 && !before.isZero(0.0) ? angle_between(before, chord) : 0.0;
    pieces.push_back(pieces.back() + std::max(length / spacing, turn / largest_turn));
    if (length > 0.0) before = chord;
    x = next;
  }
  return pieces;
}

/// Appends the points of one run behind its first one.
void append_run(const DxfCurve& curve, const std::vector<double>& run, double spacing,
                std::size_t most, std::vector<Vec2>& points) {
  const std::vector<double> pieces = measured(curve, run, spacing);
  constexpr double rounding = 1e-9;
  const double wanted = std::ceil(pieces.back() - rounding);
  const auto count = static_cast<std::size_t>(std::clamp(wanted, 1.0, static_cast<double>(most)));
  std::size_t i = 1;
  for (std::size_t k = 1; k < count; ++k) {
    const double goal = pieces.back() * static_cast<double>(k) / static_cast<double>(count);
    while (pieces[i] < goal)
      ++i;
    const double share = (goal - pieces[i - 1]) / (pieces[i] - pieces[i - 1]);
    points.push_back(curve.at(run[i - 1] + share * (run[i] - run[i - 1])));
  }
  points.push_back(curve.at(run.back()));
}

} // namespace

std::string fault_of(const DxfEllipse& e) {
  if (!(e.major.norm() > 0.0)) return "has a major axis of no length";
  if (!(e.ratio > 1e-6 && e.ratio <= 1e6))
    return fmt::format("has the ratio {:g} of its axes, which must be above 0", e.ratio);
  return {};
}

DxfCurve curve_of(const DxfEllipse& e) {
  const double side = e.from_below ? -1.0 : 1.0;
  const Vec2 minor = side * e.ratio * Vec2(-e.major.y(), e.major.x());
  const double ways = std::fmod(e.to - e.from, whole_turn);
  constexpr double rounding = 1e-6; // rad, of parameters written with some digits
  const bool closed = std::abs(ways) < rounding || std::abs(ways) > whole_turn - rounding;
  const double sweep = closed ? whole_turn : ways < 0.0 ? ways + whole_turn : ways;
  DxfCurve curve;
  curve.at = [e, minor](double t) -> Vec2 {
    return e.centre + std::cos(t) * e.major + std::sin(t) * minor;
  };
  curve.closed = closed;
  append_steps(curve.runs.emplace_back(), e.from, e.from + sweep,
               std::max(8, static_cast<int>(steps_per_turn * sweep / whole_turn)));
  return curve;
}

std::string fault_of(const DxfSpline& said) {
  const DxfSpline s = with_period(said);
  if (s.points.empty())
    return "has no control points (fit points alone do not say which curve it is)";
  constexpr std::size_t most = 5000;
  if (s.points.size() > most)
    return fmt::format("has {} control points, more than {}", s.points.size(), most);
  if (s.degree < 1 || s.degree > 25) return fmt::format("has the degree {}", s.degree);
  const std::size_t p = static_cast<std::size_t>(s.degree), count = s.points.size();
  if (count < p + 1 || s.knots.size() != count + p + 1)
    return fmt::format("has {} control points and {} knots for the degree {}", count,
                       s.knots.size(), s.degree);
  if (!std::is_sorted(s.knots.begin(), s.knots.end()) || !(s.knots[p] < s.knots[count]))
    return "has knots that do not ascend";
  if (!std::all_of(s.points.begin(), s.points.end(), [](const Vec3& x) { return x.z() > 0.0; }))
    return "has a weight that is not above 0";
  return {};
}

DxfCurve curve_of(const DxfSpline& said) {
  const DxfSpline s = with_period(said);
  const auto p = static_cast<std::size_t>(s.degree);
  const std::size_t end = s.points.size();
  DxfCurve curve;
  curve.at = [s](double u) { return point_of(s, u); };
  curve.runs.emplace_back();
  for (std::size_t k = p; k < end; ++k) {
    const double from = s.knots[k], to = s.knots[k + 1];
    if (to <= from) continue;
    const auto equal = std::equal_range(s.knots.begin(), s.knots.end(), from);
    if (equal.second - equal.first >= s.degree && !curve.runs.back().empty())
      curve.runs.emplace_back();
    append_steps(curve.runs.back(), from, to, steps_per_span);
  }
  const Vec2 first = curve.at(s.knots[p]), last = curve.at(s.knots[end]);
  constexpr double rounding = 1e-9;
  curve.closed = (last - first).norm() <= rounding * (first.norm() + last.norm());
  return curve;
}

Profile divided(const DxfCurve& curve, double spacing, std::size_t most) {
  std::vector<Vec2> points{curve.at(curve.runs[0][0])};
  for (const std::vector<double>& run : curve.runs)
    if (points.size() <= most) append_run(curve, run, spacing, most, points);
  if (curve.closed) points.back() = points.front();
  Profile chain;
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
    if (points[i] != points[i + 1])
      chain.push_back({ProfileSegment::Kind::line, points[i], points[i + 1]});
  return chain;
}

} // namespace plyform
