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

/// Strips side by side round one drum, each with its own coefficient of friction on it.
Scene capstan(const Wrap& w, const std::vector<double>& mu) {
  constexpr double apart = 20.0; // mm
  const double half = 0.5 * w.length();
  const std::size_t strips = mu.size();
  const auto middle = [&](std::size_t p) {
    return apart * (static_cast<double>(p) - 0.5 * static_cast<double>(strips - 1));
  };
  Case data = stack_of(std::vector<double>(strips, 0.0), rectangle(2.0 * half, 10.0, cell));
  Tool drum;
  drum.name = "drum";
  drum.shape = Cylinder{w.radius() - 0.5 * data.fabrics[0].thickness,
                        20.0 + apart * static_cast<double>(strips)};
  drum.rotation = Eigen::AngleAxisd(0.5 * std::numbers::pi, Vec3::UnitX()).toRotationMatrix();
  data.tools = {drum};
  set_friction(data, 0.0);
  const Vec3 out(std::sin(w.angle), 0.0, std::cos(w.angle));
  for (std::size_t p = 0; p < strips; ++p) {
    data.friction.mu[p * (strips + 1) + strips] = data.friction.mu[strips * (strips + 1) + p] =
        mu[p];
    for (Boundary end : {hold("behind", {-half, -5}, {-half, 5}, Vec3::UnitZ(), 7.0),
                         hold("ahead", {half, -5}, {half, 5}, out, 10.0)}) {
      end.name += std::to_string(p);
      end.ply = static_cast<int>(p);
      data.boundaries.push_back(end);
    }
  }
  data.solver.element = ElementKind::plain;
  data.solver.fibre_softening = 100.0;
  data.solver.duration = 0.07;
  data.solver.outputs = 50;
  Scene scene = make_scene(data);
  for (std::size_t p = 0; p < strips; ++p) {
    for (Vec3& x : scene.plies[p].x0) {
      const double y = x.y() + middle(p);
      x = wrapped(w, x.x() + half);
      x.y() = y;
    }
    scene.plies[p].x = scene.plies[p].x0;
  }
  return scene;
}

/// Slides strips round the drum and looks at the pulls from 10 % of the way on.
void expect_exponential(const Wrap& w, const std::vector<double>& mu) {
  std::vector<double> least(mu.size(), 1e9), most(mu.size(), 0.0);
  RunHooks hooks;
  hooks.frame = [&](const Frame& f) {
    if (f.stroke_mm < 1.0) return; // of 7 mm; slack before
    for (std::size_t p = 0; p < mu.size(); ++p) {
      const double ratio = -f.boundaries.at(2 * p + 1).force_N / f.boundaries.at(2 * p).force_N;
      ASSERT_FALSE(std::isnan(ratio));
      least[p] = std::min(least[p], ratio);
      most[p] = std::max(most[p], ratio);
    }
  };
  const EndedRun run = run_on_any_threads([&] { return capstan(w, mu); }, hooks);
  ASSERT_TRUE(ended(run.result.summary.status)) << run.result.summary.message;
  for (std::size_t p = 0; p < mu.size(); ++p) { // inertia on the way, and the angle of a piece
    const double wanted = std::exp(mu[p] * w.angle);
    EXPECT_NEAR(least[p], wanted, 0.01 * wanted);
    EXPECT_NEAR(most[p], wanted, 0.01 * wanted);
    const std::vector<BoundaryFrame>& pulls = run.result.last.boundaries;
    fmt::print("{:.0f} degrees, mu {}: pulls of {:.2f} and {:.2f} N at the end, {:+.4f} to {:+.4f} "
               "off {:.4f}; {} steps, {:.2f} s\n",
               w.angle * 180.0 / std::numbers::pi, mu[p], -pulls[2 * p].force_N,
               pulls[2 * p + 1].force_N, least[p] / wanted - 1.0, most[p] / wanted - 1.0, wanted,
               run.result.summary.steps, run.result.summary.wall_time_s);
  }
}

TEST(CapstanScene, PullGrowsByTheExponentialRoundFortyFiveDegrees) {
  expect_exponential({8, 0.25 * std::numbers::pi}, {0.3});
}

TEST(CapstanScene, PullGrowsByTheExponentialRoundNinetyDegrees) {
  expect_exponential({16, 0.5 * std::numbers::pi}, {0.3});
}

TEST(CapstanScene, PullGrowsByTheExponentialOfLittleFriction) {
  expect_exponential({16, 0.5 * std::numbers::pi}, {0.1});
}

TEST(CapstanScene, PullGrowsByTheExponentialRoundHalfATurn) {
  expect_exponential({32, std::numbers::pi}, {0.3});
}

TEST(CapstanScene, EachStripHasTheExponentialOfItsOwnPair) {
  expect_exponential({8, 0.5 * std::numbers::pi}, {0.1, 0.2, 0.4});
}

} // namespace
} // namespace plyform::capstan_test
