// SPDX-License-Identifier: GPL-3.0-or-later
// tests/python/results_vtk_test.py reads a whole summary.json with Python's parser.
#include "core/results/result_fields.hpp"
#include "support/example_results.hpp"

#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>

namespace plyform::summary_json_test {
namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();

/// Compares the order of keys too.
using Json = nlohmann::ordered_json;

/// The content as a reader sees it. Throws what is no JSON.
Json read_back(const Frame& frame, const Summary& summary) {
  return Json::parse(summary_json(frame, summary));
}

Json ply_read_back(const Frame& frame, const Summary& summary) {
  return read_back(frame, summary).at("plies").at(0);
}

/// A ply of two triangles, 99 mm2 with shear `most` and 1 mm2 with shear `rest`.
Frame unequal(double most, double rest) {
  PlyFrame ply;
  ply.name = "p";
  ply.x0 = {{0, 0, 0}, {99, 0, 0}, {0, 2, 0}, {-1, 0, 0}};
  ply.x = ply.x0;
  ply.triangles = {{0, 1, 2}, {0, 2, 3}};
  ply.shear_deg = {most, rest};
  ply.families = {{"warp", 0, {}, {0.001, -0.004}, {-9, 1}},
                  {"weft", 90, {}, {0.002, 0.003}, {2, 7}}};
  Frame frame;
  frame.plies = {ply};
  return frame;
}

Summary made_up_summary() {
  Summary summary{"a title",
                  "1.2.3",
                  "done",
                  "",
                  12.5,
                  1000,
                  1e-6,
                  2e-6,
                  0.004,
                  0.125,
                  4,
                  {0.25, 0.5, 0.75, 1.5, 1.0, {}},
                  0.0625,
                  {},
                  {0.01, 0.02, 0.05, 3, 4},
                  {},
                  {},
                  {},
                  {},
                  {{"ply.p.angle", "45"}}};
  summary.work = {0.5,
                  0.25,
                  0.125,
                  12,
                  {{"die", "p", 0.25, 0.03, 1.5, 0.2, 7, {}, {}, {}, {}}},
                  {"bending: small"},
                  {}};
  return summary;
}

TEST(SummaryJson, HasTheKeysOfTheDocumentation) {
  const Summary summary = made_up_summary();
  Frame frame = unequal(10, -20);
  frame.boundaries = {{"upper grip", 1.5, 20, {20, 3, 4}}};
  Json json = read_back(frame, summary);
  json.erase("figures"); // below
  for (const char* key : {"steps", "threads", "elements", "nodes", "searches"})
    EXPECT_TRUE(json.at(key).is_number_integer()) << key; // 4 and 4.0 compare as equal below
  EXPECT_EQ(json, Json::parse(R"({
  "title": "a title",
  "version": "1.2.3",
  "status": "done",
  "message": "",
  "time_s": 0,
  "stroke_mm": 0,
  "wall_time_s": 12.5,
  "steps": 1000,
  "time_step_s": {"min": 1e-06, "max": 2e-06},
  "largest_added_mass": 0.004,
  "element_added_mass": 0.125,
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
  "energy": {"kinetic": 0, "fibre": 0, "shear": 0, "stitch": 0, "bending": 0, "contact": 0, "friction": 0, "film": 0, "damping": 0, "compaction": 0, "viscous": 0, "stitch_breaking": 0, "external": 0, "mass_scaling": 0, "balance_error": 0},
  "kinetic_over_deformation": 0.0625,
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
  "missing": [],
  "doubts": [],
  "advice": [],
  "case": {"ply.p.angle": "45"}
})")); // rms: sqrt((99 * 10^2 + 1 * 20^2) / 100) = sqrt(103)
}

TEST(SummaryJson, PartsThatWereNotMeasuredAreNull) {
  Summary summary;
  VerifiedFigure figure;
  figure.name = "force of punch", figure.unit = "N", figure.value = 10.8, figure.inertia = 0.5;
  summary.verification.figures = {figure};
  summary.verification.partings = {{"p", 0.05, 28.8, {1, 2, 3}, 0.7, 1.8}};
  const Json json = read_back(unequal(10, -20), summary).at("verification");
  EXPECT_EQ(json.at("figures").at(0), Json::parse(R"({"name": "force of punch", "unit": "N",
    "value": 10.8, "band": null, "mesh": null, "inertia": 0.5, "softening": null, "chance": null,
    "unmeasured": ["mesh", "softening", "chance"]})"));
  EXPECT_EQ(json.at("partings"), Json::parse(R"([{"ply": "p", "time_s": 0.05, "stroke_mm": 28.8,
    "at_mm": [1, 2, 3], "apart_mm": 0.7, "shear_deg": 1.8}])"));
}

