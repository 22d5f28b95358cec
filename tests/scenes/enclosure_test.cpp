// SPDX-License-Identifier: GPL-3.0-or-later
// What is not to be trusted of a vacuum between two membranes of rubber: borders that part, and
// single nodes that contact of two meshes dents.
#include "core/run/enclosures.hpp"
#include "core/run/run.hpp"
#include "support/scene_checks.hpp"

#include <gtest/gtest.h>

namespace plyform::enclosure_test {
namespace {

constexpr double side = 80.0, thickness = 1.0, vacuum = 0.09; // mm, mm, N/mm^2

BlankSpec square(double size, MeshKind mesh) {
  BlankSpec blank = rectangle(side, side, size);
  blank.mesh = mesh;
  return blank;
}

/// Clamped all round.
Case enclosed(const BlankSpec& lower, const BlankSpec& upper, bool same) {
  Case data = stack_of({0.0, 0.0}, lower);
  Fabric rubber;
  rubber.name = "rubber";
  rubber.thickness = thickness, rubber.surface_density = 1.1e-9;
  rubber.sheet = MooneyRivlinLaw{0.5 * 0.4 * thickness, 0.0};
  data.fabrics = {rubber};
  data.blanks = {lower, upper};
  for (std::size_t p = 0; p < 2; ++p) {
    data.plies[p].fabric = 0, data.plies[p].blank = same ? 0 : static_cast<int>(p);
    data.plies[p].z = thickness * static_cast<double>(p);
  }
  const double half = 0.5 * side;
  const Vec2 corners[] = {{-half, -half}, {half, -half}, {half, half}, {-half, half}};
  for (std::size_t i = 0; i < 4; ++i) {
    Grip grip;
    grip.place = {true, {corners[i], corners[(i + 1) % 4]}};
    data.boundaries.push_back({"side" + std::to_string(i), -1, grip});
  }
  data.loads = {{0, PlyFace::below, vacuum, {{0.5, vacuum}}},
                {1, PlyFace::above, vacuum, {{0.5, vacuum}}}};
  set_friction(data, 0.0);
  data.solver.duration = 0.03;
  data.solver.mass_damping = 200.0;
  data.solver.outputs = 1;
  return data;
}

bool dented(const RunResult& run) {
  for (const std::string& doubt : run.summary.doubts)
    if (doubt.find("give both the same blank") != std::string::npos) return true;
  return false;
}

/// mm, by which any node of a finished run has moved.
double largest_motion(const RunResult& run) {
  double most = 0.0;
  for (const PlyFrame& ply : run.last.plies)
    for (std::size_t n = 0; n < ply.x.size(); ++n)
      most = std::max(most, (ply.x[n] - ply.x0[n]).norm());
  return most;
}

const BlankSpec fine = square(5.0, MeshKind::alternating);
const BlankSpec others[] = {square(5.0, MeshKind::alternating), square(7.0, MeshKind::free),
                            square(8.0, MeshKind::alternating)};

TEST(Enclosure, SheetsThatTouchStayWhereTheyAreWhateverTheirMeshes) {
  for (const BlankSpec& other : others)
    for (const double step : {0.5, 0.25}) {
      Case data = enclosed(fine, other, false);
      data.solver.step_factor = step;
      const RunResult run = run_case(data, 1, {});
      EXPECT_EQ(run.summary.status, "done") << run.summary.message;
      EXPECT_LT(largest_motion(run), 1e-9);
    }
}

/// mm, by which a sheet has risen in the mean.
double height(const Frame& frame, std::size_t p) {
  const PlyFrame& ply = frame.plies[p];
  double volume = 0.0, area = 0.0;
  for (const auto& [a, b, c] : ply.triangles) {
    const Vec3 across = (ply.x[at(b)] - ply.x[at(a)]).cross(ply.x[at(c)] - ply.x[at(a)]);
    area += 0.5 * across.z();
    volume += across.z() / 6.0 * (ply.x[at(a)] + ply.x[at(b)] + ply.x[at(c)]).z();
  }
  return volume / area - ply.x0.front().z();
}

/// mm, by which the middle of a sheet has risen.
double rise(const RunResult& run, std::size_t p) {
  double most = 0.0;
  for (const Vec3& x : run.last.plies[p].x)
    most = std::max(most, x.z());
  return most - run.last.plies[p].x0.front().z();
}

/// A pressure below bulges both: contact bears the half of it that the upper one carries.
Case bulged(const BlankSpec& lower, const BlankSpec& upper) {
  Case data = enclosed(lower, upper, false);
  data.loads.push_back({0, PlyFace::below, 0.004, {}, 1});
  data.solver.duration = 0.06;
  data.solver.dwell = 1.0;
  return data;
}

/// One sheet as thick as both, without a vacuum.
Case as_one(const BlankSpec& blank) {
  Case data = bulged(blank, blank);
  data.plies.pop_back(), data.blanks.pop_back();
  data.fabrics[0].thickness = 2.0 * thickness, data.fabrics[0].surface_density *= 2.0;
  data.fabrics[0].sheet = MooneyRivlinLaw{0.5 * 0.4 * 2.0 * thickness, 0.0};
  data.loads.erase(data.loads.begin(), data.loads.begin() + 2);
  set_friction(data, 0.0);
  return data;
}

TEST(Enclosure, SheetsThatBulgeTogetherRiseAsOneOfBothThicknesses) {
  const RunResult pair = run_case(bulged(fine, fine), 1, {});
  const double expected = rise(run_case(as_one(fine), 1, {}), 0);
  ASSERT_GT(expected, 10.0);
  for (const std::size_t ply : {0, 1}) {
    fmt::print("{:.3f} mm, as one {:.3f} mm\n", rise(pair, ply), expected);
    EXPECT_NEAR(rise(pair, ply), expected, 0.02 * expected);
  }
}

TEST(Enclosure, SheetsThatBulgeTogetherLieAsHighAsThoseOfEitherMesh) {
  const auto of = [](const BlankSpec& lower, const BlankSpec& upper) {
    const RunResult run = run_case(bulged(lower, upper), 1, {});
    EXPECT_NE(run.summary.status, "stopped") << run.summary.message;
    EXPECT_LT(std::abs(run.last.energy.balance_error()), 1e-3);
    const double lower_height = height(run.last, 0), upper_height = height(run.last, 1);
    EXPECT_NEAR(upper_height, lower_height, 0.02 * lower_height);
    return lower_height;
  };
  const double alone = of(fine, fine);
  for (const BlankSpec& other : others) {
    const double own = of(other, other), mixed = of(fine, other);
    fmt::print("{:.3f} mm of {:.3f} and {:.3f} mm\n", mixed, alone, own);
    EXPECT_NEAR(mixed, 0.5 * (alone + own), 0.5 * std::abs(alone - own) + 0.02 * alone);
  }
}

// Pulled along the other one, a ply slides at mu times vacuum times area, until its rim has left.
TEST(Enclosure, FrictionFeelsTheVacuumThatContactBears) {
  constexpr double mu = 0.2, length = 60.0, width = 30.0; // -, mm, mm
  Case data = stack_of({0.0, 0.0}, rectangle(length, width, 7.5));
  data.blanks.push_back(rectangle(length, width, 5.0));
  data.plies[1].blank = 1;
  set_friction(data, mu);
  data.loads = {{0, PlyFace::below, vacuum, {{0.3, vacuum}}},
                {1, PlyFace::above, vacuum, {{0.3, vacuum}}}};
  const Vec2 low(-0.5 * length, -0.5 * width), high(0.5 * length, 0.5 * width);
  const auto edge = [&](std::string name, int ply, double x, double stroke) {
    Grip grip;
    grip.place = {true, {Vec2(x, low.y()), Vec2(x, high.y())}};
    grip.stroke = stroke, grip.programme = {{0.3, 0.0}, {1.0, stroke}};
    data.boundaries.push_back({std::move(name), ply, grip});
  };
  edge("pulled", 1, high.x(), 0.6), edge("front", 0, high.x(), 0.0), edge("back", 0, low.x(), 0.0);
  data.solver.duration = 0.05;
  data.solver.mass_damping = 200.0; // 1/s
  data.solver.outputs = 50;
  double most = 0.0; // N
  RunHooks hooks;
  hooks.frame = [&](const Frame& f) { most = std::max(most, f.boundaries.at(0).force_N); };
  const RunResult run = run_case(data, 1, hooks);
  EXPECT_NE(run.summary.status, "stopped") << run.summary.message;
  const double wanted = mu * vacuum * length * width;
  fmt::print("{:.3f} N of {:.3f} N\n", most, wanted);
  EXPECT_NEAR(most, wanted, 0.03 * wanted); // nodes at the rim leave before all slides
}

TEST(Enclosure, DentsOfTwoMeshesAreDoubted) {
  EXPECT_TRUE(dented(run_case(bulged(fine, others[2]), 1, {})));
  EXPECT_FALSE(dented(run_case(bulged(fine, others[0]), 1, {})));
}

/// What is said once `move` has moved the upper of two sheets.
template <class Move>
std::string doubts_when(const Move& move) {
  Scene s = make_scene(enclosed(fine, fine, true));
  for (Vec3& x : s.plies[1].x)
    move(x);
  const std::vector<std::string> doubts = doubts_of_enclosures(s);
  return doubts.empty() ? "" : doubts.front();
}

TEST(Enclosure, BordersThatPartAreDoubted) {
  EXPECT_EQ(doubts_when([](Vec3&) {}), "");
  EXPECT_EQ(doubts_when([](Vec3& x) { x.z() += 1e-3 * (1600.0 - x.x() * x.x()); }), ""); // bulged
  const auto parted = [](const std::string& doubt) {
    return doubt.find("their borders have parted") != std::string::npos;
  };
  EXPECT_TRUE(parted(doubts_when([](Vec3& x) { x.x() *= 0.9; })));
  EXPECT_TRUE(parted(doubts_when([](Vec3& x) { x.x() += 10.0; })));
  EXPECT_TRUE(parted(doubts_when([](Vec3& x) { x.z() += 0.2 * x.x(); })));
}

} // namespace
} // namespace plyform::enclosure_test
