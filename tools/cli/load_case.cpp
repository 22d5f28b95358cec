// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/format.hpp"
#include "core/accuracy/error_model.hpp"
#include "core/run/live_picture.hpp"
#include "core/run/progress_file.hpp"
#include "core/setup/outlook.hpp"
#include "core/setup/prepare_case.hpp"
#include "core/setup/size_ahead.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/ending_signals.hpp"
#include "tools/cli/progress_line.hpp"

#include <cmath>
#include <cstdio>
#include <filesystem>

namespace plyform {
PreparedCase load_case(const CaseArguments& arguments) {
  std::filesystem::path file = arguments.file;
  if (std::filesystem::is_directory(file)) file /= "case.toml";
  std::vector<Override> overrides;
  for (const std::string& setting : arguments.settings) {
    const auto equals = setting.find('=');
    if (equals == std::string::npos || equals == 0) {
      fmt::print(stderr,
                 "--set:1:1: error: {}: is not KEY=VALUE; write for example --set ply.0.angle=30\n",
                 setting);
      return {};
    }
    overrides.emplace_back(setting.substr(0, equals), setting.substr(equals + 1));
  }
  if (const double error = preset_error(arguments.accuracy); error > 0.0)
    overrides.emplace_back("accuracy.shear_deg", fmt::format("{}", error));
  if (arguments.accuracy == "instant") overrides.emplace_back("accuracy.instant", "true");
  PreparedCase prepared =
      prepare_case(file, overrides, arguments.yes_large ? CaseSize::any : CaseSize::sensible);
  for (const std::string& warning : prepared.warnings)
    fmt::print(stderr, "{}\n", warning);
  for (const CaseError& error : prepared.errors)
    fmt::print(stderr, "{}\n", error.text());
  return prepared;
}

SceneMesh load_meshes(const CaseArguments& arguments, PreparedCase& prepared, int threads,
                      const MeshingFor& whom) {
  ProgressLine line;
  ScoutHooks hooks;
  int scouting = 0;
  hooks.begins = [&](int run, const SizeAhead& ahead) {
    scouting = run;
    line.end();
    std::string words = "looking where small elements are needed: a fast run with coarse ones";
    if (run == 1)
      fmt::print("{}, {:.0f}, about {:.2g} s and {:.0f} MB\n", words, ahead.triangles,
                 ahead.seconds, std::ceil(ahead.bytes / 1e6));
    std::fflush(stdout);
    if (run > 1) words += fmt::format("; run {}, with smaller ones", run);
    if (whom.file) whom.file->begin(RunPhase::meshing, words);
  };
  hooks.progress = [&](const Progress& p) {
    line.show(p, "looking where small elements are needed");
    if (whom.file) whom.file->show(p, p.fraction, 0);
  };
  hooks.interrupt = &interrupted();
  if (LivePicture* picture = whom.picture)
    hooks.watch = {[=] { return picture->asked(); },
                   [&, picture](const Frame& f) { picture->draw(f, scouting); }};
  SceneMesh found =
      mesh_from_scene(prepared, threads,
                      {.known = whom.known, .kept = true, .scouts = whom.scouts, .scout = hooks});
  line.end();
  for (const CaseError& error : prepared.errors)
    fmt::print(stderr, "{}\n", error.text());
  if (!prepared.value) return found;
  if (!found.sizes.empty()) fmt::print("{}\n", prepared.notes.back());
  if (found.kept) fmt::print("found before, and kept\n");
  if (found.scouted)
    fmt::print("found with {:.2g} million element-steps in {:.1f} s\n", 1e-6 * found.scout_work,
               found.scout_seconds);
  std::fflush(stdout);
  for (const std::string& warning : found.warnings)
    fmt::print(stderr, "{}: warning: {}\n", arguments.file, warning);
  return found;
}

Outlook watched_outlook(const PreparedCase& prepared, int threads, bool mesh_to_come) {
  ProgressLine line;
  return look_ahead(
      prepared, threads,
      [&](const std::string& words, double fraction) { line.show(words, fraction); }, mesh_to_come);
}

} // namespace plyform
