// SPDX-License-Identifier: GPL-3.0-or-later
// The commands of plyform, one source file each. Each function NAME_command returns the exit code.
#pragma once

#include "core/setup/prepare_case.hpp"
#include "core/setup/scene_mesh.hpp"
#include "tools/identify/arguments.hpp"

#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace plyform {

class LivePicture;
class ProgressFile;
struct Outlook;

enum ExitCode { exit_done = 0, exit_other = 1, exit_case_wrong = 2, exit_stopped = 3 };

/// Command-line arguments that specify a case.
struct CaseArguments {
  std::string file;                  ///< case.toml, or its folder
  std::vector<std::string> settings; ///< KEY=VALUE
  bool yes_large = false;            ///< any size, however much memory and time it takes
  std::string accuracy;              ///< draft, standard, reference, or empty: that of the case
};

struct RunArguments {
  CaseArguments input;
  std::string output;
  int threads = 0;     ///< 0: the number of cores
  bool report = false; ///< make report.html of the results
  bool resume = false; ///< goes on from the folder's checkpoint
  bool verify = false; ///< runs siblings, for the bands of figures
  double budget = 0.0; ///< s; 0: any
};

struct DifferenceArguments {
  std::string run, reference;      ///< folders with results.h5
  std::vector<std::string> fields; ///< of triangles, by their names in results.h5
  bool by_ply = false;             ///< a line for each ply, in the place of one for all
};

struct ExportArguments {
  std::string results;              ///< folder with results.h5
  std::vector<std::string> formats; ///< empty: vtu, stl and csv
  std::string frame;                ///< a number, "all", or empty: the last, without its number
  std::string output;               ///< folder for the files; empty: results/export
};

/// prepare_case; prints warnings and errors to standard error. Has no value if there was an error.
PreparedCase load_case(const CaseArguments& arguments);

/// Who looks for meshes from the scene, beside the terminal.
struct MeshingFor {
  std::filesystem::path known = {}; ///< as of MeshRequest
  bool scouts = true;               ///< likewise
  ProgressFile* file = nullptr;     ///< of a run, kept
  LivePicture* picture = nullptr;   ///< likewise, drawn
};

/// mesh_from_scene; shows the progress of its scout, and prints errors to standard error, after
/// which the case has no value.
SceneMesh load_meshes(const CaseArguments& arguments, PreparedCase& prepared, int threads,
                      const MeshingFor& whom);

/// look_ahead; shows its progress.
Outlook watched_outlook(const PreparedCase& prepared, int threads, bool mesh_to_come = false);

int run_command(const RunArguments& arguments);
/// quick: without the run with coarse elements that a mesh from the scene takes.
int check_command(const CaseArguments& arguments, bool quick);
int export_command(const ExportArguments& arguments);
/// tools/cli/call_script.cpp. Calls tools/NAME; `with_program` tells it where plyform is. Returns
/// only if the script cannot be called.
int script_command(const std::string& name, const std::vector<std::string>& arguments,
                   bool with_program = false);
/// Makes folder/report.html and prints its path; false if that failed, for a reason then printed.
bool report_of_run(const std::string& folder);
int difference_command(const DifferenceArguments& arguments);
int keys_command(bool markdown, bool json, bool units);
int columns_command(const std::vector<std::string>& families);
/// Prints warnings, then errors; returns whether there are errors.
bool print_diagnostics(const Diagnostics& diagnostics);
int identify_command(const IdentifyArguments& arguments);
int theory_command(const TheoryArguments& arguments);

/// tools/cli/identify_options.cpp: adds a subcommand for each test, with its options,
/// which store to `to`; that must live as long as the apps.
void add_identify_tests(CLI::App& command, IdentifyArguments& to);
void add_theory_tests(CLI::App& command, TheoryArguments& to);

} // namespace plyform
