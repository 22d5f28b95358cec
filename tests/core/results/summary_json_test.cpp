// SPDX-License-Identifier: GPL-3.0-or-later
// tests/python/results_vtk_test.py reads a whole summary.json with Python's parser.
#include "core/results/result_fields.hpp"
#include "support/example_results.hpp"

#include <gtest/gtest.h>
#include <limits>

namespace plyform {
namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// A ply of two triangles, 99 mm2 with shear `most` and 1 mm2 with shear `rest`.
Frame unequal(double most, double rest) {
  PlyFrame ply;
  ply.name = "p";
  ply.x0 = {{0, 0, 0}, {99, 0, 0}, {0, 2, 0}, {-1, 0, 0}};
  ply.x = ply.x0;
  ply.triangles = {{0, 1, 2}, {0, 2, 3}};
  ply.shear_deg = {most, rest};
  ply.warp_strain = {0.001, -0.004};
  ply.weft_strain = {0.002, 0.003};
  ply.warp_tension = {-9, 1};
  ply.weft_tension = {2, 7};
  Frame frame;
  frame.plies = {ply};
  return frame;
}

TEST(SummaryJson, HasTheKeysOfTheDocumentation) {
  Summary summary{"a title",
                  "1.2.3",
                  "done",
                  "",
                  12.5,
                  1000,
                  1e-6,
                  2e-6,
                  4,
                  {0.25, 0.5, 0.75, 1.5},
                  {0.01, 0.02, 0.05, 3, 4},
                  {},
                  {},
                  {}};
  summary.work = {0.5, 0.25, 0.125, 12, {{"die", "p", 0.25, 0.03, 1.5, 0.2, 7}}, {"bending: small"},
                  {}};
  Frame frame = unequal(10, -20);
  frame.boundaries = {{"upper grip", 1.5, 20, {20, 3, 4}}};
  EXPECT_EQ(summary_json(frame, summary), R"({
  "title": "a title",
  "version": "1.2.3",
  "status": "done",
  "message": "",
  "time_s": 0,
  "stroke_mm": 0,
  "wall_time_s": 12.5,
  "steps": 1000,
  "time_step_s": {"min": 1e-06, "max": 2e-06},
  "threads": 4,
  "elements": 2,
  "nodes": 4,
  "plies": [
    {"name": "p", "angle_deg": 0, "max_shear_deg": 20, "p99_shear_deg": 10, "rms_shear_deg": 10.1488916, "max_fibre_strain": 0.003, "min_fibre_strain": -0.004, "max_tension_N_per_yarn": 7}
  ],
  "tools": [],
  "boundaries": [
    {"name": "upper grip", "force_N": 20, "displacement_mm": 1.5}
  ],
  "energy": {"kinetic": 0, "fibre": 0, "shear": 0, "bending": 0, "contact": 0, "friction": 0, "damping": 0, "external": 0, "balance_error": 0},
  "accuracy": {"promised_shear_error_deg": 1.5, "inertia_deg": 0.25, "softening_deg": 0.5, "mesh_deg": 0.75, "element_size_factor": 1},
  "contact": {"max_tool_penetration_mm": 0.01, "max_tool_penetration_between_nodes_mm": 0.05, "max_ply_penetration_mm": 0.02, "intersections_between_plies": 3, "intersections_within_plies": 4},
  "searches": 12,
  "time_shares": {"elements": 0.5000, "contact": 0.2500, "search": 0.1250},
  "pairs": [
    {"a": "die", "b": "p", "time_share": 0.2500, "deepest_mm": 0.03, "slip_mm": 1.5, "friction_coefficient": 0.2, "friction_mJ": 7}
  ],
  "assumed": [],
  "could_be_left_out": [
    "bending: small"
  ],
  "missing": []
}
)"); // rms: sqrt((99 * 10^2 + 1 * 20^2) / 100) = sqrt(103)
}

