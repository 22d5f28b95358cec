// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/study_chart.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>

namespace plyform {

namespace {

/// What stands behind a key at the top of a summary.json, up to the next one. Texts in it have no
/// line ends of their own, so that none of them can look like a key.
std::string value_of(const std::string& json, const std::string& key) {
  const std::string start = "\n  \"" + key + "\": ";
  const std::size_t from = json.find(start);
  if (from == std::string::npos) return "";
  const std::size_t begin = from + start.size(), next = json.find("\n  \"", begin);
  std::string value = json.substr(begin, (next == std::string::npos ? json.size() : next) - begin);
  while (!value.empty() && std::string(",}\n ").find(value.back()) != std::string::npos)
    value.pop_back();
  return value;
}

double number_of(const std::string& value) {
  char* end = nullptr;
  const double number = std::strtod(value.c_str(), &end);
  return end == value.c_str() ? std::numeric_limits<double>::quiet_NaN() : number;
}

long count_of(const std::string& value) {
  return std::strtol(value.c_str(), nullptr, 10);
}

double promised(const std::string& json) {
  const std::string accuracy = value_of(json, "accuracy"), key = "\"promised_shear_error_deg\": ";
  const std::size_t from = accuracy.find(key);
  return from == std::string::npos ? std::numeric_limits<double>::quiet_NaN()
                                   : number_of(accuracy.substr(from + key.size()));
}

/// A field of a CSV row.
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text)
    quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + '"';
}

std::string field(double number) {
  return std::isfinite(number) ? fmt::format("{:.6g}", number) : "";
}

ChartPoint chart_point(const StudyPoint& point, const std::vector<RunOutcome>& outcomes) {
  const RunOutcome& outcome = outcomes[point.run];
  const double none = std::numeric_limits<double>::quiet_NaN();
  return {outcome.wall_time_s, outcome.error.rms, point.label, true,
          point.kind == PointKind::preset ? outcome.promised_deg : none};
}

/// The dial's points, by value where all are numbers, with the case itself among them.
ChartLine chart_line(const StudyPlan& plan, const std::vector<RunOutcome>& outcomes, int dial,
                     const std::string& name) {
  std::vector<StudyPoint> points;
  bool numbers = !std::isnan(plan.own[dial]);
  const StudyPoint* own = nullptr;
  for (const StudyPoint& point : plan.points) {
    if (point.kind == PointKind::plain) own = &point;
    if (point.dial != dial) continue;
    numbers = numbers && !std::isnan(point.value);
    points.push_back(point);
  }
  if (own && numbers) {
    std::erase_if(points, [&](const StudyPoint& point) { return point.run == own->run; });
    points.push_back(*own);
    points.back().value = plan.own[dial];
    std::stable_sort(points.begin(), points.end(),
                     [](const StudyPoint& a, const StudyPoint& b) { return a.value < b.value; });
  }
  ChartLine line{name, {}};
  for (const StudyPoint& point : points) {
    line.points.push_back(chart_point(point, outcomes));
    line.points.back().marked = point.kind == PointKind::dial;
  }
  return line;
}

} // namespace

RunOutcome read_outcome(const std::string& summary_json) {
  RunOutcome outcome;
  const std::string status = value_of(summary_json, "status");
  outcome.status = "failed";
  for (const char* known : {"done", "doubtful", "stopped"})
    if (status == fmt::format("\"{}\"", known)) outcome.status = known;
  if (outcome.status == "failed") return outcome;
  outcome.wall_time_s = number_of(value_of(summary_json, "wall_time_s"));
  outcome.steps = count_of(value_of(summary_json, "steps"));
  outcome.elements = count_of(value_of(summary_json, "elements"));
  outcome.promised_deg = promised(summary_json);
  return outcome;
}

std::vector<bool> on_front(const StudyPlan& plan, const std::vector<RunOutcome>& outcomes) {
  std::vector<bool> measured(outcomes.size());
  for (std::size_t i = 0; i < outcomes.size(); ++i)
    measured[i] = ended(outcomes[i].status) && !std::isnan(outcomes[i].error.rms);
  for (const StudyPoint& point : plan.points)
    if (point.kind == PointKind::reference) measured[point.run] = false;
  std::vector<bool> front = measured;
  for (std::size_t i = 0; i < outcomes.size(); ++i)
    for (std::size_t j = 0; j < outcomes.size() && front[i]; ++j) {
      const RunOutcome &a = outcomes[i], &b = outcomes[j];
      const bool as_good = b.wall_time_s <= a.wall_time_s && b.error.rms <= a.error.rms;
      const bool better = b.wall_time_s < a.wall_time_s || b.error.rms < a.error.rms;
      if (measured[j] && as_good && better) front[i] = false;
    }
  return front;
}

std::string chart_csv(const StudyPlan& plan, const std::vector<RunOutcome>& outcomes) {
  const std::vector<bool> front = on_front(plan, outcomes);
  std::string out = "line,setting,wall_time_s,cpu_s,steps,elements,rms_shear_error_deg,"
                    "p99_shear_error_deg,max_shear_error_deg,promised_error_deg,status,on_front\n";
  for (const StudyPoint& point : plan.points) {
    const RunOutcome& o = outcomes[point.run];
    const bool ran = o.status != "failed", compared = point.kind != PointKind::reference;
    const auto error = [&](double value) { return compared ? field(value) : std::string(); };
    const auto count = [&](long value) { return ran ? fmt::to_string(value) : std::string(); };
    out +=
        fmt::format("{},{},{},{},{},{},{},{},{},{},{},{}\n", field(point.line),
                    field(point.setting), ran ? field(o.wall_time_s) : "", field(o.cpu_s),
                    count(o.steps), count(o.elements), error(o.error.rms), error(o.error.p99),
                    error(o.error.max), field(o.promised_deg), o.status, front[point.run] ? 1 : 0);
  }
  return out;
}

Chart study_chart(const Study& study, const StudyPlan& plan,
                  const std::vector<RunOutcome>& outcomes, const std::string& note) {
  Chart chart;
  chart.title = study.title;
  chart.note = note;
  const std::vector<bool> front = on_front(plan, outcomes);
  for (const StudyPoint& point : plan.points) {
    const ChartPoint drawn = chart_point(point, outcomes);
    if (point.kind == PointKind::reference) chart.reference_time_s = drawn.time_s;
    if (point.kind == PointKind::plain) chart.own = drawn;
    if (point.kind == PointKind::preset) chart.presets.push_back(drawn);
    if (front[point.run]) chart.front.push_back(drawn);
  }
  chart.own.label = "case";
  std::stable_sort(chart.front.begin(), chart.front.end(),
                   [](const ChartPoint& a, const ChartPoint& b) { return a.time_s < b.time_s; });
  for (std::size_t i = 0; i < study.dials.size(); ++i)
    chart.dials.push_back(chart_line(plan, outcomes, static_cast<int>(i), study.dials[i].name));
  return chart;
}

} // namespace plyform
