// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/text.hpp"
#include "core/base/version.hpp"
#include "core/results/result_fields.hpp"
#include "core/study/study_chart.hpp"
#include "tools/cli/chart_runs.hpp"
#include "tools/cli/commands.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <thread>

namespace plyform {
namespace {

namespace fs = std::filesystem;

/// Output folder results/NAME. NAME is that of the study file, or of its folder if it is
/// study.toml.
fs::path output_folder(const ChartArguments& arguments) {
  if (!arguments.output.empty()) return arguments.output;
  const fs::path file = fs::absolute(arguments.study).lexically_normal();
  return fs::path("results") /
         (file.filename() == "study.toml" ? file.parent_path().filename() : file.stem());
}

/// Jobs and threads. If neither is given: one run per core, so that times are those of one core. If
/// one is given, the other is chosen to use all cores.
RunOptions run_options(const ChartArguments& arguments, const fs::path& folder) {
  const int cores = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  const int threads = std::max(1, arguments.threads);
  const int jobs = arguments.jobs > 0 ? arguments.jobs : std::max(1, cores / threads);
  return {folder / "runs", jobs, threads};
}

/// Name of the processor from /proc/cpuinfo; "processor" if it has none.
std::string processor_name() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);)
    if (line.starts_with("model name"))
      if (const std::size_t colon = line.find(": "); colon != std::string::npos)
        return line.substr(colon + 2);
  return "processor";
}

std::string plural(int count, const std::string& what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

/// Per run: its numbers, and its error relative to the last state of the reference.
std::vector<RunOutcome> read_outcomes(const StudyPlan& plan, const RunsEnd& end,
                                      const fs::path& folder) {
  std::vector<RunOutcome> outcomes;
  const Frame reference = read_last_frame(folder / plan.runs.front().name / "results.h5");
  for (std::size_t i = 0; i < plan.runs.size(); ++i) {
    const fs::path run = folder / plan.runs[i].name;
    std::string reason;
    outcomes.push_back(read_outcome(read_text(run / "summary.json", reason).value_or("")));
    if (!end.done[i]) continue;
    outcomes.back().cpu_s = cpu_time(run);
    if (i > 0) outcomes.back().error = shear_error(read_last_frame(run / "results.h5"), reference);
  }
  return outcomes;
}

void print_table(const StudyPlan& plan, const std::vector<RunOutcome>& outcomes) {
  const std::vector<bool> front = on_front(plan, outcomes);
  fmt::print("{:40} {:>9} {:>9} {:>9}\n", "", "wall, s", "rms, deg", "max, deg");
  for (const StudyPoint& point : plan.points) {
    const RunOutcome& o = outcomes[point.run];
    const std::string name = point.line + (point.setting.empty() ? "" : " " + point.setting);
    if (!ended(o.status) || point.kind == PointKind::reference)
      fmt::print("{:40} {:9.3g} {:>9}\n", name, o.wall_time_s, ended(o.status) ? "0" : o.status);
    else
      fmt::print("{:40} {:9.3g} {:9.3g} {:9.3g}{}\n", name, o.wall_time_s, o.error.rms, o.error.max,
                 front[point.run] ? "  best for its time" : "");
  }
}

} // namespace

int chart_command(const ChartArguments& arguments) {
  const StudyReading reading = read_study(arguments.study);
  for (const CaseError& error : reading.errors)
    fmt::print(stderr, "{}\n", error.text());
  if (!reading.value) return exit_case_wrong;
  const StudyPlan plan = plan_study(*reading.value);
  const fs::path folder = output_folder(arguments);
  const RunOptions options = run_options(arguments, folder);
  fs::create_directories(options.folder);
  const RunsEnd end = run_all(plan, reading.value->case_file, options);
  for (const std::string& trouble : end.troubles)
    fmt::print(stderr, "plyform: {}\n", trouble);
  if (end.code != 0) return end.code;
  const std::vector<RunOutcome> outcomes = read_outcomes(plan, end, options.folder);
  const std::string note =
      fmt::format("{}, {} of {} at a time, plyform {}", processor_name(),
                  plural(options.jobs, "run"), plural(options.threads, "thread"), version());
  write_whole(folder / "chart.csv", chart_csv(plan, outcomes));
  write_whole(folder / "chart.svg", chart_svg(study_chart(*reading.value, plan, outcomes, note)));
  print_table(plan, outcomes);
  fmt::print("chart and table are in {}\n", folder.string());
  const bool failed = std::any_of(outcomes.begin(), outcomes.end(),
                                  [](const RunOutcome& o) { return o.status == "failed"; });
  return failed ? exit_other : exit_done;
}

} // namespace plyform
