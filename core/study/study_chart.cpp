// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/study_chart.hpp"

#include "core/results/summary.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace plyform {

namespace {

using Json = nlohmann::json;

/// NaN without the key, and for null, which summary.json has in the place of what is not finite.
double number_at(const Json& object, const char* key) {
  const Json value = object.value(key, Json());
  return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}

/// A whole number; 0 without the key.
long count_at(const Json& object, const char* key) {
  return object.value(key, Json(0)).get_ref<const Json::number_integer_t&>();
}

/// The exceptions of the library tell of other types than summary.json has.
RunOutcome outcome_of(const Json& summary) {
  RunOutcome outcome;
  outcome.status = summary.at("status").get<std::string>();
  outcome.wall_time_s = number_at(summary, "wall_time_s");
  outcome.steps = count_at(summary, "steps");
  outcome.elements = count_at(summary, "elements");
  outcome.promised_deg =
      number_at(summary.value("accuracy", Json::object()), "promised_shear_error_deg");
  return outcome;
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
  RunOutcome failed;
  failed.status = "failed";
  try {
    const RunOutcome outcome = outcome_of(Json::parse(summary_json));
    return ended(outcome.status) || outcome.status == "stopped" ? outcome : failed;
  } catch (const Json::exception&) {
    return failed;
  }
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
