// SPDX-License-Identifier: GPL-3.0-or-later
// plyform chart ...: a call of tools/study, with this program for the runs.
#include "tools/cli/commands.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <optional>
#include <unistd.h>

namespace plyform {
namespace {

namespace fs = std::filesystem;

/// Of the installation that the program stands in, or of the source tree that it was built in.
std::optional<fs::path> study_script(const fs::path& program) {
  for (fs::path folder = program.parent_path(); folder != folder.root_path();
       folder = folder.parent_path())
    for (const char* place : {"share/plyform/tools/study", "tools/study"})
      if (fs::is_regular_file(folder / place)) return folder / place;
  return std::nullopt;
}

} // namespace

int chart_command(const std::vector<std::string>& arguments) {
  const fs::path program = fs::read_symlink("/proc/self/exe");
  const std::optional<fs::path> script = study_script(program);
  if (!script) {
    fmt::print(stderr,
               "plyform: error: there is no tools/study in the folders around {}; install plyform "
               "whole, or call tools/study of the source tree\n",
               program.string());
    return exit_other;
  }
  std::vector<std::string> words{script->string(), "--program", program.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words)
    pointers.push_back(word.data());
  pointers.push_back(nullptr);
  execv(pointers.front(), pointers.data());
  fmt::print(stderr, "plyform: error: {} cannot be called: {}\n", script->string(),
             std::strerror(errno));
  return exit_other;
}

} // namespace plyform
