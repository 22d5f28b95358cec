// SPDX-License-Identifier: GPL-3.0-or-later
// plyform for cases/studies/stability, but with numbers beyond what the keys of a case allow: a
// step longer than the stable one, contacts stiffer or more damped than a case may have.
//   unbounded_run run|check CASE [--set KEY=VALUE]... [-o FOLDER] [--threads N]
//   unbounded_run keys|version
// Exit codes as of plyform: 0 done, 2 the case is wrong, 3 the simulation stopped itself.
#include "base/version.hpp"
#include "core/run/run.hpp"
#include "core/setup/prepare_case.hpp"
#include "tools/cli/commands.hpp"

#include <cstdio>
#include <exception>
#include <map>

using namespace plyform;

namespace {

/// The numbers that may be out of range, and where they stand.
double* unbounded(Case& data, const std::string& key) {
  const std::map<std::string, double*> known{{"solver.step_factor", &data.solver.step_factor},
                                             {"contact.stiffness", &data.contact.stiffness},
                                             {"contact.damping", &data.contact.damping}};
  const auto found = known.find(key);
  return found == known.end() ? nullptr : found->second;
}

struct Arguments {
  std::filesystem::path file, folder;
  int threads = 1;
  std::vector<Override> settings;                     ///< as plyform takes them
  std::vector<std::pair<std::string, double>> beyond; ///< of the keys that may be out of range
};

Arguments read_arguments(const std::vector<std::string>& words) {
  Arguments read;
  read.file = words.at(1);
  if (std::filesystem::is_directory(read.file)) read.file /= "case.toml";
  Case unused;
  for (std::size_t i = 2; i + 1 < words.size(); i += 2) {
    const std::string& value = words[i + 1];
    if (words[i] == "-o") {
      read.folder = value;
    } else if (words[i] == "--threads") {
      read.threads = std::stoi(value);
    } else if (const auto equals = value.find('=');
               words[i] == "--set" && equals != std::string::npos) {
      const std::string key = value.substr(0, equals), text = value.substr(equals + 1);
      if (unbounded(unused, key))
        read.beyond.emplace_back(key, std::stod(text));
      else
        read.settings.emplace_back(key, text);
    } else {
      throw std::runtime_error(words[i] + " " + value + " is not understood");
    }
  }
  return read;
}

int run_or_check(const std::vector<std::string>& words) {
  const Arguments read = read_arguments(words);
  PreparedCase prepared = prepare_case(read.file, read.settings);
  for (const CaseError& error : prepared.errors)
    std::fprintf(stderr, "%s\n", error.text().c_str());
  if (!prepared.value) return exit_case_wrong;
  if (words[0] == "check") return exit_done;
  for (const auto& [key, value] : read.beyond)
    *unbounded(*prepared.value, key) = value;
  ResultWriter writer(read.folder);
  RunHooks hooks;
  hooks.frame = [&](const Frame& frame) { writer.write_frame(frame); };
  const RunResult result = run_case(*prepared.value, read.threads, hooks);
  writer.write_final(result.last, result.summary);
  return ended(result.summary.status) ? exit_done : exit_stopped;
}

} // namespace

int main(int count, char** arguments) {
  const std::vector<std::string> words(arguments + 1, arguments + count);
  const std::string command = words.empty() ? "" : words[0];
  try {
    if (command == "keys") return keys_command(false, false, false);
    if (command == "version") return std::printf("unbounded plyform %s\n", version()) > 0 ? 0 : 1;
    if ((command == "run" || command == "check") && words.size() > 1) return run_or_check(words);
    std::fprintf(stderr, "unbounded_run run|check CASE [--set KEY=VALUE]... [-o FOLDER] "
                         "[--threads N], or keys, or version\n");
    return exit_case_wrong;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "unbounded_run: %s\n", error.what());
    return exit_other;
  }
}
