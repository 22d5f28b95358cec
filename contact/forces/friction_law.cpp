// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/forces/friction_law.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace plyform {
namespace {

/// The piece that holds `at`, by the number of its end; 0 or the last of all beyond the ends.
std::size_t end_of_piece(std::span<const CurvePoint> points, double at) {
  return static_cast<std::size_t>(
      std::upper_bound(points.begin(), points.end(), at,
                       [](double x, const CurvePoint& p) { return x < p.at; }) -
      points.begin());
}

// Octaves in which laws are sampled: what lies beside is straight.
constexpr int lowest_rate = -40, highest_rate = 40; // 1e-12 to 1e12 1/s
constexpr int lowest_hersey = -50, highest_hersey = 30;

constexpr double unsteady_from = 0.1; // of mu

} // namespace

double on_pieces(std::span<const CurvePoint> points, double at) {
  const std::size_t end = end_of_piece(points, at);
  if (end == 0) return points.front().value;
  if (end == points.size()) return points.back().value;
  const CurvePoint &a = points[end - 1], &b = points[end];
  return a.value + (at - a.at) / (b.at - a.at) * (b.value - a.value);
}

double on_log_pieces(std::span<const CurvePoint> points, double at) {
  const std::size_t end = end_of_piece(points, at);
  if (end == 0) return points.front().value;
  if (end == points.size()) return points.back().value;
  const CurvePoint &a = points[end - 1], &b = points[end];
  return a.value * std::pow(b.value / a.value, std::log(at / a.at) / std::log(b.at / a.at));
}

OctaveTable::OctaveTable(const std::function<double(double)>& f, int low, int high, double at_zero)
    : low_(low), least_(std::ldexp(1.0, low)), most_(std::ldexp(1.0, high)), at_zero_(at_zero) {
  for (int octave = low; octave < high; ++octave)
    for (int i = 0; i < pieces; ++i)
      value_.push_back(f(std::ldexp(1.0 + static_cast<double>(i) / pieces, octave)));
  value_.push_back(f(most_));
}

OctaveTable::Answer OctaveTable::at(double x, bool proportional) const {
  if (x < least_) {
    const double slope = (value_.front() - at_zero_) / least_;
    return {at_zero_ + slope * x, slope};
  }
  if (x >= most_) {
    if (!proportional) return {value_.back(), 0.0};
    return {value_.back() * (x / most_), value_.back() / most_};
  }
  // x = 2^octave (1 + along / pieces), as a double keeps it
  constexpr std::uint64_t one = 1023, mantissa = (std::uint64_t{1} << 52) - 1;
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const int octave = static_cast<int>(bits >> 52) - static_cast<int>(one);
  const double along = pieces * (std::bit_cast<double>((bits & mantissa) | one << 52) - 1.0);
  const int piece = std::min(static_cast<int>(along), pieces - 1);
  const auto i = static_cast<std::size_t>((octave - low_) * pieces + piece);
  const double rise = value_[i + 1] - value_[i];
  const double per_octave = std::bit_cast<double>((2 * one - (bits >> 52)) << 52); // 2^-octave
  return {value_[i] + (along - piece) * rise, rise * pieces * per_octave};
}

OctaveTable OctaveTable::falls() const {
  OctaveTable fallen = *this;
  double before = at_zero_, sum = 0.0;
  for (double& value : fallen.value_) {
    sum += std::max(before - value, 0.0);
    before = value, value = sum;
  }
  fallen.at_zero_ = 0.0;
  return fallen;
}

double FrictionLawSpec::hersey(double number) const {
  if (curve.empty()) {
    const double rubbing = boundary > 0.0 ? boundary * std::exp(-number / transition) : 0.0;
    return rubbing + (hydrodynamic > 0.0 ? hydrodynamic * std::pow(number, exponent) : 0.0);
  }
  if (film_beyond && number > curve.back().at)
    return curve.back().value * (number / curve.back().at);
  return on_log_pieces(curve, number);
}

double FrictionLawSpec::film_thickness() const {
  if (kind == Kind::film) return film;
  return film_beyond && !curve.empty() ? curve.back().at / curve.back().value : 0.0;
}

double FrictionLawSpec::viscosity_at(double rate) const {
  return viscosity_curve.empty() ? viscosity : on_log_pieces(viscosity_curve, rate);
}

void RangeSeen::add(double at, double work_here, const CurvePoint& first, const CurvePoint& last) {
  least = std::min(least, at), most = std::max(most, at);
  work += work_here;
  (at < first.at ? below : above) += at < first.at || at > last.at ? work_here : 0.0;
}

void RangeSeen::add(const RangeSeen& more) {
  least = std::min(least, more.least), most = std::max(most, more.most);
  work += more.work, below += more.below, above += more.above;
}

FrictionLaw::FrictionLaw(FrictionLawSpec spec) : spec_(std::move(spec)) {
  if (!has_rates()) return;
  flow_ = OctaveTable([&](double rate) { return spec_.viscosity_at(rate) * rate; }, lowest_rate,
                      highest_rate, 0.0);
  if (spec_.kind == FrictionLawSpec::Kind::hersey)
    hersey_ =
        OctaveTable([&](double number) { return spec_.hersey(number); }, lowest_hersey,
                    highest_hersey, spec_.curve.empty() ? spec_.boundary : spec_.curve[0].value);
  if (spec_.kind != FrictionLawSpec::Kind::hersey) return;
  falls_ = hersey_.falls();
  if (falls_->at(std::ldexp(1.0, highest_hersey), false).value == 0.0) falls_.reset();
}