TEST(SummaryJson, HasTheKeysOfAPlysReport) {
  Summary summary;
  PlyReport report;
  report.pressed = PressedYarns{0.07, 0.3, 0.04, 2.5, {1, 2, 3}};
  report.wrinkle = {1.5, 40, {4, 5, 6}};
  report.bridging = {5.5, {1, 0, 2}, 120, "warp", 0.5, 0.25};
  report.locking_angle_deg = 45;
  report.beyond_locking_share = 0.125;
  report.openings = {{"tow", 0.2, {7, 8, 9}, 0.1, 500, 0.25}};
  report.draw_in = {{-45, 45, 135, 225}, {0, 90, 180, 270}, {1, 2, 3, 4}, {5, 6, 7, 12}, ""};
  summary.plies = {report};
  EXPECT_EQ(ply_read_back(unequal(10, -20), summary), Json::parse(R"({
  "name": "p", "angle_deg": 0, "max_shear_deg": 20, "p99_shear_deg": 10, "rms_shear_deg": 10.1488916,
  "max_fibre_strain": 0.003, "min_fibre_strain": -0.004, "max_tension_N_per_yarn": 7,
  "max_pressed_strain": 0.07, "area_share_pressed_over_2_percent": 0.3,
  "area_share_pressed_over_5_percent": 0.04, "excess_length_mm": 2.5,
  "excess_length_at_mm": [1, 2, 3], "wrinkle_height_mm": 1.5, "wrinkle_length_mm": 40,
  "wrinkle_at_mm": [4, 5, 6], "bridging_height_mm": 5.5, "bridging_area_mm2": 120,
  "bridging_at_mm": [1, 0, 2],
  "bridging_max_tension_N_per_yarn": 0.5, "bridging_mean_tension_N_per_yarn": 0.25,
  "locking_angle_deg": 45, "area_share_beyond_locking_angle": 0.125,
  "area_beyond_locking_angle_mm2": 12.5,
  "draw_in_mm": {"mean": 5, "largest": 12},
  "draw_in_yarns_mm": {"mean": 2.5, "spread": 3, "directions_deg": [315, 45, 135, 225],
                       "each": [1, 2, 3, 4]},
  "draw_in_bisectors_mm": {"mean": 7.5, "spread": 7, "directions_deg": [0, 90, 180, 270],
                           "each": [5, 6, 7, 12]},
  "bridging_family": "warp",
  "openings": [{"family": "tow", "largest": 0.2, "at_mm": [7, 8, 9], "limit": 0.1,
                "area_mm2_beyond_limit": 500, "area_share_beyond_limit": 0.25}]
})"));
  report = {};
  report.draw_in.unknown = "why";
  report.bridging = Bridging{}; // could be, is not
  summary.plies = {report};
  EXPECT_EQ(ply_read_back(unequal(10, -20), summary), Json::parse(R"({
  "name": "p", "angle_deg": 0, "max_shear_deg": 20, "p99_shear_deg": 10, "rms_shear_deg": 10.1488916,
  "max_fibre_strain": 0.003, "min_fibre_strain": -0.004, "max_tension_N_per_yarn": 7,
  "wrinkle_height_mm": 0, "wrinkle_length_mm": 0, "wrinkle_at_mm": [0, 0, 0],
  "bridging_height_mm": 0, "bridging_area_mm2": 0, "no_draw_in": "why"
})"));
}

/// The numbers of an object by their paths, of objects within it too.
void each_path(const Json& object, const std::string& before,
               const std::function<void(const std::string&)>& visit) {
  for (const auto& [key, value] : object.items())
    if (value.is_object())
      each_path(value, before + key + ".", visit);
    else if (value.is_number())
      visit(before + key);
}

