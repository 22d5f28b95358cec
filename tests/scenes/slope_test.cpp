// SPDX-License-Identifier: GPL-3.0-or-later
// A ply on an inclined plane, against Coulomb's law for a block on a slope (any textbook of
// statics): with friction mu on a slope of angle t it stays where it is while tan t < mu, and else
// slides down with a = g (sin t - mu cos t).
//
// The ply is limp, but nothing bends or shears it: weight and friction of each node are the same
// share of its mass. Yarns at an angle to the way down, so that none lies along it.
#include "support/scene_checks.hpp"
#include "support/thread_checks.hpp"

#include <fmt/format.h>

namespace plyform::slope_test {
namespace {

constexpr double g = 9810.0; // mm/s^2
constexpr double degrees = std::numbers::pi / 180.0;
const Vec3 downhill(std::cos(0.3), std::sin(0.3), 0.0); // in the plane z = 0

/// A square of four cells on the plane z = 0, gravity tilted by `angle` from the vertical.
Case on_slope(double angle, double mu) {
  Case data = stack_of({0.0}, rectangle(80.0, 80.0, 40.0));
  Tool slope;
  slope.name = "slope";
  slope.shape = Plane{};
  data.tools = {slope};
  set_friction(data, mu);
  data.gravity = g * (std::sin(angle) * downhill - std::cos(angle) * Vec3::UnitZ());
  data.solver.fibre_softening = 1000.0; // a second in some 5000 steps
  data.contact.stiffness = 0.5;         // stiff: sinks in by 1e-4 mm for all that
  data.solver.duration = 1.2;           // s
  data.solver.outputs = 24;
  data.contact.skin = 20.0; // mm: the plane is always in reach
  return data;
}

/// The same with the plane tilted and gravity along -z.
Scene turned_scene(Case data) {
  const Eigen::Quaterniond turn =
      Eigen::Quaterniond::FromTwoVectors(data.gravity.normalized(), -Vec3::UnitZ());
  data.gravity = turn * data.gravity;
  data.tools[0].rotation = turn.toRotationMatrix();
  Scene scene = make_scene(data);
  for (Vec3& x : scene.plies[0].x)
    x = turn * x;
  scene.plies[0].x0 = scene.plies[0].x;
  return scene;
}

/// Outputs of a run that has to be done.
std::vector<Frame> frames_of(const Case& data, bool turned) {
  std::vector<Frame> frames;
  RunHooks hooks;
  hooks.frame = [&](const Frame& f) { frames.push_back(f); };
  const EndedRun run =
      run_on_any_threads([&] { return turned ? turned_scene(data) : make_scene(data); }, hooks);
  EXPECT_TRUE(ended(run.result.summary.status)) << run.result.summary.message;
  return frames;
}

Vec3 centre(const Frame& frame) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& x : frame.plies[0].x)
    sum += x;
  return sum / static_cast<double>(frame.plies[0].x.size());
}

TEST(SlopeScene, SticksBelowTheAngleOfFrictionWithoutCreep) {
  for (const double mu : {0.1, 0.6})
    for (const bool turned : {false, true}) {
      const double share = turned ? 0.95 : 0.5; // of the angle of friction's tangent
      const std::vector<Frame> frames = frames_of(on_slope(std::atan(share * mu), mu), turned);
      ASSERT_EQ(frames.size(), 25u);
      double creep = 0.0; // mm, since 0.2 s, when it has settled; no damping along the plane hides
                          // it, the ply swings on by what friction's springs give, 1e-4 mm
      for (std::size_t i = 5; i < frames.size(); ++i)
        for (std::size_t n = 0; n < frames[i].plies[0].x.size(); ++n) {
          const double way = (frames[i].plies[0].x[n] - frames[4].plies[0].x[n]).norm();
          if (!(way <= creep) && !std::isnan(creep)) creep = way; // NaN stays
        }
      EXPECT_LT(creep, 1e-3);
      fmt::print("mu {}, {} of its slope: {:.1e} mm in {:.2f} s\n", mu, share, creep,
                 frames[24].time - frames[4].time);
    }
}

TEST(SlopeScene, SlidesAboveItWithWhatFrictionLeavesOfGravity) {
  for (const double mu : {0.0, 0.1, 0.6})
    for (const bool turned : {false, true}) {
      const double angle = std::atan((turned ? 1.1 : 2.0) * std::max(mu, 0.1));
      Case data = on_slope(angle, mu);
      data.solver.duration = 0.3; // s: slides by 4 mm at least
      const std::vector<Frame> frames = frames_of(data, turned);
      ASSERT_EQ(frames.size(), 25u);
      const auto speed = [&](std::size_t i, std::size_t j) { // mm/s
        return (centre(frames[j]) - centre(frames[i])).norm() / (frames[j].time - frames[i].time);
      };
      const double found =
          (speed(16, 24) - speed(8, 16)) / (0.5 * (frames[24].time - frames[8].time));
      const double wanted = g * (std::sin(angle) - mu * std::cos(angle));
      // exact for even acceleration, even friction on even weight: rounding only
      EXPECT_NEAR(found, wanted, 1e-6 * wanted);
      fmt::print("mu {}, {:.2f} degrees: {:.2f} mm/s^2, {:+.1e} off\n", mu, angle / degrees, found,
                 found / wanted - 1.0);
    }
}

} // namespace
} // namespace plyform::slope_test
