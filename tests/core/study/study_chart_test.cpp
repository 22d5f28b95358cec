// SPDX-License-Identifier: GPL-3.0-or-later
// The table and the picture of a study's runs.
#include "core/study/chart_labels.hpp"
#include "core/study/study_chart.hpp"
#include "tests/support/results_helpers.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <nlohmann/json.hpp>

namespace plyform {
namespace {

using results_test::contains;

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();

RunOutcome outcome(double wall, double rms, const std::string& status = "done") {
  RunOutcome o;
  o.status = status;
  o.wall_time_s = wall;
  o.steps = 100;
  o.elements = 50;
  if (!std::isnan(rms)) o.error = {rms, 2.0 * rms, 3.0 * rms};
  return o;
}

/// Reference, case, one preset, and two dials: of three values, one of them the case's own, and of
/// two, of which one stopped.
struct Example {
  Study study;
  StudyPlan plan;
  std::vector<RunOutcome> outcomes;
};

Example example() {
  Example e;
  e.study.title = "Speed & <error>";
  e.study.dials = {{"softening", "solver.fibre_softening", {"10", "100", "1000"}},
                   {"duration, s", "solver.duration", {"0.1", "0.2"}}};
  e.plan.own = {100.0, 0.5};
  e.plan.points = {{PointKind::reference, "reference", "step=0.5", "reference", -1, 0},
                   {PointKind::plain, "case", "", "case", -1, 1},
                   {PointKind::preset, "preset", "draft", "draft", -1, 2},
                   {PointKind::dial, "softening", "solver.fibre_softening=10", "10", 0, 3, 10},
                   {PointKind::dial, "softening", "solver.fibre_softening=100", "100", 0, 1, 100},
                   {PointKind::dial, "softening", "solver.fibre_softening=1000", "1000", 0, 4, 1e3},
                   {PointKind::dial, "duration, s", "solver.duration=0.1", "0.1", 1, 5, 0.1},
                   {PointKind::dial, "duration, s", "solver.duration=0.2", "0.2", 1, 6, 0.2}};
  e.plan.runs.resize(7);
  e.outcomes = {outcome(90, nan_value), outcome(10, 1.0), outcome(4, 3.0),
                outcome(30, 1.5),       outcome(3, 2.0),  outcome(1, nan_value, "stopped"),
                outcome(20, 0.5)};
  e.outcomes[2].promised_deg = 2.5;
  e.outcomes[1].cpu_s = 9.5;
  return e;
}

TEST(StudyChart, FrontIsOfRunsThatNoOtherBeatsInBoth) {
  const Example e = example();
  // Neither the reference, nor the stopped run, nor the preset (slower and worse than softening
  // 1000), nor softening 10 (slower and worse than the case).
  EXPECT_EQ(on_front(e.plan, e.outcomes),
            (std::vector<bool>{false, true, false, false, true, false, true}));
}

TEST(StudyChart, FrontKeepsBothOfTwoEqualRuns) {
  Example e = example();
  e.outcomes[3] = e.outcomes[1];
  const std::vector<bool> front = on_front(e.plan, e.outcomes);
  EXPECT_TRUE(front[1] && front[3]);
}

TEST(StudyChart, TableHasARowAPoint) {
  const Example e = example();
  EXPECT_EQ(chart_csv(e.plan, e.outcomes),
            "line,setting,wall_time_s,cpu_s,steps,elements,rms_shear_error_deg,"
            "p99_shear_error_deg,max_shear_error_deg,promised_error_deg,status,on_front\n"
            "reference,step=0.5,90,,100,50,,,,,done,0\n"
            "case,,10,9.5,100,50,1,2,3,,done,1\n"
            "preset,draft,4,,100,50,3,6,9,2.5,done,0\n"
            "softening,solver.fibre_softening=10,30,,100,50,1.5,3,4.5,,done,0\n"
            "softening,solver.fibre_softening=100,10,9.5,100,50,1,2,3,,done,1\n"
            "softening,solver.fibre_softening=1000,3,,100,50,2,4,6,,done,1\n"
            "\"duration, s\",solver.duration=0.1,1,,100,50,,,,,stopped,0\n"
            "\"duration, s\",solver.duration=0.2,20,,100,50,0.5,1,1.5,,done,1\n");
}

TEST(StudyChart, DialsGoThroughTheCaseInTheOrderOfTheirValues) {
  const Example e = example();
  const Chart chart = study_chart(e.study, e.plan, e.outcomes, "note");
  ASSERT_EQ(chart.dials.size(), 2u);
  std::vector<double> times;
  std::string marked;
  for (const ChartLine& dial : chart.dials)
    for (const ChartPoint& point : dial.points) {
      times.push_back(point.time_s);
      marked += point.marked ? '1' : '0';
    }
  EXPECT_EQ(times, (std::vector<double>{30, 10, 3, 1, 20, 10})); // own: 100 and 0.5
  EXPECT_EQ(marked, "101110");
  ASSERT_EQ(chart.front.size(), 4u); // the case twice
  EXPECT_EQ(chart.front.front().time_s, 3);
  EXPECT_EQ(chart.front.back().time_s, 20);
  EXPECT_EQ(chart.reference_time_s, 90);
}

TEST(StudyChart, ReadsOutcomesFromWhatRunsWrite) {
  Summary summary;
  summary.title = "no \"status\": \"stopped\"\n  \"steps\": 3";
  summary.wall_time_s = 12.5;
  summary.steps = 1234;
  summary.accuracy.promised_deg = 1.25;
  const std::string json = summary_json(results_test::frame(1.0), summary);
  const RunOutcome done = read_outcome(json);
  EXPECT_EQ(done.status, "done");
  EXPECT_EQ(done.wall_time_s, 12.5);
  EXPECT_EQ(done.steps, 1234);
  EXPECT_EQ(done.elements, 18 + 32);
  EXPECT_EQ(done.promised_deg, 1.25);
  summary.status = "stopped";
  EXPECT_EQ(read_outcome(summary_json(results_test::frame(1.0), summary)).status, "stopped");
  summary.status = "doubtful";
  EXPECT_EQ(read_outcome(summary_json(results_test::frame(1.0), summary)).status, "doubtful");
  EXPECT_TRUE(std::isnan(read_outcome("{\n  \"status\": \"done\"\n}\n").promised_deg));
  // what is not finite is null in the file
  summary.wall_time_s = summary.accuracy.promised_deg = nan_value;
  const RunOutcome unknown = read_outcome(summary_json(results_test::frame(1.0), summary));
  EXPECT_EQ(unknown.status, "doubtful");
  EXPECT_TRUE(std::isnan(unknown.wall_time_s) && std::isnan(unknown.promised_deg));
}

TEST(StudyChart, TakesWhatIsNoSummaryForAFailedRun) {
  for (const char* text :
       {"", " ", "done", "\"done\"", "null", "3", "[]", "{}", "[{\"status\": \"done\"}]",
        "{\"status\": \"done\"} more", "{\"status\": \"done\", \"title\": \"\xe9\"}",
        "{\"status\": \"done\", \"wall_time_s\": 1e999}", "{\"status\": \"interrupted\"}",
        "\xff\xfe\x01"})
    EXPECT_EQ(read_outcome(text).status, "failed") << text;
  EXPECT_EQ(read_outcome(std::string(1000, '\0')).status, "failed");
  EXPECT_EQ(read_outcome(std::string(1000000, '[')).status, "failed");
  const std::string whole = summary_json(results_test::frame(1.0), {});
  EXPECT_EQ(read_outcome(whole).status, "done");
  for (std::size_t size = 0; size + 1 < whole.size(); ++size) // the last byte is a line end
    EXPECT_EQ(read_outcome(whole.substr(0, size)).status, "failed") << size;
}

TEST(StudyChart, TakesASummaryWithOtherTypesForAFailedRun) {
  using nlohmann::json;
  const json whole = json::parse(summary_json(results_test::frame(1.0), {}));
  EXPECT_EQ(read_outcome(whole.dump()).status, "done");
  const std::vector<std::pair<const char*, json>> others = {
      {"status", 3},          {"status", json::array()},
      {"status", nullptr},    {"wall_time_s", "long"},
      {"wall_time_s", true},  {"steps", "many"},
      {"steps", 1.5},         {"steps", 1e30},
      {"elements", nullptr},  {"elements", json::object()},
      {"accuracy", "little"}, {"accuracy", {{"promised_shear_error_deg", "3"}}}};
  for (const auto& [key, value] : others) {
    json other = whole;
    other[key] = value;
    const RunOutcome read = read_outcome(other.dump());
    EXPECT_EQ(read.status, "failed") << key << ": " << value;
    EXPECT_EQ(read.steps, 0) << "half a summary: " << key << ": " << value;
  }
}

/// Whether every element of a document is closed in its turn and attributes are in quotes: enough
/// for what chart_svg can get wrong. The test of the command asks Python's parser too.
bool well_formed(const std::string& text) {
  std::vector<std::string> open;
  bool root_closed = false;
  for (std::size_t i = 0; i < text.size();) {
    if (text[i] != '<') {
      if (text[i] == '&' && text.find(';', i) > i + 5) return false;
      ++i;
      continue;
    }
    const std::size_t end = text.find('>', i);
    if (end == std::string::npos || root_closed) return false;
    const std::string tag = text.substr(i + 1, end - i - 1);
    if (std::count(tag.begin(), tag.end(), '"') % 2 || contains(tag, "<")) return false;
    const std::string name = tag.substr(tag[0] == '/', tag.find(' '));
    if (tag[0] == '/') {
      if (open.empty() || open.back() != name) return false;
      open.pop_back();
      root_closed = open.empty();
    } else if (tag.back() != '/') {
      open.push_back(name);
    }
    i = end + 1;
  }
  return root_closed;
}

TEST(ChartSvg, IsWellFormedAndShowsEveryDialPresetAndValue) {
  EXPECT_FALSE(well_formed("<a><b></a></b>")); // the checker itself
  EXPECT_FALSE(well_formed("<a b=\"></a>"));
  const Example e = example();
  const std::string svg =
      chart_svg(study_chart(e.study, e.plan, e.outcomes, "two \"quotes\" \x01"));
  EXPECT_TRUE(well_formed(svg)) << svg;
  for (const char* text :
       {">Speed &amp; &lt;error&gt;<", ">two &quot;quotes&quot;  <", ">softening<", ">duration, s<",
        ">draft<", ">10<", ">1000<", ">0.1 stopped<", ">0.2<", ">case<", ">reference run<",
        "id=\"dial0\"", "id=\"dial1\""})
    EXPECT_TRUE(contains(svg, text)) << text;
  EXPECT_FALSE(contains(svg, "nan") || contains(svg, "inf"));
}

TEST(ChartSvg, NumbersAnAxisOfLessThanADecade) {
  Example e = example();
  for (RunOutcome& o : e.outcomes)
    o.error.rms = 0.13 + 0.05 * o.error.rms; // 0.155 to 0.28
  e.outcomes[2].promised_deg = 0.31;
  const std::string svg = chart_svg(study_chart(e.study, e.plan, e.outcomes, ""));
  for (const char* number : {">0.15<", ">0.2<", ">0.3<"})
    EXPECT_TRUE(contains(svg, number)) << number << svg;
}

TEST(ChartSvg, DrawsAnythingWithoutNumbersThatAreNone) {
  Chart chart;
  EXPECT_TRUE(well_formed(chart_svg(chart)));
  chart.own = {1.0, 0.0, "case"}; // an error of zero
  chart.dials = {{"one", {{2.0, 1e-9, "a"}, {3.0, 1e9, "b"}}}, {"none", {}}};
  chart.presets = {{4.0, nan_value, "draft", true, 1.0}, {0.0, 1.0, "not run"}};
  const std::string svg = chart_svg(chart);
  EXPECT_TRUE(well_formed(svg));
  EXPECT_FALSE(contains(svg, "nan") || contains(svg, "inf") || contains(svg, ">not run<")) << svg;
}

TEST(ChartLabels, OfPointsSomeLettersApartDoNotCover) {
  std::vector<LabelRequest> requests;
  for (int i = 0; i < 6; ++i)
    requests.push_back({Vec2(100 + 25 * i, 150 + 9 * (i % 2)), 4, "value " + std::to_string(i)});
  const std::vector<Vec2> places = place_labels(requests, 12, {{0, 0, 500, 300}, {}, {}});
  ASSERT_EQ(places.size(), requests.size());
  for (std::size_t i = 0; i < places.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_TRUE(std::abs(places[i].x() - places[j].x()) >= text_width("value 0", 12) - 1e-9 ||
                  std::abs(places[i].y() - places[j].y()) >= 12 - 1e-9)
          << i << " over " << j;
}

} // namespace
} // namespace plyform
