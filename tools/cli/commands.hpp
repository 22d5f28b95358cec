// SPDX-License-Identifier: GPL-3.0-or-later
// The commands of plyform, one source file each. Each function NAME_command returns the exit code.
#pragma once

#include "core/setup/prepare_case.hpp"
#include "core/setup/scene_mesh.hpp"

#include <limits>
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

/// A shear test: bias or frame; NaN where not given.
struct SpecimenArguments {
  double length = std::numeric_limits<double>::quiet_NaN(); ///< mm, bias
  double width = std::numeric_limits<double>::quiet_NaN();  ///< mm, bias, three-point
  double side = std::numeric_limits<double>::quiet_NaN();   ///< mm, frame
  double span = std::numeric_limits<double>::quiet_NaN();   ///< mm, three-point
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

/// A column of a curve: name or number, and the unit in the place of the header's.
struct ColumnArguments {
  std::string name, unit;
};

struct IdentifyArguments {
  std::string test; ///< bias, frame, warp, weft, biaxial, compression, cantilever, three-point ...
  std::vector<std::string> curves; ///< one for each specimen
  std::vector<std::string> others; ///< of specimens of the other sign, or along the weft
  std::string stitch;              ///< that the two signs of shear differ by
  ColumnArguments x, y, angle;
  std::string angle_file; ///< FILE or FILE:COLUMN: angles over displacements
  std::string fabric, output, fit;
  std::string report; ///< JSON file, or empty
  SpecimenArguments specimen;
  std::optional<int> coefficients, points; ///< of a polynomial, of a table of shear
  /// The form, as the test's choices have it; empty: chosen.
  std::string law;
  double from = 0.0, to = std::numeric_limits<double>::infinity(); ///< degrees, strain, or share
  double yarns = 1.0, gauge_length = 1.0;                          ///< -, mm
  double layers = 1.0;                                             ///< of a compaction test
  std::string compliance, zero, toe,
      slip;                      ///< numbers (mm/N, N, mm or strain), or fit; empty: not given
  std::string direction;         ///< warp, weft or both
  std::string reading = "angle"; ///< of a cantilever: angle or deflection
  bool doubtful = false;
  bool laboratories = false; ///< each curve is of one, not of a specimen; or NAME=FILE says so
  bool skip_refused = false; ///< laboratories: goes on without curves that are refused
  double warp_yarns = 1.0;   ///< of a biaxial test
  std::optional<double> weft_yarns; ///< of it, or of the others; not given: as the warp
  // Of what depends on rates, one number a curve:
  std::vector<double> speeds, pressures; ///< mm/s, N/mm^2
  std::vector<double> temperatures;      ///< degC
  std::string temperature_law;           ///< arrhenius, wlf, table; empty: by the rows
  std::vector<double> viscosities;       ///< Pa s; one a curve, or one
  std::optional<int> viscosity_coefficients;
  double area = 0.0;                   ///< mm^2, of a pull-out test
  std::string name = "pull_out";       ///< of the law of friction in a case
  double stop_angle = 0.0, ramp = 0.0; ///< degrees, s; of relaxation
  std::vector<double> times;           ///< s, of its branches; empty: looked for
};

struct TheoryArguments {
  std::string test; ///< bias or frame
  std::string fabric, output;
  SpecimenArguments specimen;
  double to = 0.0; ///< degrees
  int points = 100;
  bool negative = false; ///< shear angles below 0
};

/// prepare_case; prints warnings and errors to standard error. Has no value if there was an error.
PreparedCase load_case(const CaseArguments& arguments);

/// Who looks for meshes from the scene, beside the terminal.
struct MeshingFor {
  std::filesystem::path known = {};                           ///< as of mesh_from_scene
  ProgressFile* file = nullptr;                               ///< of a run, kept
  LivePicture* picture = nullptr;                             ///< likewise, drawn
  double most_work = std::numeric_limits<double>::infinity(); ///< as of ScoutHooks
};

/// mesh_from_scene; shows the progress of its scout, and prints errors to standard error, after
/// which the case has no value.
SceneMesh load_meshes(const CaseArguments& arguments, PreparedCase& prepared, int threads,
                      const MeshingFor& whom);

/// look_ahead; shows its progress.
Outlook watched_outlook(const PreparedCase& prepared, int threads);

int run_command(const RunArguments& arguments);
int check_command(const CaseArguments& arguments);
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
int identify_command(const IdentifyArguments& arguments);
int theory_command(const TheoryArguments& arguments);

/// tools/cli/identify/identify_options.cpp: adds a subcommand for each test, with its options,
/// which store to `to`; that must live as long as the apps.
void add_identify_tests(CLI::App& command, IdentifyArguments& to);
/// The tests with their options, for programs.
std::string identify_tests_json();
void add_theory_tests(CLI::App& command, TheoryArguments& to);

} // namespace plyform
