// SPDX-License-Identifier: GPL-3.0-or-later
// What is said of plies with known fields, and which runs are doubtful.
#include "core/run/ply_plausibility.hpp"
#include "core/run/run.hpp"
#include "support/ply_sheets.hpp"
#include "support/stress_scenes.hpp"

#include <gtest/gtest.h>
#include <limits>

namespace plyform::ply_plausibility_test {
namespace {

using sheets::sheet;

/// Strains of both families by the place before forming.
void strain(PlyFrame& ply, const std::function<double(const Vec2&)>& warp,
            const std::function<double(const Vec2&)>& weft) {
  for (std::size_t t = 0; t < ply.triangles.size(); ++t) {
    ply.families[0].strain[t] = warp(sheets::centre(ply, t));
    ply.families[1].strain[t] = weft(sheets::centre(ply, t));
  }
}

TEST(PlyPlausibility, EitherFamilyPressesItsShareOfTheArea) {
  PlyFrame ply = sheet(20, 10, 10.0, 0.0, sheets::flat);
  strain(
      ply, [](const Vec2& p) { return p.x() < 0.0 ? -0.03 : 0.2; }, // the left half
      [](const Vec2& p) { return p.y() > 40.0 ? -0.06 : -0.001; }); // the upper tenth
  const PlyReport told = report_ply(ply, {}, {});
  ASSERT_TRUE(told.pressed);
  EXPECT_EQ(told.pressed->largest, 0.06);
  EXPECT_NEAR(told.pressed->share_above_2, 0.55, 1e-12);
  EXPECT_NEAR(told.pressed->share_above_5, 0.1, 1e-12);
  // warp: 3 % of the 100 mm of the left half; weft: 6 % of 10 mm and 0.1 % of 90 mm
  EXPECT_NEAR(told.pressed->excess_mm, 3.0, 1e-9);
  EXPECT_LT(told.pressed->excess_at.x(), 0.0);
  EXPECT_FALSE(told.beyond_locking_share);
}

/// A family shortens by its crimp as the other one is straightened, and only by what is more it is
/// pressed: half waves of 5 mm, 3 % crimp each, so that all of the height, twice
/// sqrt(5.15^2 - 5^2) mm, leaves sqrt(5.15^2 - 4 (5.15^2 - 5^2)) mm of 5 mm.
TEST(PlyPlausibility, ShorteningByCrimpIsNoPressing) {
  const double all = 1.0 - std::sqrt(5.15 * 5.15 - 4.0 * (5.15 * 5.15 - 25.0)) / 5.0;
  EXPECT_NEAR(all, 0.096, 5e-4);
  PlyNature crimped;
  crimped.crossings = {{0, 1, {}, CrimpedCell{{5.0, 5.0}, {0.03, 0.03}}}};
  const auto told = [&](double warp, double weft) {
    PlyFrame ply = sheet(4, 4, 10.0, 0.0, sheets::flat);
    const auto is = [](double value) { return [value](const Vec2&) { return value; }; };
    strain(ply, is(warp), is(weft));
    return report_ply(ply, crimped, {}).pressed->largest;
  };
  EXPECT_EQ(told(0.03, -0.09), 0.0);
  EXPECT_NEAR(told(0.04, -0.15), 0.15 - all, 1e-12);
  EXPECT_NEAR(told(-0.15, 0.04), 0.15 - all, 1e-12);
  EXPECT_NEAR(told(0.0, -0.06), 0.06, 1e-12); // nothing makes room for more crimp
  EXPECT_NEAR(told(-0.06, -0.02), 0.06, 1e-12);
}

/// A pressed spot in a sheet whose yarns run at 30 and 100 degrees across its mesh: lines integrate
/// over the triangles as they are, so that only the steps of the field count.
TEST(PlyPlausibility, ExcessLengthIsTheIntegralAlongTheYarn) {
  PlyFrame ply = sheet(100, 100, 2.0, 0.0, sheets::flat);
  ply.families[0].angle_deg = 30.0;
  ply.families[1].angle_deg = 100.0;
  const Vec2 middle(20.0, 10.0);
  const auto spot = [&](const Vec2& p) {
    return -0.1 * std::max(0.0, 1.0 - (p - middle).norm() / 30.0); // a cone
  };
  strain(
      ply, [](const Vec2&) { return 0.0; }, spot);
  const PlyReport told = report_ply(ply, {}, {});
  EXPECT_NEAR(told.pressed->excess_mm, 0.1 * 30.0, 0.03); // through the tip: half of 0.1 x 60 mm
  EXPECT_LT((told.pressed->excess_at.head<2>() - middle).norm(), 3.0);
}

/// Only families that have the column are told, with the area beyond their own limits.
TEST(PlyPlausibility, OpeningsAreToldByFamilyWithTheirLimits) {
  PlyFrame ply = sheet(20, 10, 10.0, 0.0, sheets::flat);
  EXPECT_TRUE(report_ply(ply, {.opening_limits = {0.1, 0.1}}, {}).openings.empty());
  std::vector<double>& weft = ply.families[1].opening;
  for (std::size_t t = 0; t < ply.triangles.size(); ++t) {
    const Vec2 p = sheets::centre(ply, t);
    weft.push_back(p.x() > 50.0 ? 0.12 : p.y() > 40.0 ? 0.3 : -0.02); // a quarter; a tenth
  }
  const PlyReport told = report_ply(ply, {.opening_limits = {std::nullopt, 0.1}}, {});
  ASSERT_EQ(told.openings.size(), 1u);
  const Opening& opening = told.openings[0];
  EXPECT_EQ(opening.family, ply.families[1].name);
  EXPECT_EQ(opening.largest, 0.3);
  EXPECT_GT(opening.at.y(), 40.0);
  EXPECT_EQ(opening.limit.value(), 0.1);
  EXPECT_NEAR(opening.beyond_share, 0.25 + 0.75 * 0.1, 1e-12);
  EXPECT_NEAR(opening.beyond_mm2, opening.beyond_share * 200.0 * 100.0, 1e-8);
  EXPECT_FALSE(report_ply(ply, {}, {}).openings[0].limit);
}

TEST(PlyPlausibility, NothingPressedIsNothing) {
  const PlyReport told = report_ply(sheet(5, 5, 10.0, 15.0, sheets::flat), {}, {});
  EXPECT_EQ(told.pressed->largest, 0.0);
  EXPECT_EQ(told.pressed->share_above_2, 0.0);
  EXPECT_EQ(told.pressed->excess_mm, 0.0);
  EXPECT_FALSE(report_ply(sheet(5, 5, 10.0, 0.0, sheets::flat), {.has_yarns = false}, {}).pressed);
}

TEST(PlyPlausibility, NumbersThatAreNotFiniteAreNotLost) {
  PlyFrame ply = sheet(5, 5, 10.0, 0.0, sheets::flat);
  ply.families[1].strain[7] = std::numeric_limits<double>::quiet_NaN();
  const PlyReport told = report_ply(ply, {}, {});
  EXPECT_TRUE(std::isnan(told.pressed->largest));
  EXPECT_TRUE(std::isnan(told.pressed->share_above_5));
}

TEST(PlyPlausibility, ShareBeyondTheLockingAngle) {
  PlyFrame ply = sheet(10, 10, 10.0, 0.0, sheets::flat);
  for (std::size_t t = 0; t < ply.triangles.size(); ++t)
    ply.shear_deg[t] = sheets::centre(ply, t).x() < -20.0 ? -50.0 : 39.0;
  const PlyReport told = report_ply(ply, {.locking_angle_deg = 40.0}, {});
  EXPECT_NEAR(told.beyond_locking_share.value(), 0.3, 1e-12);
  EXPECT_EQ(told.locking_angle_deg.value(), 40.0);
}

/// A strip whose ends are pushed together by `stroke` of its 100 mm.
Case pushed_together(double stroke) {
  Case data = stack_of({0.0}, rectangle(100.0, 20.0, 5.0));
  data.tools.clear();
  data.boundaries = {hold("push", {50.0, -10.0}, {50.0, 10.0}, -Vec3::UnitX(), stroke),
                     hold("stop", {-50.0, -10.0}, {-50.0, 10.0}, Vec3::UnitX(), 0.0)};
  data.gravity = Vec3::Zero();
  data.solver.fibre_softening = 100.0;
  data.solver.duration = 0.02;
  return data;
}

TEST(Doubtful, IsARunThatPressesWovenYarnsByMoreThanFivePercent) {
  const RunResult pressed = run_case(pushed_together(12.0), 1, {});
  const Summary& s = pressed.summary;
  EXPECT_EQ(s.status, "doubtful") << s.message;
  ASSERT_EQ(s.plies.size(), 1u);
  EXPECT_GT(s.plies[0].pressed->share_above_5, doubtful_pressed_share);
  EXPECT_NEAR(s.plies[0].pressed->excess_mm, 12.0, 0.5);
  EXPECT_NE(s.message.find("do not trust"), std::string::npos) << s.message;
  EXPECT_NE(s.message.find("compression_stiffness"), std::string::npos) << s.message;
  ASSERT_FALSE(s.doubts.empty());
  EXPECT_EQ(s.doubts.front(), s.work.missing.front());
  EXPECT_EQ(s.doubts.size() + advice_of(s).size(), s.work.missing.size());
  EXPECT_EQ(s.message.find(s.work.missing.front()), 0u)
      << s.message; // limp and fast, it also flies
}

/// With yarns that bear it the strip gives way sideways in its plane instead.
TEST(Doubtful, IsNotARunThatPressesThemByLess) {
  Case data = pushed_together(2.0);
  data.solver.duration = 0.1; // slow enough for its energy balance
  data.fabrics[0].families[0].tension.compression =
      data.fabrics[0].families[1].tension.compression = 100.0; // N
  const RunResult run = run_case(data, 1, {});
  EXPECT_EQ(run.summary.status, "done") << run.summary.message;
  EXPECT_TRUE(run.summary.doubts.empty());
  EXPECT_EQ(advice_of(run.summary), run.summary.work.missing);
  EXPECT_LT(run.summary.plies.at(0).pressed->excess_mm, 1.0);
  EXPECT_EQ(run.summary.plies.at(0).pressed->share_above_5, 0.0);
}

TEST(Doubtful, IsNotASheetWithoutYarns) {
  Case data = pushed_together(12.0);
  Fabric& film = data.fabrics[0];
  film.families.clear();
  film.crossings.clear();
  film.sheet = IsotropicLaw{10.0, 0.3}; // N/mm
  const RunResult run = run_case(data, 1, {});
  EXPECT_EQ(run.summary.status, "done") << run.summary.message;
  EXPECT_FALSE(run.summary.plies.at(0).pressed);
}

} // namespace
} // namespace plyform::ply_plausibility_test
