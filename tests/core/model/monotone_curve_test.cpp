// SPDX-License-Identifier: GPL-3.0-or-later
// The monotone curve against closed forms, and its inner slopes against Boost's.
#include "core/model/monotone_curve.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <random>
#include <vector>

using std::isnan; // Boost 1.74 looks for it in the global namespace
#include <boost/math/interpolators/pchip.hpp>

namespace plyform::monotone_curve_test {
namespace {

struct Points {
  std::vector<double> x, y;
  MonotoneCurve curve(bool odd = false) const { return {x, y, odd}; }
};

/// Points through (0, 0) in steps of 0.1 to 1, rising, now and then level.
Points rising(std::mt19937_64& random, int below, int above) {
  std::uniform_real_distribution<double> step(0.1, 1.0), rise(-0.3, 1.0);
  Points p;
  p.x.push_back(0.0), p.y.push_back(0.0);
  for (int i = 0; i < above; ++i) {
    p.x.push_back(p.x.back() + step(random));
    p.y.push_back(p.y.back() + std::max(0.0, rise(random)));
  }
  for (int i = 0; i < below; ++i) {
    p.x.insert(p.x.begin(), p.x.front() - step(random));
    p.y.insert(p.y.begin(), p.y.front() - std::max(0.0, rise(random)));
  }
  return p;
}

TEST(MonotoneCurve, GoesThroughItsPointsRisesAndHasNoKinks) {
  std::mt19937_64 random(1);
  for (int trial = 0; trial < 200; ++trial) {
    const Points p = rising(random, trial % 4, 1 + trial % 7);
    const MonotoneCurve curve = p.curve(trial % 4 == 0);
    const std::size_t last = p.x.size() - 1;
    for (std::size_t i = 0; i <= last; ++i) {
      EXPECT_EQ(curve.at(p.x[i]).value, p.y[i]);
      if (i == last) continue;
      const CubicPiece piece = curve.piece(i);
      EXPECT_NEAR(piece.value(piece.length), p.y[i + 1], 1e-14);
      EXPECT_NEAR(piece.slope(piece.length), curve.slope(i + 1), 1e-13); // of the next one
    }
    double before = -1e9, largest = 0.0;
    for (double x = p.x[0] - 0.5; x < p.x[last] + 0.5; x += 1e-3) {
      const LawPoint at = curve.at(x);
      EXPECT_GE(at.value, before - 1e-15) << x;
      EXPECT_GE(at.slope, -1e-14) << x;
      before = at.value, largest = std::max(largest, at.slope);
    }
    EXPECT_LE(largest, curve.largest_slope() * (1.0 + 1e-12));
    EXPECT_GE(largest, curve.largest_slope() * (1.0 - 1e-4)); // looked for in steps
  }
}

TEST(MonotoneCurve, ValueIsTheSlopeOfItsIntegral) {
  std::mt19937_64 random(2);
  constexpr double h = 1e-6;
  for (int trial = 0; trial < 50; ++trial) {
    const Points p = rising(random, trial % 4, 1 + trial % 5);
    const MonotoneCurve curve = p.curve(trial % 4 == 0);
    EXPECT_EQ(curve.at(0.0).energy, 0.0);
    for (double x = p.x.front() - 1.0; x < p.x.back() + 1.0; x += 0.0371) {
      const LawPoint at = curve.at(x), below = curve.at(x - h), above = curve.at(x + h);
      EXPECT_NEAR(at.value, (above.energy - below.energy) / (2.0 * h), 1e-8) << x;
      EXPECT_NEAR(at.slope, (above.value - below.value) / (2.0 * h), 1e-4) << x; // across a knot
      if (curve.odd) {
        EXPECT_EQ(curve.at(-x).value, -at.value);
        EXPECT_EQ(curve.at(-x).energy, at.energy);
      }
    }
  }
}

TEST(MonotoneCurve, HasTheInnerSlopesOfBoost) {
  std::mt19937_64 random(3);
  for (int trial = 0; trial < 50; ++trial) {
    const Points p = rising(random, 2, 4);
    auto x = p.x, y = p.y;
    const boost::math::interpolators::pchip<std::vector<double>> other(
        std::move(x), std::move(y), p.curve().slope(0), p.curve().slope(p.x.size() - 1));
    for (double at = p.x.front() + 1e-9; at < p.x.back(); at += 0.01) {
      EXPECT_NEAR(p.curve().at(at).value, other(at), 1e-13) << at;
      EXPECT_NEAR(p.curve().at(at).slope, other.prime(at), 1e-12) << at;
    }
  }
}

/// Straight lines and, at even distances, parabolas that rise: known in full.
TEST(MonotoneCurve, IsExactForALine) {
  const Points p{{-1.0, -0.3, 0.0, 0.5, 2.0}, {-2.0, -0.6, 0.0, 1.0, 4.0}};
  for (const double x : {-3.0, -0.7, -0.1, 0.2, 1.9, 5.0}) {
    EXPECT_NEAR(p.curve().at(x).value, 2.0 * x, 1e-14);
    EXPECT_NEAR(p.curve().at(x).slope, 2.0, 1e-14);
    EXPECT_NEAR(p.curve().at(x).energy, x * x, 1e-13);
  }
  EXPECT_NEAR(p.curve().largest_slope(), 2.0, 1e-14);
}

/// By hand: chords 1 and 3 of lengths 1 and 2, so that m_1 = (5 + 4) / (5/1 + 4/3) = 27/19; at the
/// ends (4 x 1 - 3)/3 = 1/3 and (5 x 3 - 2)/3 = 13/3.
TEST(MonotoneCurve, HasTheSlopesOfItsFormulas) {
  const Points p{{0.0, 1.0, 3.0}, {0.0, 1.0, 7.0}};
  EXPECT_NEAR(p.curve().slope(0), 1.0 / 3.0, 1e-15);
  EXPECT_NEAR(p.curve().slope(1), 27.0 / 19.0, 1e-15);
  EXPECT_NEAR(p.curve().slope(2), 13.0 / 3.0, 1e-15);
  EXPECT_EQ(p.curve(true).slope(0), 1.0); // of an odd curve both chords at 0 are the same
  EXPECT_NEAR(p.curve().at(4.0).value, 7.0 + 13.0 / 3.0, 1e-14); // straight beyond the end
}

/// Of a cubic at even distances the error falls with the third power of the distance where it
/// rises, ends included.
TEST(MonotoneCurve, ComesNearACubicWithTheThirdOrder) {
  const auto cubic = [](double x) { return x + 0.8 * x * x * x; };
  double before = 0.0;
  for (const int pieces : {8, 16, 32, 64}) {
    Points p;
    for (int i = 0; i <= pieces; ++i) {
      p.x.push_back(1.2 * i / pieces);
      p.y.push_back(cubic(p.x.back()));
    }
    double error = 0.0;
    for (double x = 0.0; x < 1.2; x += 1e-3)
      error = std::max(error, std::abs(p.curve(true).at(x).value - cubic(x)));
    const double order = before > 0.0 ? std::log2(before / error) : 3.0;
    fmt::print("{} pieces: {:.2g} off, order {:.2f}\n", pieces, error, order);
    EXPECT_GT(order, 2.7);
    before = error;
  }
  EXPECT_LT(before, 1e-5);
}

} // namespace
} // namespace plyform::monotone_curve_test
