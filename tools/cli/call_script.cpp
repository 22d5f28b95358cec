// SPDX-License-Identifier: GPL-3.0-or-later
// Calls of the Python programs tools/study, studio, report, map, pattern and export.
#include "base/format.hpp"
#include "tools/cli/commands.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <optional>
#include <sys/wait.h>
#include <unistd.h>

namespace plyform {
namespace {

namespace fs = std::filesystem;

/// Of the installation that the program stands in, or of the source tree that it was built in.
std::optional<fs::path> find_script(const std::string& name) {
  const fs::path program = fs::read_symlink("/proc/self/exe");
  for (fs::path folder = program.parent_path(); folder != folder.root_path();
       folder = folder.parent_path())
    for (const char* place : {"share/plyform/tools", "tools"})
      if (fs::is_regular_file(folder / place / name)) return folder / place / name;
  fmt::print(stderr,
             "plyform: error: there is no tools/{} in the folders around {}; install plyform "
             "whole, or call tools/{} of the source tree\n",
             name, program.string(), name);
  return std::nullopt;
}

/// Returns only if the script cannot be called.
int become(const fs::path& script, const std::vector<std::string>& arguments) {
  std::vector<std::string> words{script.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words)
    pointers.push_back(word.data());
  pointers.push_back(nullptr);
  execv(pointers.front(), pointers.data());
  fmt::print(stderr, "plyform: error: {} cannot be called: {}\n", script.string(),
             std::strerror(errno));
  return exit_other;
}

} // namespace

int script_command(const std::string& name, const std::vector<std::string>& arguments,
                   bool with_program) {
  const std::optional<fs::path> script = find_script(name);
  if (!script) return exit_other;
  std::vector<std::string> words;
  if (with_program) words = {"--program", fs::read_symlink("/proc/self/exe").string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return become(*script, words);
}

bool report_of_run(const std::string& folder) {
  const std::optional<fs::path> script = find_script("report");
  if (!script) return false;
  std::fflush(nullptr); // or the child would print it again
  const pid_t child = fork();
  if (child < 0) {
    fmt::print(stderr, "plyform: error: {} cannot be called: {}\n", script->string(),
               std::strerror(errno));
    return false;
  }
  if (child == 0) _exit(become(*script, {folder}));
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

} // namespace plyform
