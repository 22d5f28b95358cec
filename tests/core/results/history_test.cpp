// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers of each state of a run, against a motion that is known.
#include "core/results/history.hpp"
#include "support/ply_sheets.hpp"

#include <gtest/gtest.h>
#include <map>
#include <stdexcept>

namespace plyform::history_test {
namespace {

constexpr double rounding = 1e-9; // mm and degrees, of numbers of some 100

/// A square of 200 mm that is drawn by 10 mm along x and 20 mm along y at each border by time 1,
/// and sheared by 3 degrees all over.
Frame drawn(double time) {
  Frame frame;
  frame.time = time;
  frame.plies = {sheets::sheet(10, 10, 20.0, 0.0, [&](const Vec2& p) {
    return Vec3((1.0 - 0.1 * time) * p.x(), (1.0 - 0.2 * time) * p.y(), 0.0);
  })};
  frame.plies[0].shear_deg.assign(frame.plies[0].triangles.size(), -3.0 * time);
  frame.plies[0].wrinkle_height.assign(frame.plies[0].x.size(), 0.5 * time);
  frame.plies[0].bridging_height.assign(frame.plies[0].x.size(), 2.0 * time);
  frame.energy.mass_scaling = 7.0 * time;
  return frame;
}

std::map<std::string, std::vector<double>> by_heading(const std::vector<Series>& history) {
  std::map<std::string, std::vector<double>> values;
  for (const Series& series : history)
    values[series.heading()] = series.values;
  return values;
}

TEST(History, HasTheDrawInShearWrinklesAndBridgingOfEachPly) {
  std::vector<Series> history;
  for (const double time : {0.0, 1.0})
    append_state(history, drawn(time));
  auto found = by_heading(history);
  const double diagonal = 100.0 * (std::hypot(1.0, 1.0) - std::hypot(0.9, 0.8));
  EXPECT_NEAR(found["p_draw_in_mm"].at(0), 0.0, rounding);
  EXPECT_NEAR(found["p_draw_in_mm"].at(1), (2 * 10.0 + 2 * 20.0 + 4 * diagonal) / 8.0, rounding);
  EXPECT_NEAR(found["p_rms_shear_deg"].at(1), 3.0, rounding);
  EXPECT_NEAR(found["p_largest_shear_deg"].at(1), 3.0, rounding);
  EXPECT_EQ(found["p_largest_wrinkle_mm"], (std::vector<double>{0.0, 0.5}));
  EXPECT_EQ(found["p_largest_bridging_mm"], (std::vector<double>{0.0, 2.0}));
  EXPECT_NEAR(found["p_bridging_area_mm2"].at(1), 200.0 * 200.0, rounding); // of the flat ply
  EXPECT_EQ(found["mass_scaling_mJ"], (std::vector<double>{0.0, 7.0}));
}

TEST(History, OfPliesStandsInResultsAlone) {
  std::vector<Series> history;
  append_state(history, drawn(0.5));
  for (const Series& series : history)
    EXPECT_EQ(series.what.in_table, series.what.location != Location::ply) << series.heading();
}

TEST(History, OfAnotherSetOfBodiesIsRefused) {
  std::vector<Series> history;
  append_state(history, drawn(0.0));
  Frame other = drawn(0.5);
  other.tools.emplace_back();
  EXPECT_THROW(append_state(history, other), std::logic_error);
}

} // namespace
} // namespace plyform::history_test