TEST(SummaryJson, DescribesEveryNumberOfAPlyAndNoOther) {
  Frame frame = unequal(10, -20);
  frame.plies[0].temperature = {20, 30, 40, 50};
  PlyReport report;
  report.pressed = PressedYarns{};
  report.bridging = {5.5, {1, 0, 2}, 120, "warp", 0.5, 0.25};
  report.fibre_volume = FibreVolume{};
  report.mould = MouldFill{};
  report.locking_angle_deg = 45, report.beyond_locking_share = 0.125;
  report.max_stretch = 1.5, report.stretch_limit = 2, report.beyond_stretch_share = 0;
  report.max_shear_rate = 1, report.measured_shear_rate = 2, report.beyond_rate_share = 0;
  Summary summary;
  summary.plies = {report};
  const Json json = read_back(frame, summary);
  std::map<std::string, Json> described = json.at("figures").at("plies");
  const auto check = [&](const std::string& path) {
    if (path == "angle_deg" || path.find("_yarns_") != path.npos ||
        path.find("_bisectors_") != path.npos)
      return; // what the ply is; walks one by one
    ASSERT_TRUE(described.contains(path)) << path;
    EXPECT_FALSE(described.at(path).at("label").get<std::string>().empty()) << path;
    described.erase(path);
  };
  each_path(json.at("plies").at(0), "", check);
  EXPECT_TRUE(described.empty()) << described.begin()->first;
  EXPECT_EQ(json.at("figures").at("plies").at("rms_shear_deg"),
            Json::parse(
                R"({"label": "shear, rms", "unit": "deg", "digits": 1, "note": "over the area",
        "verified": "shear", "compared": true})"));
  for (const auto& [path, one] : json.at("figures").at("run").items())
    EXPECT_TRUE(
        json.contains(Json::json_pointer("/" + std::regex_replace(path, std::regex("[.]"), "/"))))
        << path;
}

TEST(SummaryJson, HasTheKeysOfAMould) {
  Frame frame = unequal(10, -20);
  frame.tools.resize(2);
  frame.tools[0].name = "press", frame.tools[1].name = "floor";
  PlyFrame& ply = frame.plies[0]; // 99 and 1 mm2
  ply.thickness = {0.5, 0.4}, ply.fibre_volume = {0.4, 0.5};
  ply.mould = {{1.0, 2.0}, {0.0, 0.5}, {1.0, 0.4}, {}};
  Summary summary;
  summary.pushed = {{"press", 2.5, false}};
  PlyReport report;
  report.draw_in.unknown = "why";
  report.fibre_volume = fibre_volume_of(ply), report.mould = mould_fill_of(ply);
  summary.plies = {report};
  const Json found = read_back(frame, summary);
  const Json wanted = Json::parse(R"({
    "fibre_volume_mean": 0.400801603, "fibre_volume_min": 0.4, "fibre_volume_max": 0.5,
    "fibre_volume_min_at_mm": [33, 0.666666667, 0],
    "fibre_volume_max_at_mm": [-0.333333333, 0.666666667, 0],
    "mould_area_mm2": 100, "mould_gap_min_mm": 1, "mould_gap_mean_mm": 1.01,
    "mould_wider_area_mm2": 1, "mould_packed_area_mm2": 99, "max_gap_left_mm": 0.5,
    "max_gap_left_at_mm": [-0.333333333, 0.666666667, 0]})"); // mean: (99 0.2 + 0.2) / (99 0.5 +
                                                              // 0.4)
  for (const auto& [key, value] : wanted.items())
    EXPECT_EQ(found.at("plies").at(0).at(key), value) << key;
  EXPECT_EQ(found.at("tools").at(0).at("speed_mm_s"), 2.5);
  EXPECT_EQ(found.at("tools").at(0).at("at_rest"), false);
  EXPECT_FALSE(found.at("tools").at(1).contains("at_rest"));
}

TEST(SummaryJson, EachPlyHasItsOwnReport) {
  Frame frame = unequal(10, -20);
  frame.plies.push_back(frame.plies[0]);
  Summary summary;
  summary.plies.resize(2);
  summary.plies[0].wrinkle.height = 1;
  summary.plies[1].wrinkle.height = 2;
  const Json plies = read_back(frame, summary).at("plies");
  EXPECT_EQ(plies.at(0).at("wrinkle_height_mm"), 1);
  EXPECT_EQ(plies.at(1).at("wrinkle_height_mm"), 2);
}

