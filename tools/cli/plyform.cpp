// SPDX-License-Identifier: GPL-3.0-or-later
// The command line: plyform run | check | chart | export | identify | theory | keys | version.
#include "core/base/version.hpp"
#include "core/results/export.hpp"
#include "core/results/result_writer.hpp"
#include "tools/cli/commands.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <fmt/format.h>

using namespace plyform;

namespace {

void add_accuracy(CLI::App& app, CaseArguments& to) {
  app.add_option("--accuracy", to.accuracy,
                 "draft, standard or reference: shear angles to 3, 1 or 0.3 degrees, rms; picks "
                 "duration, fibre softening and up to 1.4 times larger elements")
      ->check(CLI::IsMember({"draft", "standard", "reference"}));
}

void add_case_options(CLI::App& command, CaseArguments& to) {
  command.add_option("case", to.file, "case file, or the folder of a case.toml")->required();
  command.add_option("--set", to.settings, "KEY=VALUE: overrides any key of the case")
      ->allow_extra_args(false)
      ->take_all();
}

int export_command(const std::string& directory) {
  for (const auto& file : export_results(directory))
    fmt::print("{}\n", file.string());
  return 0;
}

} // namespace

int main(int argc, char** argv) {
  CLI::App app{"Forms stacks of woven and non-crimp fabric plies between rigid tools."};
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 done, 2 the case or curve is wrong, 3 the simulation stopped itself, 1 else.");

  RunArguments run;
  CLI::App* run_app = app.add_subcommand("run", "form the plies of a case and write the results");
  add_case_options(*run_app, run.input);
  run_app->add_option("-o,--output", run.output, "folder for the results [results/NAME]");
  run_app->add_option("--threads", run.threads, "threads; the results do not depend on it")
      ->check(CLI::Range(1, 256));
  add_accuracy(*run_app, run.input);

  CaseArguments check;
  CLI::App* check_app =
      app.add_subcommand("check", "say what will be modelled, or every mistake in the case");
  add_case_options(*check_app, check);
  add_accuracy(*check_app, check);

  ChartArguments chart;
  CLI::App* chart_app =
      app.add_subcommand("chart", "run a case over its dials, draw wall time against error");
  chart_app->add_option("study", chart.study, "study file")->required();
  chart_app->add_option("-o,--output", chart.output, "folder for chart and runs [results/STUDY]");
  chart_app->add_option("--jobs", chart.jobs, "runs at a time [cores / threads]")
      ->check(CLI::Range(1, 256));
  chart_app->add_option("--threads", chart.threads, "threads of each run [1]")
      ->check(CLI::Range(1, 256));

  std::string results;
  CLI::App* export_app = app.add_subcommand("export", "write the last state in other formats");
  export_app->add_option("results", results, "folder of a run")->required();

  IdentifyArguments identify;
  CLI::App* identify_app =
      app.add_subcommand("identify", "turn a measured curve into a law of the fabric");
  add_identify_tests(*identify_app, identify);

  TheoryArguments theory;
  CLI::App* theory_app =
      app.add_subcommand("theory", "write the curve that a shear test of a fabric should give");
  add_theory_tests(*theory_app, theory);

  CLI::App* keys_app = app.add_subcommand("keys", "list every key of case and fabric files");
  bool markdown = false;
  keys_app->add_flag("--markdown", markdown, "as a page of tables");
  CLI::App* version_app = app.add_subcommand("version", "print the version");

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? exit_done : exit_other;
  }
  try {
    if (run_app->parsed()) return run_command(run);
    if (check_app->parsed()) return check_command(check);
    if (chart_app->parsed()) return chart_command(chart);
    if (export_app->parsed()) return export_command(results);
    if (identify_app->parsed()) return identify_command(identify);
    if (theory_app->parsed()) return theory_command(theory);
    if (keys_app->parsed()) return keys_command(markdown);
    if (version_app->parsed()) fmt::print("plyform {}\n", version());
    return 0;
  } catch (const std::exception& e) {
    fmt::print(stderr, "plyform: error: {}\n", e.what());
    return 1;
  }
}
