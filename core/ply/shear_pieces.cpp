// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/ply/shear_pieces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace plyform {
namespace {

using Cubic = std::array<double, 4>;

/// |Cs| on one side as a polynomial of t = g - begin, within the piece of the curve there. sign: of
/// the side.
Cubic side_at(const MonotoneCurve& curve, double begin, double sign) {
  const std::span<const double> x = curve.x;
  if (curve.odd) sign = 1.0;
  const double outermost = sign > 0.0 ? x.back() : -x.front();
  if (begin >= outermost) { // straight
    const LawPoint end = curve.at(sign * begin);
    return {sign * end.value, end.slope, 0.0, 0.0};
  }
  // the piece that lies outwards of `begin`
  const auto above = sign > 0.0 ? std::upper_bound(x.begin(), x.end(), begin)
                                : std::lower_bound(x.begin(), x.end(), -begin);
  const CubicPiece p = curve.piece(static_cast<std::size_t>(above - x.begin()) - 1);
  const double t = sign * begin - p.begin;
  return {sign * p.value(t), p.slope(t), sign * (p.c + 3.0 * p.d * t), p.d};
}

/// Intervals as wide as the shortest piece, if they are not too many, so that at most one piece
/// begins within each.
void find_intervals(const std::vector<double>& begins, ShearTable& table) {
  constexpr double most = 512.0;
  const double range = begins.back();
  double shortest = range;
  for (std::size_t i = 1; i < begins.size(); ++i)
    shortest = std::min(shortest, begins[i] - begins[i - 1]);
  const double count = std::min(most, std::ceil(range / shortest));
  table.per_width = count / range;
  std::size_t piece = 0;
  for (int i = 0; i <= static_cast<int>(count); ++i) {
    while (piece + 1 < begins.size() && begins[piece + 1] * table.per_width <= i)
      ++piece;
    table.intervals.push_back({static_cast<int>(piece)});
  }
}

} // namespace

ShearTable shear_table(const ShearLaw& law, double cells) {
  const MonotoneCurve curve = law.curve();
  std::vector<double> begins;
  for (const double angle : law.angle)
    begins.push_back(std::abs(angle));
  std::sort(begins.begin(), begins.end());
  begins.erase(std::unique(begins.begin(), begins.end()), begins.end());
  ShearTable table;
  for (const double begin : begins) {
    const Cubic plus = side_at(curve, begin, 1.0), minus = side_at(curve, begin, -1.0);
    ShearPiece& piece = table.pieces.emplace_back();
    piece.begin = begin;
    for (std::size_t i = 0; i < plus.size(); ++i) {
      piece.odd[i] = 0.5 * cells * (plus[i] + minus[i]);
      piece.even[i] = 0.5 * cells * (plus[i] - minus[i]);
    }
    piece.even_energy = 0.5 * cells * (curve.at(begin).energy - curve.at(-begin).energy);
  }
  ShearPiece never{};
  never.begin = std::numeric_limits<double>::infinity();
  table.pieces.insert(table.pieces.end(), 2, never);
  find_intervals(begins, table);
  return table;
}

} // namespace plyform