TEST(SummaryJson, IsLaidOutAValueALineWithNumbersOfNineDigits) {
  Summary summary;
  summary.wall_time_s = 100.0 / 3.0;
  summary.work.search_share = 1.0 / 3.0;
  Frame frame;
  frame.time = 0.1 + 0.2; // 0.30000000000000004
  const std::string json = summary_json(frame, summary);
  EXPECT_EQ(json.substr(0, json.find("\n  \"steps\"")), R"({
  "title": "",
  "version": "",
  "status": "done",
  "message": "",
  "time_s": 0.3,
  "stroke_mm": 0.0,
  "wall_time_s": 33.3333333,)");
  EXPECT_NE(json.find("\n    \"search\": 0.3333\n  },\n"), std::string::npos) << json;
  EXPECT_EQ(json.substr(json.size() - 3), "\n}\n");
}

TEST(SummaryJson, PercentileOfShearIsWeightedByAreaNotByNumber) {
  // 1 of 100 mm2 has 20 degrees: 99 % of the area stays at or below 10
  EXPECT_EQ(ply_read_back(unequal(10, 20), {}).at("p99_shear_deg"), 10);
  // 99 of 100 mm2 have 20 degrees
  EXPECT_EQ(ply_read_back(unequal(-20, 10), {}).at("p99_shear_deg"), 20);
}

TEST(SummaryJson, NumbersThatAreNotFiniteBecomeNull) {
  Frame frame = unequal(nan_value, 20);
  frame.plies[0].families[1].strain[1] = nan_value;
  frame.plies[0].families[0].tension[1] = std::numeric_limits<double>::infinity();
  frame.energy.shear = nan_value;
  Summary summary;
  summary.work.search_share = nan_value;
  summary.plies.resize(1);
  summary.plies[0].wrinkle.at = {0, nan_value, 0};
  const Json json = read_back(frame, summary);
  for (const char* key : {"max_shear_deg", "p99_shear_deg", "rms_shear_deg", "max_fibre_strain",
                          "min_fibre_strain", "max_tension_N_per_yarn"})
    EXPECT_TRUE(json.at("plies").at(0).at(key).is_null()) << key << '\n' << json;
  EXPECT_TRUE(json.at("plies").at(0).at("wrinkle_at_mm").at(1).is_null()) << json;
  for (const char* key : {"shear", "balance_error"})
    EXPECT_TRUE(json.at("energy").at(key).is_null()) << key << '\n' << json;
  EXPECT_TRUE(json.at("time_shares").at("search").is_null()) << json;
}

TEST(SummaryJson, TextIsEscapedAndAlwaysUtf8) {
  Summary summary;
  const std::string fine = "q\" b\\ n\n \x01 \x7f 90\u00b0 \u2192 \U0001f600";
  summary.title = fine;
  EXPECT_EQ(read_back({}, summary).at("title"), fine);
  // Latin-1 e acute, an overlong slash, a surrogate, a cut sequence; the parser refuses such bytes
  summary.title = "\xe9 \xc0\xaf \xed\xa0\x80 \xe2\x86";
  EXPECT_EQ(read_back({}, summary).at("title"), "\ufffd \ufffd\ufffd \ufffd\ufffd\ufffd \ufffd");
  summary.title = "";
  summary.message = summary.status = summary.version = "\xe9";
  summary.assumed = summary.work.missing = summary.work.could_be_left_out = {"\xe9"};
  summary.work.pairs = {{"\xe9", "\xe9", 0, 0, 0, 0, 0, "\xe9", {}, {}, {}}};
  Frame frame = unequal(10, 20);
  frame.plies[0].name = "\xe9";
  const Json json = read_back(frame, summary);
  EXPECT_EQ(json.at("missing"), Json::array({"\ufffd"}));
  EXPECT_EQ(json.at("advice"), Json::array({"\ufffd"}));
  EXPECT_EQ(json.at("plies").at(0).at("name"), "\ufffd");
}

} // namespace
} // namespace plyform::summary_json_test
