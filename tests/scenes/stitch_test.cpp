// SPDX-License-Identifier: GPL-3.0-or-later
// Stitches in whole scenes: frames drawn out along both diagonals, and a hemisphere whose stitches
// break as it is formed.
#include "core/run/output_state.hpp"
#include "core/run/run.hpp"
#include "support/kill_checks.hpp"
#include "support/picture_frames.hpp"
#include "support/scene_checks.hpp"
#include "support/thread_checks.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace plyform::stitch_scene_test {
namespace {

constexpr double pi = std::numbers::pi, side = frame_side; // mm

/// A weave with a stitch along the diagonal of warp and weft.
Fabric stitched_weave(const Stitch& stitch) {
  Fabric f = glass_weave();
  f.stitches = {stitch};
  return f;
}

/// N/mm, the torque per area of that stitch while it is whole.
double torque_of(const Stitch& s, double gamma) {
  const double length = std::sqrt(1.0 + std::sin(gamma));
  return s.density * s.law.at(length - 1.0).value * std::cos(gamma) / (2.0 * length);
}

struct FramePoint {
  double gamma, torque;  ///< rad, N/mm: torque per area
  double broken, stored; ///< -, N mm
  Energies energy;
};

/// A frame drawn out along the diagonal of warp and weft, or along the other.
std::vector<FramePoint> frame_test(const Fabric& fabric, bool other, double most = 50.0) {
  Case data = stack_of({0.0}, rectangle(side, side, 25.0));
  data.fabrics = {fabric};
  data.boundaries = {square_frame(side, frame_stroke(most * pi / 180.0))};
  auto& hinges = data.boundaries[0].as<HingedFrame>().hinges;
  if (other) std::rotate(hinges.begin(), hinges.begin() + 1, hinges.end());
  set_friction(data, 0.0);
  data.solver.fibre_softening = 10000.0; // large steps; even so the yarns hardly stretch
  data.solver.duration = 40.0;           // s: no inertia
  std::vector<FramePoint> points;
  RunHooks hooks;
  hooks.frame = [&](const Frame& frame) {
    const double gamma = frame_angle_at(frame.boundaries.at(0).stroke_mm);
    const PlyFrame& ply = frame.plies[0];
    points.push_back({gamma, frame.boundaries[0].force_N * std::sin(0.25 * pi - 0.5 * gamma) / side,
                      ply.stitches.empty() ? 0.0 : ply.stitches[0].broken[0], frame.energy.stitch,
                      frame.energy});
    EXPECT_NEAR(ply.shear_deg[0], (other ? -1.0 : 1.0) * gamma * 180.0 / pi, 0.01);
  };
  const RunResult run = run_case(data, 1, hooks);
  EXPECT_TRUE(ended(run.summary.status)) << run.summary.message;
  EXPECT_LT(std::abs(run.last.energy.balance_error()), 0.01);
  return points;
}

/// Frames both ways differ by the term of the stitch and by nothing else.
TEST(StitchScene, FramesBothWaysDifferByTheStitch) {
  for (const double taut_at : {0.0, 0.08, -0.1}) { // taut, slack, pulling
    const Stitch stitch = stitch_at(0.25 * pi, 3.0, taut_at);
    const std::vector<FramePoint> one = frame_test(stitched_weave(stitch), false),
                                  other = frame_test(stitched_weave(stitch), true);
    ASSERT_EQ(one.size(), other.size());
    double most = 0.0;
    int judged = 0, slack = 0;
    for (std::size_t i = 0; i < one.size(); ++i) {
      const double gamma = one[i].gamma;
      if (gamma < 0.05) continue; // it gathers way
      const double difference = one[i].torque - other[i].torque,
                   wanted = torque_of(stitch, gamma) + torque_of(stitch, -gamma);
      if (wanted == 0.0) {
        ++slack;
        EXPECT_LE(std::abs(difference), 1e-3 * one[i].torque) << gamma;
        continue;
      }
      if (wanted < 0.05 * one[i].torque) continue; // just taut
      ++judged;
      EXPECT_NEAR(difference, wanted, 0.01 * wanted) << gamma << ' ' << taut_at;
      most = std::max(most, std::abs(difference / wanted - 1.0));
    }
    EXPECT_GE(judged, 5);
    EXPECT_EQ(slack > 0, taut_at > 0.0);
    fmt::print("taut at {}: the difference is off by {:.2g} %\n", taut_at, 100.0 * most);
  }
}

/// rad, at which the torques of a free ply's crossings and of its stitch balance: by bisection.
double static_angle(const Fabric& fabric, const Stitch& stitch) {
  double low = -0.5, high = 0.0;
  for (int i = 0; i < 60; ++i) {
    const double g = 0.5 * (low + high);
    const double torque =
        cells_per_area(fabric, fabric.crossings[0]) * fabric.crossings[0].shear.at(g).value +
        torque_of(stitch, g);
    (torque > 0.0 ? high : low) = g;
  }
  return 0.5 * (low + high);
}

/// Pre-tension comes up slowly enough that a free ply comes to where statics has it, and stays.
TEST(StitchScene, PretensionShearsAFreePlyToItsStaticAngle) {
  const Stitch stitch = stitch_at(0.25 * pi, 3.0, -0.02);
  Fabric fabric = stitched_weave(stitch);
  for (YarnFamily& family : fabric.families)
    family.tension.compression = family.tension.stiffness; // it shears, and yarns keep their length
  const double wanted = static_angle(fabric, stitch) * 180.0 / pi;
  ASSERT_LT(wanted, -0.5);
  for (const double element_size : {10.0, 15.0})
    for (const double step_factor : {0.5, 0.25}) {
      Case data = stack_of({0.0}, rectangle(60.0, 60.0, element_size));
      data.fabrics = {fabric};
      data.solver.fibre_softening = 100.0;
      data.solver.duration = 0.4; // s: its first tenth is several swings long
      data.solver.step_factor = step_factor;
      data.solver.outputs = 20;
      double furthest = 0.0;
      RunHooks hooks;
      hooks.frame = [&](const Frame& frame) {
        for (const double angle : frame.plies[0].shear_deg)
          furthest = std::min(furthest, angle);
      };
      const RunResult run = run_case(data, 1, hooks);
      EXPECT_TRUE(ended(run.summary.status)) << run.summary.message;
      EXPECT_LT(std::abs(run.last.energy.balance_error()), 1e-3);
      for (const double angle : run.last.plies[0].shear_deg)
        EXPECT_NEAR(angle, wanted, -0.01 * wanted) << element_size << ' ' << step_factor;
      EXPECT_GT(furthest, 1.05 * wanted) << element_size << ' ' << step_factor; // hardly swings
    }
}

/// Before they break as whole ones, afterwards as none; what they had stored is lost.
TEST(StitchScene, FrameLosesItsStitchesWhereTheyBreak) {
  Stitch stitch = stitch_at(0.25 * pi, 3.0);
  const std::vector<FramePoint> whole = frame_test(stitched_weave(stitch), false),
                                none = frame_test(glass_weave(), false);
  const double breaks = 0.5; // rad
  stitch.law.breaking_force = stitch.law.at(std::sqrt(1.0 + std::sin(breaks)) - 1.0).value;
  const std::vector<FramePoint> breaking = frame_test(stitched_weave(stitch), false);
  int before = 0, after = 0;
  for (std::size_t i = 0; i < breaking.size(); ++i) {
    const FramePoint& p = breaking[i];
    const bool gone = p.gamma > breaks;
    EXPECT_EQ(p.broken, gone ? 1.0 : 0.0) << p.gamma;
    EXPECT_EQ(p.stored > 0.0, !gone && p.gamma > 0.0) << p.gamma;
    if (p.gamma < 0.05 || std::abs(p.gamma - breaks) < 0.05) continue; // it swings
    const FramePoint& as = gone ? none[i] : whole[i];
    ++(gone ? after : before);
    EXPECT_NEAR(p.torque, as.torque, 0.01 * as.torque) << p.gamma;
  }
  EXPECT_GE(before, 3);
  EXPECT_GE(after, 3);
  const Energies& end = breaking.back().energy;
  const double stored = // just before they broke
      side * side * stitch.density * stitch.law.at(std::sqrt(1.0 + std::sin(breaks)) - 1.0).energy;
  EXPECT_NEAR(end.stitch_breaking, stored, 0.01 * stored);
  EXPECT_GT(end.stitch_breaking, 0.2 * end.largest());
  EXPECT_LT(std::abs(end.balance_error()), 0.01);
}

Case breaking_hemisphere() {
  Case data = coarse_hemisphere({0.0, 0.0});
  Fabric f = biaxial();
  f.stitches = {stitch_at(0.0, 20.0, -0.01)};
  f.stitches[0].law.breaking_force = 0.4;
  Fabric zigzag = biaxial();
  zigzag.stitches = {stitch_at(0.4, 20.0, 0.01), stitch_at(-0.4, 20.0, 0.01)};
  zigzag.stitches[1].name = "stitch_2";
  for (Stitch& leg : zigzag.stitches)
    leg.law.tension.strain = {0.0, 0.05, 0.2}, leg.law.tension.tension = {0.0, 0.5, 4.0},
    leg.law.breaking_force = 0.05;
  data.fabrics = {f, zigzag};
  data.plies[1].fabric = 1;
  data.tools[0].stroke = 40.0;
  data.solver.duration = 0.03;
  return data;
}

/// Energy that stitches store and lose is in the balance, bits are the same on any number of
/// threads, and a run that is killed while they break ends as one that is not.
TEST(StitchScene, BreaksWhileItForms) {
  const Case data = breaking_hemisphere();
  std::vector<Frame> frames;
  RunHooks hooks;
  hooks.frame = [&](const Frame& frame) { frames.push_back(frame); };
  const RunResult one = run_case(data, 1, hooks);
  ASSERT_TRUE(ended(one.summary.status)) << one.summary.message;
  const Energies& e = one.last.energy;
  EXPECT_LT(std::abs(e.balance_error()), 0.01);
  EXPECT_GT(e.stitch_breaking, 0.002 * e.largest());
  EXPECT_GT(frames.front().energy.stitch, 0.0); // they pull from the start
  EXPECT_GT(frames.front().energy.external, 0.0);
  for (const PlyFrame& ply : one.last.plies)
    for (const StitchFrame& stitch : ply.stitches) {
      double broken = 0.0;
      for (std::size_t t = 0; t < ply.triangles.size(); ++t) {
        broken += stitch.broken[t];
        EXPECT_TRUE(stitch.broken[t] == 0.0 || stitch.tension[t] == 0.0);
      }
      fmt::print("{} of {}: strain up to {:.3f}, broken in {} of {} triangles\n", stitch.name,
                 ply.name, *std::max_element(stitch.strain.begin(), stitch.strain.end()), broken,
                 ply.triangles.size());
      EXPECT_GT(broken, 0.02 * static_cast<double>(ply.triangles.size())) << stitch.name;
      EXPECT_LT(broken, 0.98 * static_cast<double>(ply.triangles.size())) << stitch.name;
    }
  for (std::size_t i = 1; i < frames.size(); ++i) // once broken, always
    for (std::size_t t = 0; t < frames[i].plies[0].triangles.size(); ++t)
      EXPECT_GE(frames[i].plies[0].stitches[0].broken[t],
                frames[i - 1].plies[0].stitches[0].broken[t]);
  expect_same_bits(run_case(data, 2, {}), one);
  expect_the_same_after_kills(data, 3);
}

/// A ply of yarns at +-45 degrees over a hemisphere, with or without stitches along one axis.
PlyFrame over_hemisphere(const std::vector<Stitch>& stitches) {
  Case data = coarse_hemisphere({0.0});
  data.fabrics = {biaxial()};
  data.fabrics[0].stitches = stitches;
  data.tools[0].stroke = 60.0;
  const RunResult run = run_case(data, 2, {});
  EXPECT_TRUE(ended(run.summary.status)) << run.summary.message;
  return run.last.plies.at(0);
}

/// deg, mean magnitude of shear in the two sectors about x, and about y.
std::pair<double, double> shear_about_axes(const PlyFrame& ply) {
  const std::vector<double> areas = areas_before(ply);
  Vec2 sum = Vec2::Zero(), area = Vec2::Zero();
  for (std::size_t t = 0; t < ply.triangles.size(); ++t) {
    Vec3 centre = Vec3::Zero();
    for (const std::int32_t n : ply.triangles[t])
      centre += ply.x0[at(n)] / 3.0;
    const double nearer = std::abs(centre.x()) - std::abs(centre.y());
    if (std::abs(nearer) < 1e-6) continue; // on the border of two sectors
    const int axis = nearer > 0.0 ? 0 : 1;
    sum[axis] += areas[t] * std::abs(ply.shear_deg[t]), area[axis] += areas[t];
  }
  return {sum.x() / area.x(), sum.y() / area.y()};
}

/// mm, rms over all nodes of how far the mirror image of `a` in the plane x = y is from b.
double mirrored_off(const PlyFrame& a, const PlyFrame& b) {
  double sum = 0.0;
  for (std::size_t n = 0; n < a.x0.size(); ++n) {
    const Vec3 image(a.x0[n].y(), a.x0[n].x(), 0.0);
    const auto nearest =
        std::min_element(b.x0.begin(), b.x0.end(), [&](const Vec3& p, const Vec3& q) {
          return (p - image).head<2>().squaredNorm() < (q - image).head<2>().squaredNorm();
        });
    const Vec3& found = b.x[static_cast<std::size_t>(nearest - b.x0.begin())];
    sum += (Vec3(a.x[n].y(), a.x[n].x(), a.x[n].z()) - found).squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(a.x0.size()));
}

/// Stitches along x are stretched where the ply is drawn in along x, and slack where it is along y:
/// it shears less there, and more here. Those along y give the mirror image.
TEST(StitchScene, SectorsOfAHemisphereShearAsTheStitchSays) {
  const PlyFrame none = over_hemisphere({}), along_x = over_hemisphere({stitch_at(0.0, 10.0)}),
                 along_y = over_hemisphere({stitch_at(0.5 * pi, 10.0)});
  const auto [x, y] = shear_about_axes(none);
  EXPECT_NEAR(x, y, 0.2);
  const auto [stiff, soft] = shear_about_axes(along_x);
  EXPECT_LT(stiff, 0.7 * x);
  EXPECT_GT(soft, 1.04 * y);
  const auto [mirrored_soft, mirrored_stiff] = shear_about_axes(along_y);
  EXPECT_NEAR(mirrored_stiff, stiff, 0.2);
  EXPECT_NEAR(mirrored_soft, soft, 0.2);
  EXPECT_LT(mirrored_off(along_x, along_y), 0.5);
  fmt::print("shear about x and y: {:.2f} and {:.2f} deg without, {:.2f} and {:.2f} with stitches "
             "along x, {:.2f} and {:.2f} along y; mirror images {:.3f} mm off, without {:.3f}\n",
             x, y, stiff, soft, mirrored_soft, mirrored_stiff, mirrored_off(along_x, along_y),
             mirrored_off(none, none));
}

} // namespace
} // namespace plyform::stitch_scene_test
