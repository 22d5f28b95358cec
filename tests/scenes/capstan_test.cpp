// SPDX-License-Identifier: GPL-3.0-or-later
// A strip drawn round a fixed cylinder, against the capstan equation (Euler 1769, Eytelwein 1808):
// where all of it slides, the pull grows by T2 = T1 exp(mu theta) over the angle theta that it
// wraps, whatever the radius and the width.
//
// The strip lies on the cylinder from the start as a chain of straight pieces, each as long as its
// elements: tight, not strained. Its ends leave as tangents. One grip pulls, the other follows on
// a shorter way, which strains the strip; between them everything moves on, so that all of it
// slides. In a chain of pieces that turn by D at a node the pull grows by
//   (1 + mu tan(D/2)) / (1 - mu tan(D/2)) = exp(mu D (1 + O(D^2)))
// there: D = 0.1 changes the exponent by 0.1 %.
#include "support/stress_scenes.hpp"
#include "support/thread_checks.hpp"

namespace plyform::capstan_test {
namespace {

constexpr double cell = 5.0; // mm
constexpr int straight = 4;  // cells on either side of the arc

struct Wrap {
  int pieces;   ///< on the arc
  double angle; ///< rad
  /// mm, of the nodes
  double radius() const { return 0.5 * cell / std::sin(0.5 * angle / pieces); }
  double length() const { return cell * (pieces + 2 * straight); }
};

/// Where the strip's middle line is at X (mm) along it, in the plane y = 0: the cylinder about the
/// origin, the first straight part coming up along +z at x = -radius.
Vec3 wrapped(const Wrap& w, double X) {
  const double turn = w.angle / w.pieces, r = w.radius(), s = X / cell - straight;
  const double a = turn * std::clamp(std::round(s), 0.0, static_cast<double>(w.pieces));
  const double rest = X - cell * (straight + a / turn); // beyond the arc's ends
  return {-r * std::cos(a) + rest * std::sin(a), 0.0, r * std::sin(a) + rest * std::cos(a)};
}

Scene capstan(const Wrap& w, double mu) {
  const double half = 0.5 * w.length();
  Case data = stack_of({0.0}, rectangle(2.0 * half, 10.0, cell));
  Tool drum;
  drum.name = "drum";
  drum.shape = Cylinder{w.radius() - 0.5 * data.fabrics[0].thickness, 40.0};
  drum.rotation = Eigen::AngleAxisd(0.5 * std::numbers::pi, Vec3::UnitX()).toRotationMatrix();
  data.tools = {drum};
  set_friction(data, mu);
  const Vec3 out(std::sin(w.angle), 0.0, std::cos(w.angle));
  data.boundaries = {hold("behind", {-half, -5}, {-half, 5}, Vec3::UnitZ(), 7.0),
                     hold("ahead", {half, -5}, {half, 5}, out, 10.0)};
  data.solver.element = ElementKind::plain;
  data.solver.fibre_softening = 100.0;
  data.solver.duration = 0.07;
  data.solver.outputs = 50;
  Scene scene = make_scene(data);
  for (Vec3& x : scene.plies[0].x0) {
    const double y = x.y();
    x = wrapped(w, x.x() + half);
    x.y() = y;
  }
  scene.plies[0].x = scene.plies[0].x0;
  return scene;
}

/// Slides a strip round the drum and looks at the pulls from 10 % of the way on.
void expect_exponential(const Wrap& w, double mu) {
  const double wanted = std::exp(mu * w.angle);
  double least = 1e9, most = 0.0;
  RunHooks hooks;
  hooks.frame = [&](const Frame& f) {
    if (f.stroke_mm < 1.0) return; // of 7 mm; slack before
    const double ratio = -f.boundaries.at(1).force_N / f.boundaries.at(0).force_N;
    ASSERT_FALSE(std::isnan(ratio));
    least = std::min(least, ratio);
    most = std::max(most, ratio);
  };
  const EndedRun run = run_on_any_threads([&] { return capstan(w, mu); }, hooks);
  ASSERT_TRUE(ended(run.result.summary.status)) << run.result.summary.message;
  // inertia on the way, and the angle of a piece
  EXPECT_NEAR(least, wanted, 0.01 * wanted);
  EXPECT_NEAR(most, wanted, 0.01 * wanted);
  fmt::print("{:.0f} degrees, mu {}: pulls of {:.2f} and {:.2f} N at the end, {:+.4f} to {:+.4f} "
             "off {:.4f}; {} steps, {:.2f} s\n",
             w.angle * 180.0 / std::numbers::pi, mu, -run.result.last.boundaries[0].force_N,
             run.result.last.boundaries[1].force_N, least / wanted - 1.0, most / wanted - 1.0,
             wanted, run.result.summary.steps, run.result.summary.wall_time_s);
}

TEST(CapstanScene, PullGrowsByTheExponentialRoundFortyFiveDegrees) {
  expect_exponential({8, 0.25 * std::numbers::pi}, 0.3);
}

TEST(CapstanScene, PullGrowsByTheExponentialRoundNinetyDegrees) {
  expect_exponential({16, 0.5 * std::numbers::pi}, 0.3);
}

TEST(CapstanScene, PullGrowsByTheExponentialOfLittleFriction) {
  expect_exponential({16, 0.5 * std::numbers::pi}, 0.1);
}

TEST(CapstanScene, PullGrowsByTheExponentialRoundHalfATurn) {
  expect_exponential({32, std::numbers::pi}, 0.3);
}

} // namespace
} // namespace plyform::capstan_test
