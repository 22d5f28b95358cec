// SPDX-License-Identifier: GPL-3.0-or-later
// The bias-extension test of a stitched fabric both ways, at rest.
#include "support/static_bias.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace plyform::stitch_long_test {
namespace {

constexpr double pi = std::numbers::pi, length = 300.0, width = 100.0; // mm

/// Load (N) that this torque per area (N/mm, of the shear angle) adds to (40) where the middle is
/// sheared by gamma: the corners by half of it, the ends not.
template <class Torque>
double added_load(const Torque& torque, double gamma) {
  const double middle = length * width - 1.5 * width * width, halves = width * width;
  const double power = middle * torque(gamma) + 0.5 * halves * torque(0.5 * gamma);
  return power * std::sqrt(2.0) / ((length - width) * std::sin(0.25 * pi - 0.5 * gamma));
}

/// With the stitch along the pull, or across it.
std::vector<double> loads(const Stitch& stitch, bool along, double size,
                          const std::vector<double>& angles) {
  Fabric f = glass_weave();
  f.families[1].tension = f.families[0].tension;
  f.stitches = {stitch};
  f.stitches[0].angle = (along ? -0.25 : 0.25) * pi; // from yarns at 45 degrees to the pull
  return bias_loads(strip_mesh({MeshKind::crossed, size, 0.0, 0.0}, length, width), f, length,
                    width, ElementKind::automatic, angles);
}

/// Not below 0.35 rad with this pre-tension: its torque is six times that of the law of shear at
/// 0.2 rad, so that the ends, which (40) takes for unsheared, shear by themselves, and the
/// difference is 8 % less.
TEST(StitchLong, BiasBothWaysDiffersByTheStitch) {
  const std::vector<double> angles{0.35, 0.5, 0.65};
  for (const double taut_at : {0.0, -0.1})
    for (const double size : {width / 10.0, width / 20.0}) {
      const Stitch stitch = stitch_at(0.0, 3.0, taut_at);
      const std::vector<double> one = loads(stitch, true, size, angles),
                                other = loads(stitch, false, size, angles);
      const auto torque = [&](double gamma) {
        const double stretch = std::sqrt(1.0 + std::sin(gamma));
        return stitch.density * stitch.law.at(stretch - 1.0).value * std::cos(gamma) /
               (2.0 * stretch);
      };
      for (std::size_t i = 0; i < angles.size(); ++i) {
        const double wanted =
            added_load([&](double gamma) { return torque(gamma) + torque(-gamma); }, angles[i]);
        fmt::print("taut at {}, elements of {} mm, {} rad: {:.4f} N - {:.4f} N, {:.4f} N wanted: "
                   "{:+.2f} %\n",
                   taut_at, size, angles[i], one[i], other[i], wanted,
                   100.0 * ((one[i] - other[i]) / wanted - 1.0));
        EXPECT_NEAR(one[i] - other[i], wanted, 0.03 * wanted);
      }
    }
}

/// Stitches along the pull that break where the shear angle passes 0.28 rad: the middle first, the
/// corners, which have half the angle, from 0.56 rad of the middle on, band after band of them, as
/// what has broken shears more and lets go of the rest. Before the first break the tests differ by
/// the stitch, after the last by nothing.
TEST(StitchLong, BrokenStitchesLeaveNoDifference) {
  const std::vector<double> angles{0.24, 0.9};
  Stitch stitch = stitch_at(0.0, 3.0);
  stitch.law.breaking_force = stitch.law.at(std::sqrt(1.0 + std::sin(0.28)) - 1.0).value;
  for (const double size : {width / 10.0, width / 20.0}) {
    const std::vector<double> one = loads(stitch, true, size, angles),
                              other = loads(stitch, false, size, angles);
    const auto torque = [&](double gamma) {
      const double stretch = std::sqrt(1.0 + std::sin(gamma));
      return stitch.density * stitch.law.tension.stiffness * (stretch - 1.0) * std::cos(gamma) /
             (2.0 * stretch);
    };
    for (std::size_t i = 0; i < angles.size(); ++i) {
      const double whole = added_load(torque, angles[i]), wanted = i == 0 ? whole : 0.0;
      fmt::print("elements of {} mm, {} rad: {:.4f} N - {:.4f} N, {:.4f} N with whole stitches: "
                 "{:+.2f} % of that off\n",
                 size, angles[i], one[i], other[i], whole,
                 100.0 * (one[i] - other[i] - wanted) / whole);
      EXPECT_NEAR(one[i] - other[i], wanted, 0.03 * whole);
    }
  }
}

/// Across the pull a slack stitch does nothing at all.
TEST(StitchLong, SlackStitchesDoNothingToTheBiasTest) {
  const std::vector<double> angles{0.3, 0.6};
  const std::vector<double> with = loads(stitch_at(0.0, 3.0), false, width / 10.0, angles),
                            without = loads(stitch_at(0.0, 3.0, 9.0), false, width / 10.0, angles);
  for (std::size_t i = 0; i < angles.size(); ++i)
    EXPECT_NEAR(with[i], without[i], 0.01 * without[i]);
}

} // namespace
} // namespace plyform::stitch_long_test