TEST(SummaryJson, HasTheKeysOfAPlysReport) {
  Summary summary;
  PlyReport report;
  report.pressed = PressedYarns{0.07, 0.3, 0.04, 2.5, {1, 2, 3}};
  report.wrinkle = {1.5, 40, {4, 5, 6}};
  report.beyond_locking_share = 0.125;
  report.draw_in = {{-45, 45, 135, 225}, {0, 90, 180, 270}, {1, 2, 3, 4}, {5, 6, 7, 12}, ""};
  summary.plies = {report};
  const std::string json = summary_json(unequal(10, -20), summary);
  EXPECT_TRUE(contains(json,
                       "\"max_tension_N_per_yarn\": 7, \"max_pressed_strain\": 0.07, "
                       "\"area_share_pressed_over_2_percent\": 0.3, "
                       "\"area_share_pressed_over_5_percent\": 0.04, \"excess_length_mm\": 2.5, "
                       "\"excess_length_at_mm\": [1, 2, 3], \"wrinkle_height_mm\": 1.5, "
                       "\"wrinkle_length_mm\": 40, \"wrinkle_at_mm\": [4, 5, 6], "
                       "\"area_share_beyond_locking_angle\": 0.125, "
                       "\"draw_in_mm\": {\"mean\": 5, \"largest\": 12}, "
                       "\"draw_in_yarns_mm\": {\"mean\": 2.5, \"spread\": 3, "
                       "\"directions_deg\": [315, 45, 135, 225], \"each\": [1, 2, 3, 4]}, "
                       "\"draw_in_bisectors_mm\": {\"mean\": 7.5, \"spread\": 7, "
                       "\"directions_deg\": [0, 90, 180, 270], \"each\": [5, 6, 7, 12]}}"))
      << json;
  report = {};
  report.draw_in.unknown = "why";
  summary.plies = {report};
  const std::string bare = summary_json(unequal(10, -20), summary);
  EXPECT_TRUE(contains(bare, "7, \"wrinkle_height_mm\": 0, \"wrinkle_length_mm\": 0, "
                             "\"wrinkle_at_mm\": [0, 0, 0], \"no_draw_in\": \"why\"}"))
      << bare;
}

TEST(SummaryJson, PercentileOfShearIsWeightedByAreaNotByNumber) {
  // 1 of 100 mm2 has 20 degrees: 99 % of the area stays at or below 10
  EXPECT_TRUE(contains(summary_json(unequal(10, 20), {}), "\"p99_shear_deg\": 10,"));
  // 99 of 100 mm2 have 20 degrees
  EXPECT_TRUE(contains(summary_json(unequal(-20, 10), {}), "\"p99_shear_deg\": 20,"));
}

TEST(SummaryJson, NumbersThatAreNotFiniteBecomeNull) {
  Frame frame = unequal(nan_value, 20);
  frame.plies[0].weft_strain[1] = nan_value;
  frame.plies[0].warp_tension[1] = std::numeric_limits<double>::infinity();
  frame.energy.shear = nan_value;
  const std::string json = summary_json(frame, {});
  for (const char* key : {"max_shear_deg", "p99_shear_deg", "rms_shear_deg", "max_fibre_strain",
                          "min_fibre_strain", "max_tension_N_per_yarn", "shear", "balance_error"})
    EXPECT_TRUE(contains(json, std::string("\"") + key + "\": null")) << key << '\n' << json;
  EXPECT_FALSE(contains(json, "nan"));
  EXPECT_FALSE(contains(json, "inf,"));
}

TEST(SummaryJson, TextIsEscapedAndAlwaysUtf8) {
  Summary summary;
  // Latin-1 e acute, an overlong slash, a surrogate, a cut sequence; and what is fine
  summary.title = "q\" b\\ n\n \xe9 \xc0\xaf \xed\xa0\x80 90\u00b0 \u2192 \U0001f600 \xe2\x86";
  EXPECT_TRUE(contains(summary_json({}, summary),
                       "\"title\": \"q\\\" b\\\\ n\\u000a \\ufffd \\ufffd\\ufffd "
                       "\\ufffd\\ufffd\\ufffd 90\u00b0 \u2192 \U0001f600 \\ufffd\\ufffd\""))
      << summary_json({}, summary);
}

} // namespace
} // namespace plyform
