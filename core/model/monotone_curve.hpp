// SPDX-License-Identifier: GPL-3.0-or-later
// A smooth curve through points that does not rise above or fall below them: piecewise cubic, with
// a continuous slope, monotone wherever the points are.
//
//   h_i, s_i  length of the piece from point i to i + 1, and slope of its chord
//   m_i       slope of the curve at point i: 0 where the chords beside it do not both rise or both
//             fall, else their weighted harmonic mean
//
//   (w_1 + w_2) / m_i = w_1 / s_{i-1} + w_2 / s_i,  w_1 = 2 h_i + h_{i-1},  w_2 = h_i + 2 h_{i-1}
//
// At an end, with the end's piece first: m = ((2 h_1 + h_2) s_1 - h_1 s_2) / (h_1 + h_2), but no
// less than 0 and no more than 3 times s_1 along s_1. Two points make a straight line.
//
// Source: F. N. Fritsch and R. E. Carlson, Monotone piecewise cubic interpolation, SIAM J. Numer.
// Anal. 17 (1980) 238-246; harmonic mean and end formula: F. N. Fritsch and J. Butland, SIAM J.
// Sci. Stat. Comput. 5 (1984) 300-304 (PCHIP). Boost's pchip (1.74) wants four points, gives no
// integral, and takes the chord's slope at the ends; its inner slopes are the same.
#pragma once

#include "core/model/law_point.hpp"

#include <cstddef>
#include <span>

namespace plyform {

/// A piece of the curve: y + m t + c t^2 + d t^3, t = x - begin in [0, length].
struct CubicPiece {
  double begin, length, y, m, c, d;

  double value(double t) const { return y + t * (m + t * (c + t * d)); }
  double slope(double t) const { return m + t * (2.0 * c + 3.0 * t * d); }
  /// From t = 0.
  double integral(double t) const {
    return t * (y + t * (m / 2.0 + t * (c / 3.0 + t * (d / 4.0))));
  }
  double largest_slope() const; ///< in [0, length]
};

/// A curve through the points (x_i, y_i), straight beyond its ends. Holds views of them.
struct MonotoneCurve {
  std::span<const double> x, y; ///< at least two points, x ascending
  /// Whether the points are one half of an odd curve, from (0, 0) on: the other half goes through
  /// (-x_i, -y_i), and the slope at 0 is that of the first chord.
  bool odd = false;

  std::size_t pieces() const { return x.size() - 1; }
  double slope(std::size_t point) const; ///< m
  CubicPiece piece(std::size_t i) const; ///< from point i to i + 1
  /// Value, slope, and integral from 0, where a point must be.
  LawPoint at(double x) const;
  double largest_slope() const;
};

} // namespace plyform
