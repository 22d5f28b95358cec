// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/format.hpp"
#include "base/thread_pool.hpp"
#include "core/setup/outlook.hpp"
#include "tools/cli/commands.hpp"

#include <algorithm>

namespace plyform {

namespace {

// Triangles times steps that looking for a mesh may take here, about half a minute of one core: a
// check answers at once, and a run may take its time.
constexpr double most_work = 6e7;

} // namespace

int check_command(const CaseArguments& arguments) {
  PreparedCase prepared = load_case(arguments);
  if (!prepared.value) return exit_case_wrong;
  const SceneMesh mesh =
      load_meshes(arguments, prepared, available_cores(), {.most_work = most_work});
  if (!prepared.value) return exit_case_wrong;
  if (!mesh.not_known.empty()) {
    prepared.warnings.push_back(mesh.not_known);
    fmt::print(stderr, "{}: warning: {}\n", arguments.file, mesh.not_known);
    fmt::print("with the largest elements throughout:\n");
  }
  const Outlook outlook = watched_outlook(prepared, available_cores());
  for (const std::string& line : outlook.lines)
    fmt::print("{}\n", line);
  if (!outlook.stop.empty()) {
    fmt::print(stderr, "plyform: {}\n", outlook.stop);
    return exit_stopped;
  }
  const auto told =
      std::count_if(outlook.lines.begin(), outlook.lines.end(),
                    [](const std::string& line) { return line.starts_with("    warning: "); });
  const auto warnings = static_cast<std::size_t>(told) + prepared.warnings.size();
  if (warnings == 0)
    fmt::print("the case is sound\n");
  else
    fmt::print("the case is sound but for what {} warning{} {} of\n", warnings,
               warnings == 1 ? "" : "s", warnings == 1 ? "tells" : "tell");
  return exit_done;
}

} // namespace plyform