double FrictionLaw::by_angle(double angle) const {
  return spec_.over_angle.empty() ? 1.0 : on_pieces(spec_.over_angle, angle);
}

double FrictionLaw::drag(double speed, double viscosity) const {
  const double h = spec_.film > 0.0 ? spec_.film : 1.0;
  return viscosity * h * flow_.at(speed / h, true).value;
}

OctaveTable::Answer FrictionLaw::coefficient(const SlidingPlace& place, double number,
                                             double viscosity, double pressure) const {
  OctaveTable::Answer mu = hersey_.at(number, spec_.film_beyond);
  if (!falls_ || !place.kept) return mu;
  const OctaveTable::Answer now = falls_->at(number, false);
  const double usual = falls_->at(drag(*place.kept, viscosity) / pressure, false).value;
  mu = {mu.value + 2.0 * (now.value - usual), mu.slope + 2.0 * now.slope};
  return mu.value > 0.0 ? mu : OctaveTable::Answer{0.0, 0.0};
}

OctaveTable::Answer FrictionLaw::traction(const SlidingPlace& place, double speed,
                                          double viscosity) const {
  const FrictionLawSpec& s = spec_;
  const double by =
      place.angle * (s.over_slip.empty() ? 1.0 : on_pieces(s.over_slip, place.slip)) *
      (s.over_wear.empty() || !place.kept ? 1.0 : on_pieces(s.over_wear, *place.kept));
  const double tack = s.tack.empty() ? 0.0 : on_pieces(s.tack, place.slip);
  if (s.kind == FrictionLawSpec::Kind::coulomb)
    return {by * s.coefficient * place.pressure + tack, 0.0};
  const double h = s.film > 0.0 ? s.film : 1.0; // without it eta does not depend on the rate
  const OctaveTable::Answer flow = flow_.at(speed / h, true);
  if (s.kind == FrictionLawSpec::Kind::film)
    return {by * (s.yield + viscosity * flow.value) + tack, by * viscosity * flow.slope / h};
  const double pressure = std::max(place.pressure, 1e-12);
  const OctaveTable::Answer mu =
      coefficient(place, viscosity * h * flow.value / pressure, viscosity, pressure);
  return {by * pressure * mu.value + tack, by * mu.slope * viscosity * flow.slope};
}

double FrictionLaw::stuck(const SlidingPlace& place, double per_dt, double viscosity) const {
  const double most = place.stretch, k = place.stiffness;
  if (!(most > 0.0) || (has_rates() && per_dt == 0.0)) return most;
  const double at_rest = traction(place, 0.0, viscosity).value;
  if (!has_rates()) return std::min(most, at_rest / k);
  if (k * most <= at_rest) return most;
  // (I) by Newton's method, held between two slips with residuals of different signs; it begins
  // with that of steady sliding
  double low = 0.0, high = most, y = std::clamp(most - place.held, 0.0, most);
  constexpr int enough = 100;
  for (int i = 0; i < enough; ++i) {
    const OctaveTable::Answer t = traction(place, y * per_dt, viscosity);
    const double residual = k * (most - y) - t.value, fall = k + t.slope * per_dt;
    if (std::abs(residual) <= 1e-11 * k * most) break;
    (residual > 0.0 ? low : high) = y;
    const double next = fall > 0.0 ? y + residual / fall : low;
    const double inside = next > low && next < high ? next : 0.5 * (low + high);
    if (inside == y || !(high - low > 1e-15 * most)) break;
    y = inside;
  }
  return most - y;
}

void FrictionLaw::begin(const SlidingPlace& place, double per_dt) const {
  if (falls() && place.held == 0.0 && place.slip == 0.0) *place.kept = place.stretch * per_dt;
}

void FrictionLaw::follow(const SlidingPlace& place, double y, double per_dt, double memory) const {
  if (!falls())
    *place.kept += y;
  else if (per_dt > 0.0 && memory > 0.0)
    *place.kept += (y * per_dt - *place.kept) * -std::expm1(-1.0 / (per_dt * memory));
}

void FrictionLaw::note(const SlidingPlace& place, double y, double per_dt, double viscosity,
                       SlidingSeen& seen) const {
  if (!has_rates() || !(y > 0.0) || per_dt == 0.0) return;
  const double work = place.area * place.stiffness * (place.stretch - y) * y;
  const double speed = y * per_dt, h = spec_.film > 0.0 ? spec_.film : 1.0;
  const CurvePoint none{0.0, 0.0}, no_end{std::numeric_limits<double>::infinity(), 0.0};
  const auto ends = [&](const std::vector<CurvePoint>& curve) {
    return curve.empty() ? std::pair(none, no_end) : std::pair(curve.front(), curve.back());
  };
  if (spec_.film > 0.0) {
    const auto [first, last] = ends(spec_.viscosity_curve);
    seen.rate.add(speed / h, work, first, last);
  }
  if (spec_.flow.factor && !std::isnan(place.celsius))
    seen.temperature.add(place.celsius, work, {spec_.flow.least, 0.0}, {spec_.flow.most, 0.0});
  if (spec_.kind != FrictionLawSpec::Kind::hersey) return;
  const auto [first, last] = ends(spec_.curve);
  const double pressure = std::max(place.pressure, 1e-12);
  const double number = drag(speed, viscosity) / pressure;
  seen.hersey.add(number, work, first, last);
  if (!falls_ || !place.kept) return;
  const double steady = hersey_.at(number, spec_.film_beyond).value;
  const double now = coefficient(place, number, viscosity, pressure).value;
  if (std::abs(now - steady) > unsteady_from * steady) seen.unsteady += work;
}

} // namespace plyform
