// SPDX-License-Identifier: GPL-3.0-or-later
// The command line: plyform run | check | study | studio | report | map | pattern | export |
// difference | identify | theory | keys | version.
#include "base/format.hpp"
#include "base/outputs.hpp"
#include "base/text.hpp"
#include "base/version.hpp"
#include "core/setup/scene_mesh.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/standard_streams.hpp"

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <exception>
#include <functional>
#ifdef __GLIBC__
#include <malloc.h>
#endif
#include <sstream>
#include <stdexcept>
#include <system_error>

using namespace plyform;

namespace {

void add_accuracy(CLI::App& app, CaseArguments& to) {
  app.add_option("--accuracy", to.accuracy,
                 "draft, standard or reference: shear angles to 3, 1 or 0.3 degrees, rms; picks "
                 "duration, fibre softening and up to 1.4 times larger elements; instant: each ply "
                 "alone between the tools, to about 4 degrees, without forces")
      ->check(CLI::IsMember({"instant", "draft", "standard", "reference"}));
}

void add_case_options(CLI::App& command, CaseArguments& to) {
  command.add_option("case", to.file, "case file, or the folder of a case.toml")->required();
  command.add_option("--set", to.settings, "KEY=VALUE: overrides any key of the case")
      ->allow_extra_args(false)
      ->take_all();
  command.add_flag("--yes-large", to.yes_large,
                   "go on though it takes more than half of the memory, or more than a day");
}

/// Arguments of all commands.
struct Arguments {
  RunArguments run;
  CaseArguments check;
  bool quick_check = false;
  ExportArguments results;
  DifferenceArguments difference{{}, {}, {"shear_angle_deg"}, false};
  IdentifyArguments identify;
  TheoryArguments theory;
  bool markdown = false;  ///< keys as a page
  bool keys_json = false; ///< keys for programs
  bool keys_identify = false;
  bool units = false; ///< units in the place of keys
  std::vector<std::string> families{"warp", "weft"};
};

/// A command, and the function that runs it after its arguments were parsed and returns the exit
/// code.
struct Command {
  CLI::App* app;
  std::function<int()> act;
};

/// A command that tools/SCRIPT does, with its own options and help.
CLI::App* add_script(CLI::App& app, std::vector<Command>& commands, const char* name,
                     const char* script, const char* what, bool with_program = false) {
  CLI::App* command = app.add_subcommand(name, what);
  command->prefix_command();
  command->set_help_flag();
  commands.push_back({command, [command, script, with_program] {
                        return script_command(script, command->remaining(), with_program);
                      }});
  return command;
}

void add_case_commands(CLI::App& app, Arguments& to, std::vector<Command>& commands) {
  CLI::App* run = app.add_subcommand("run", "form the plies of a case and write the results");
  add_case_options(*run, to.run.input);
  run->add_option("-o,--output", to.run.output, "folder for the results [results/NAME]");
  run->add_option("--threads", to.run.threads, "threads, at most; the results do not depend on it")
      ->check(CLI::Range(1, 256));
  run->add_flag("--report", to.run.report, "make report.html of the results, for any browser");
  run->add_flag("--resume", to.run.resume,
                "go on where this run was killed or interrupted, with the same results");
  run->add_option("--budget", to.run.budget,
                  "seconds: refuse a run that would take longer, and say what it would take")
      ->type_name("S")
      ->check(CLI::PositiveNumber);
  run->add_flag(
      "--verify", to.run.verify,
      "give each figure a band, from siblings of the case with coarser parameters; if the "
      "accuracy asked for was missed, run again once");
  add_accuracy(*run, to.run.input);
  commands.push_back({run, [&to] { return run_command(to.run); }});

  CLI::App* check =
      app.add_subcommand("check", "say what will be modelled, or every mistake in the case");
  add_case_options(*check, to.check);
  add_accuracy(*check, to.check);
  check->add_flag(
      "--quick", to.quick_check,
      "what reading, geometry and plies tell, without the run with coarse elements that "
      "mesh_from = \"scene\" takes");
  commands.push_back({check, [&to] { return check_command(to.check, to.quick_check); }});

  const char* study = "run a study of a case, as tools/study does";
  add_script(app, commands, "study", "study", study, true);
  add_script(app, commands, "chart", "study", study, true)->group(""); // its name in earlier builds
}

void add_keys(CLI::App& app, Arguments& to, std::vector<Command>& commands) {
  CLI::App* keys = app.add_subcommand("keys", "list every key of case and fabric files");
  keys->add_flag("--markdown", to.markdown, "as a page of tables");
  keys->add_flag("--json", to.keys_json, "for programs, with all that a form needs")
      ->excludes("--markdown");
  keys->add_flag("--units", to.units, "the units that columns and options of curves may be in")
      ->excludes("--markdown");
  keys->add_flag("--identify", to.keys_identify, "the tests of plyform identify, as JSON")
      ->excludes("--markdown")
      ->excludes("--units");
  commands.push_back({keys, [&to] {
                        if (!to.keys_identify)
                          return keys_command(to.markdown, to.keys_json, to.units);
                        plyform::fmt::print("{}\n", identify_tests_json());
                        return static_cast<int>(exit_done);
                      }});
}

void add_other_commands(CLI::App& app, Arguments& to, std::vector<Command>& commands) {
  add_script(app, commands, "report", "report", "make a page of a run, or two, for any browser");
  add_script(app, commands, "map", "map",
             "write the formed lay-up for the next program, on a part mesh or the plies' own");
  add_script(app, commands, "pattern", "pattern",
             "say where plies must be cut so that the formed part ends at its trim line", true);
  add_script(app, commands, "studio", "studio",
             "serve the workbench on a folder, for a browser of this machine", true);

  CLI::App* results = app.add_subcommand("export", "write states in other formats");
  results->add_option("results", to.results.results, "folder of a run")->required();
  results->add_option("--format", to.results.formats, "vtu, stl, csv, vtkhdf, gltf [vtu,stl,csv]")
      ->delimiter(',')
      ->check(CLI::IsMember({"vtu", "stl", "csv", "vtkhdf", "gltf"}));
  results->add_option("--frame", to.results.frame,
                      "number of a state, from 0, or all [last, in files without its number]");
  results->add_option("-o,--output", to.results.output, "folder for the files [DIR/export]");
  commands.push_back({results, [&to] { return export_command(to.results); }});

  CLI::App* difference = app.add_subcommand(
      "difference", "say how far the last state of a run is from that of another, on any meshes");
  difference->add_option("run", to.difference.run, "folder of a run")->required();
  difference->add_option("reference", to.difference.reference, "folder of the run to compare with")
      ->required();
  difference
      ->add_option("--field", to.difference.fields, "column of plies/NAME.csv; may be given again")
      ->allow_extra_args(false)
      ->take_all();
  difference->add_flag("--by-ply", to.difference.by_ply, "a line for each ply");
  commands.push_back({difference, [&to] { return difference_command(to.difference); }});

  CLI::App* identify =
      app.add_subcommand("identify", "turn a measured curve into a law of the fabric");
  add_identify_tests(*identify, to.identify);
  commands.push_back({identify, [&to] { return identify_command(to.identify); }});

  CLI::App* theory =
      app.add_subcommand("theory", "write the curve that a shear test of a fabric should give");
  add_theory_tests(*theory, to.theory);
  commands.push_back({theory, [&to] { return theory_command(to.theory); }});

  add_keys(app, to, commands);

  CLI::App* columns = app.add_subcommand("columns", "list the columns that results have of a ply");
  columns->add_option("families", to.families, "names of its families of yarns")
      ->capture_default_str();
  commands.push_back({columns, [&to] { return columns_command(to.families); }});

  CLI::App* print_version = app.add_subcommand("version", "print the version");
  commands.push_back({print_version, [] {
                        plyform::fmt::print("plyform {}\n", version());
                        return 0;
                      }});
}

/// The exit code, once everything that was printed has reached its end; else a message, and no code
/// of success.
int with_output_written(int code) {
  errno = 0;
  const bool flushed = std::fflush(stdout) == 0;
  const std::string reason =
      errno != 0 ? ": " + std::generic_category().message(errno) : std::string();
  if (flushed && std::ferror(stdout) == 0) return code;
  plyform::fmt::print(
      stderr,
      "plyform: error: standard output cannot be written{}; what was printed is not whole\n",
      reason);
  return code == exit_done ? exit_other : code;
}

int run_chosen(const std::vector<Command>& commands) {
  try {
    for (const Command& command : commands)
      if (command.app->parsed()) return command.act();
  } catch (const ScoutStopped& e) {
    plyform::fmt::print(stderr, "plyform: {}\n", printable(e.what()));
    return exit_stopped;
  } catch (const WouldOverwrite& e) {
    plyform::fmt::print(stderr, "plyform: error: {}\n", printable(e.what()));
    return exit_case_wrong;
  } catch (const std::invalid_argument& e) { // an option's value that a library refuses
    plyform::fmt::print(stderr, "plyform: error: {}\n", printable(e.what()));
    return exit_case_wrong;
  } catch (const std::exception& e) {
    // with_output_written tells of standard output, if that was it
    if (std::ferror(stdout) == 0)
      plyform::fmt::print(stderr, "plyform: error: {}\n", printable(e.what()));
  }
  return exit_other;
}

/// Lets freed memory stay with the process: searches need the same again, and pages that the kernel
/// gives anew are zeroed and faulted in one by one.
void keep_freed_memory() {
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, 32 << 20); // bytes, the largest that glibc takes
  mallopt(M_TRIM_THRESHOLD, 256 << 20);
#endif
}

} // namespace

int main(int argc, char** argv) {
  keep_freed_memory();
  prepare_standard_streams();
  CLI::App app{"Forms stacks of woven and non-crimp fabric plies between rigid tools."};
  app.require_subcommand(1);
  app.set_version_flag("--version", plyform::fmt::format("plyform {}", version()),
                       "print the version");
  app.footer("Exit codes: 0 done, 2 case, curve or options wrong, 3 the simulation stopped itself, "
             "1 else.");
  Arguments arguments;
  std::vector<Command> commands;
  add_case_commands(app, arguments, commands);
  add_other_commands(app, arguments, commands);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    std::ostringstream out, err;
    const int code = app.exit(e, out, err) == 0 ? exit_done : exit_case_wrong;
    std::fputs(out.str().c_str(), stdout);
    std::fputs(err.str().c_str(), stderr);
    return with_output_written(code);
  }
  return with_output_written(run_chosen(commands));
}
