// SPDX-License-Identifier: GPL-3.0-or-later
// What the sources of identification share.
#pragma once

#include "core/identify/bending_tests.hpp"
#include "core/identify/fit_shear.hpp"
#include "core/identify/fit_tension.hpp"
#include "core/input/parts/fabric_file.hpp"
#include "tools/identify/arguments.hpp"

#include <filesystem>
#include <optional>

namespace plyform {

/// A number of a law, with the half width of its 95 % limits; NaN where they are not known.
struct LawNumber {
  std::string name, unit;
  double value = 0.0, limits = 0.0;
};

/// An identified law as text for the report and the fabric file.
struct Identified {
  std::string title;                 ///< "shear law"
  std::vector<LawText> laws;         ///< without comments
  std::vector<std::string> provides; ///< those of warp, weft, shear that have a law now
  std::string fit;                   ///< CSV
  std::string law_line;              ///< for the report
  std::vector<std::string> figures;  ///< range, residuals, limits: for the report and the file
  std::vector<std::string> notes;    ///< for the report only
  std::vector<LawNumber> numbers;    ///< of the law and its residuals, for programs
};

/// tools/identify/identify_arguments.cpp
void option_error(const std::string& option, const std::string& value, const std::string& rule,
                  const std::string& remedy, Diagnostics& diagnostics);
/// Reports an error if an output file is one of the other files read or written, or if its
/// temporary name is.
void check_output(const std::string& option, const std::filesystem::path& output,
                  const std::vector<std::filesystem::path>& others, Diagnostics& diagnostics);
/// The test of the arguments; reports errors and returns nothing if its sizes are invalid.
std::optional<ShearTest> test_of(const std::string& name, const SpecimenArguments& sizes,
                                 Diagnostics& diagnostics);
/// Reads the fabric; its errors are added to `diagnostics`.
FabricReading fabric_of(const std::string& file, bool for_shear, Diagnostics& diagnostics);
bool is_shear_test(const std::string& test);   ///< bias, frame
bool is_tension_test(const std::string& test); ///< warp, weft, compression
/// Checks the arguments before a curve is read.
void check_arguments(const IdentifyArguments& arguments, const std::filesystem::path& fit,
                     Diagnostics& diagnostics);
/// Corrections as the user gives them; errors are reported.
FitOptions fit_options(const IdentifyArguments& arguments, Diagnostics& diagnostics);
/// --angle-column none: although there may be a column of angles.
bool extension_counts(const IdentifyArguments& arguments);
CantileverReading reading_of(const IdentifyArguments& arguments);
CurveColumns columns_of(const IdentifyArguments& arguments);
/// "bias-extension test, 300 x 100 mm, equation (40) read backwards".
std::string test_words(const IdentifyArguments& arguments);

/// tools/identify/identify_report.cpp
/// What has been taken off a curve; empty if nothing. `unit` of its x: " mm".
std::string corrections_text(const Corrected& corrected, const std::string& unit);
std::string confidence_text(const std::string& of_coefficients, const std::string& law,
                            const Confidence& confidence, const std::string& at,
                            std::size_t specimens);
/// What each disturbance would do to the law, of the specimen that it moves most.
std::string sensitivity_text(const std::vector<SpecimenLaw>& specimens, const std::string& length,
                             bool displacement, bool stretch);
/// tools/identify/identify_curves.cpp
/// A curve as named on the command line: FILE, FILE:COLUMN or NAME=FILE:COLUMN, where FILE is one
/// and the whole text is not.
struct CurveArgument {
  std::string file, column, laboratory;
  std::string name() const; ///< without folders
};
CurveArgument curve_argument(const std::string& text);
/// The curves; errors are reported.
std::vector<Curve> curves_of(const IdentifyArguments& arguments, Diagnostics& diagnostics);
/// A shear test with what has been assumed of its curves.
struct PreparedShear {
  ShearTest test;
  std::vector<std::string> assumed; ///< for report and file
};
/// Decides whether measured angles count and makes loads of normalised forces; reports errors and
/// returns nothing if the test's sizes are invalid or missing.
std::optional<PreparedShear> prepare_shear(const IdentifyArguments& arguments,
                                           std::vector<Curve>& curves, FitOptions& options,
                                           Diagnostics& diagnostics);

/// What slip does to the law, or may do: lines for the report.
std::vector<std::string> slip_lines(const IdentifyArguments& arguments,
                                    const std::vector<Curve>& curves, const PreparedShear& test,
                                    const Fabric& fabric, const FitOptions& options,
                                    const ShearFit& fit);
/// Names of the curves, without folders.
std::string files_of(const IdentifyArguments& arguments);

/// tools/identify/identify_laboratories.cpp
/// Its name, else its column's, else its file's.
std::string laboratory_of(const CurveArgument& argument);
/// Whether each curve is of a laboratory, not of a specimen.
bool are_laboratories(const IdentifyArguments& arguments);
/// Writes the three fabric files and the table; returns what it says of them, or nothing.
std::optional<std::string>
identify_laboratories(const IdentifyArguments& arguments, const std::filesystem::path& table,
                      const FabricReading& base, const PreparedShear& test,
                      const std::vector<Curve>& curves, const FitOptions& options,
                      Diagnostics& diagnostics);

/// tools/identify/identify_report.cpp
Identified shear_text(const ShearFit& fit);
Identified tension_text(const TensionFit& fit, const IdentifyArguments& arguments);
Identified compression_text(const CompressionFit& fit, const IdentifyArguments& arguments);
/// tools/identify/identify_groups.cpp: specimens of two kinds, `others` those of negative shear
/// angles or along the weft; or of a fabric with stitches, whose loads are taken off.
bool has_groups(const IdentifyArguments& arguments, const Fabric& fabric);
std::optional<Identified> identify_groups(const IdentifyArguments& arguments,
                                          const FabricReading& base,
                                          const std::optional<PreparedShear>& prepared,
                                          const std::vector<Curve>& curves,
                                          const std::vector<Curve>& others,
                                          const FitOptions& options, Diagnostics& diagnostics);
/// Checks what of the arguments is about two kinds of specimens.
void check_groups(const IdentifyArguments& arguments, const FabricReading& base,
                  Diagnostics& diagnostics);
/// tools/identify/identify_biaxial.cpp: reads the curves and finds yarns and crimps.
std::optional<Identified> identify_biaxial_files(const IdentifyArguments& arguments,
                                                 const Fabric& fabric, Diagnostics& diagnostics);
/// tools/identify/identify_bending.cpp
Identified bending_text(const BendingFit& fit, const IdentifyArguments& arguments);
Identified zone_text(const ZoneFit& fit, const IdentifyArguments& arguments);
/// "warp", "weft", or both.
std::vector<std::string> families_of(const std::string& direction);
std::string figure_of_residuals(const FitQuality& quality, const std::string& at);
/// Rows and residuals (%), beside the numbers of the law.
void put_quality(const FitQuality& quality, Identified& result);
/// tools/identify/identify_json.cpp: writes arguments.report; `result` is missing where the
/// curve is refused.
void write_report(const IdentifyArguments& arguments, const std::string& fit_file,
                  const FabricReading& base, const std::optional<Identified>& result,
                  const Diagnostics& diagnostics);

} // namespace plyform
