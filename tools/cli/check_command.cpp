// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/format.hpp"
#include "base/thread_pool.hpp"
#include "core/setup/outlook.hpp"
#include "tools/cli/commands.hpp"

#include <algorithm>
#include <cstdio>

namespace plyform {

namespace {

void print(const std::vector<std::string>& lines) {
  for (const std::string& line : lines)
    fmt::print("{}\n", line);
  std::fflush(stdout);
}

/// The lines of `now` that were not among those of before, each with the line of the part that it
/// is about.
std::vector<std::string> changes(const std::vector<std::string>& before,
                                 const std::vector<std::string>& now) {
  std::vector<std::string> changed;
  const std::string* part = nullptr; // not printed yet
  for (const std::string& line : now) {
    const bool of_part = line.starts_with("    ");
    if (!of_part) part = &line;
    if (std::find(before.begin(), before.end(), line) != before.end()) continue;
    if (of_part && part) changed.push_back(*part);
    part = nullptr;
    changed.push_back(line);
  }
  return changed;
}

bool is_warning(const std::string& line) {
  return line.starts_with("    warning: ");
}

} // namespace

int check_command(const CaseArguments& arguments, bool quick) {
  PreparedCase prepared = load_case(arguments);
  if (!prepared.value) return exit_case_wrong;
  const int threads = available_cores();
  SceneMesh mesh = load_meshes(arguments, prepared, threads, {.scouts = false});
  if (!prepared.value) return exit_case_wrong;
  if (mesh.unknown) fmt::print("with the largest elements throughout:\n");
  Outlook outlook = watched_outlook(prepared, threads, mesh.unknown);
  print(outlook.lines);
  if (mesh.unknown && quick) {
    fmt::print("smaller elements where the scene needs them, and their time, are told without "
               "--quick\n");
  } else if (mesh.unknown && outlook.stop.empty()) {
    mesh = load_meshes(arguments, prepared, threads, {});
    if (!prepared.value) return exit_case_wrong;
    const std::vector<std::string> before = std::move(outlook.lines);
    outlook = watched_outlook(prepared, threads);
    fmt::print("with the mesh from the scene:\n");
    print(changes(before, outlook.lines));
  }
  if (!outlook.stop.empty()) {
    fmt::print(stderr, "plyform: {}\n", outlook.stop);
    return exit_stopped;
  }
  const auto told = std::count_if(outlook.lines.begin(), outlook.lines.end(), is_warning);
  const auto warnings =
      static_cast<std::size_t>(told) + prepared.warnings.size() + mesh.warnings.size();
  if (warnings == 0)
    fmt::print("the case is sound\n");
  else
    fmt::print("the case is sound but for what {} warning{} {} of\n", warnings,
               warnings == 1 ? "" : "s", warnings == 1 ? "tells" : "tell");
  return exit_done;
}

} // namespace plyform
