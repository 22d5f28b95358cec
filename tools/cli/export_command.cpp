// SPDX-License-Identifier: GPL-3.0-or-later
// plyform export: VTU, STL and CSV by the library, VTKHDF and glTF by the Python program
// tools/export.
#include "base/format.hpp"
#include "core/results/export.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/progress_line.hpp"

#include <algorithm>
#include <charconv>
#include <cstdio>

namespace plyform {

int export_command(const ExportArguments& arguments) {
  const std::vector<std::string>& formats = arguments.formats;
  const auto asked = [&](const char* name) {
    return std::find(formats.begin(), formats.end(), name) != formats.end();
  };
  ExportChoice choice;
  if (!formats.empty()) choice = {asked("vtu"), asked("stl"), asked("csv"), false, {}, {}, {}};
  choice.folder = arguments.output;
  choice.all = arguments.frame == "all";
  if (!choice.all && !arguments.frame.empty()) {
    const char* end = arguments.frame.data() + arguments.frame.size();
    long frame = 0;
    const auto [stop, error] = std::from_chars(arguments.frame.data(), end, frame);
    if (error != std::errc() || stop != end || frame < -1) {
      fmt::print(stderr, "plyform: error: --frame {}: a number from 0, -1 for the last, or all\n",
                 arguments.frame);
      return exit_case_wrong;
    }
    choice.frame = frame;
  }
  if (choice.vtu || choice.stl || choice.csv) {
    ProgressLine line;
    choice.progress = [&](double fraction) { line.show("writes states", fraction); };
    const auto files = export_results(arguments.results, choice);
    line.end();
    for (const auto& file : files)
      fmt::print("{}\n", file.string());
  }
  std::string others;
  for (const char* name : {"vtkhdf", "gltf"})
    if (asked(name)) others += fmt::format("{}{}", others.empty() ? "" : ",", name);
  if (others.empty()) return exit_done;
  std::fflush(nullptr); // the script prints after it
  std::vector<std::string> words{arguments.results, "--format", others};
  if (!arguments.frame.empty()) words.push_back(fmt::format("--frame={}", arguments.frame));
  if (!arguments.output.empty()) words.push_back(fmt::format("--output={}", arguments.output));
  return script_command("export", words);
}

} // namespace plyform
