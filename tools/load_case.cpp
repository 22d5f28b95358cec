// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/case_file.hpp"
#include "tools/commands.hpp"

#include <filesystem>
#include <fmt/format.h>

namespace plyform {
namespace {

/// The dials that trade accuracy for time, as factors on what the case says.
void apply_accuracy(const std::string& accuracy, SolverOptions& solver) {
  if (accuracy == "draft") {
    solver.duration /= 2.0;
    solver.fibre_softening *= 2.0;
  } else if (accuracy == "reference") {
    solver.duration *= 2.0;
    solver.fibre_softening = std::max(1.0, solver.fibre_softening / 4.0);
  }
}

} // namespace

std::optional<Case> load_case(const CaseArguments& arguments) {
  std::filesystem::path file = arguments.file;
  if (std::filesystem::is_directory(file)) file /= "case.toml";
  std::vector<Override> overrides;
  for (const std::string& setting : arguments.settings) {
    const auto equals = setting.find('=');
    if (equals == std::string::npos || equals == 0) {
      fmt::print(stderr,
                 "--set:1:1: error: {}: is not KEY=VALUE; write for example --set ply.0.angle=30\n",
                 setting);
      return std::nullopt;
    }
    overrides.emplace_back(setting.substr(0, equals), setting.substr(equals + 1));
  }
  CaseReading reading = read_case(file, overrides);
  for (const std::string& warning : reading.warnings)
    fmt::print(stderr, "{}\n", warning);
  for (const CaseError& error : reading.errors)
    fmt::print(stderr, "{}\n", error.text());
  if (!reading.value) return std::nullopt;
  apply_accuracy(arguments.accuracy, reading.value->solver);
  return std::move(reading.value);
}

} // namespace plyform
