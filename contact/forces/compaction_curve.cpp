// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/forces/compaction_curve.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace plyform {
namespace {

/// Fine enough that straight pieces follow p = k (V^12 - V0^12) within 0.1 % of its end.
constexpr std::size_t pieces = 256;

/// y at x on a polyline that ascends in x, held beyond its ends.
double on_line(std::span<const double> xs, std::span<const double> ys, double x) {
  const auto above = std::upper_bound(xs.begin(), xs.end(), x);
  if (above == xs.begin()) return ys.front();
  if (above == xs.end()) return ys.back();
  const std::size_t i = static_cast<std::size_t>(above - xs.begin());
  return ys[i - 1] + (ys[i] - ys[i - 1]) * (x - xs[i - 1]) / (xs[i] - xs[i - 1]);
}

void check(const HalfCompaction& half) {
  const auto ascends = [](std::span<const double> v) {
    return std::adjacent_find(v.begin(), v.end(), std::greater_equal<>()) == v.end();
  };
  if (half.depth.size() < 2 || half.depth.size() != half.pressure.size() ||
      half.depth.front() != 0.0 || half.pressure.front() != 0.0 || !ascends(half.depth) ||
      !ascends(half.pressure))
    throw std::invalid_argument("a compaction curve ascends from depth 0 and pressure 0");
}

} // namespace

CompactionCurve::CompactionCurve(const HalfCompaction* a, const HalfCompaction* b, double most) {
  std::vector<double> p; // where the pressures of either bend, up to where the first is packed
  double least = most;
  for (const HalfCompaction* half : {a, b})
    if (half) {
      check(*half);
      p.insert(p.end(), half->pressure.begin(), half->pressure.end());
      least = std::min(least, half->pressure.back());
    }
  if (p.empty()) throw std::invalid_argument("a compaction curve of nothing");
  std::sort(p.begin(), p.end());
  p.erase(std::unique(p.begin(), p.end()), p.end());
  p.erase(std::lower_bound(p.begin(), p.end(), least), p.end());
  p.push_back(least);
  std::vector<double> depth;
  for (const double pressure : p) {
    double sum = 0.0;
    for (const HalfCompaction* half : {a, b})
      if (half) sum += on_line(half->pressure, half->depth, pressure);
    depth.push_back(sum);
  }
  packed_ = depth.back();
  const double spacing = packed_ / pieces;
  per_spacing_ = 1.0 / spacing;
  for (std::size_t i = 0; i <= pieces; ++i)
    pressure_.push_back(on_line(depth, p, static_cast<double>(i) * spacing));
  energy_.push_back(0.0);
  double steepest = 0.0;
  for (std::size_t i = 0; i < pieces; ++i) {
    energy_.push_back(energy_.back() + 0.5 * spacing * (pressure_[i] + pressure_[i + 1]));
    steepest = std::max(steepest, (pressure_[i + 1] - pressure_[i]) * per_spacing_);
    steepest_.push_back(steepest);
  }
}

std::size_t CompactionCurve::piece_of(double depth) const {
  const double at = std::clamp(depth * per_spacing_, 0.0, static_cast<double>(pieces - 1));
  return static_cast<std::size_t>(at);
}

double CompactionCurve::pressure(double depth) const {
  const std::size_t i = piece_of(depth);
  const double along = depth * per_spacing_ - static_cast<double>(i);
  return pressure_[i] + along * (pressure_[i + 1] - pressure_[i]);
}

double CompactionCurve::energy(double depth) const {
  const std::size_t i = piece_of(depth);
  const double along = depth * per_spacing_ - static_cast<double>(i);
  return energy_[i] +
         along / per_spacing_ * (pressure_[i] + 0.5 * along * (pressure_[i + 1] - pressure_[i]));
}

double CompactionCurve::depth_at(double pressure) const {
  const auto above = std::upper_bound(pressure_.begin(), pressure_.end(), pressure);
  if (above == pressure_.begin()) return 0.0;
  if (above == pressure_.end()) return packed_;
  const auto i = static_cast<std::size_t>(above - pressure_.begin());
  return (static_cast<double>(i - 1) +
          (pressure - pressure_[i - 1]) / (pressure_[i] - pressure_[i - 1])) /
         per_spacing_;
}

} // namespace plyform
