// SPDX-License-Identifier: GPL-3.0-or-later
// plyform run for tools/stability_map.py, but with numbers beyond what the keys of a case allow: a
// step longer than the stable one, contacts stiffer or more damped than a case may have.
//   unbounded_run CASE.toml FOLDER [KEY=VALUE]...
// Exit codes as of plyform: 0 done, 2 the case is wrong, 3 the simulation stopped itself.
#include "core/setup/prepare_case.hpp"
#include "core/solver/run.hpp"

#include <cstdio>
#include <cstdlib>
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

int run(int count, char** arguments) {
  std::vector<Override> settings;
  std::vector<std::pair<std::string, double>> beyond;
  Case unused;
  for (int i = 3; i < count; ++i) {
    const std::string setting = arguments[i];
    const auto equals = setting.find('=');
    if (equals == std::string::npos) throw std::runtime_error(setting + " is not KEY=VALUE");
    const std::string key = setting.substr(0, equals), value = setting.substr(equals + 1);
    if (unbounded(unused, key))
      beyond.emplace_back(key, std::stod(value));
    else
      settings.emplace_back(key, value);
  }
  PreparedCase reading = prepare_case(arguments[1], settings);
  for (const CaseError& error : reading.errors)
    std::fprintf(stderr, "%s\n", error.text().c_str());
  if (!reading.value) return 2;
  for (const auto& [key, value] : beyond)
    *unbounded(*reading.value, key) = value;
  ResultWriter writer(arguments[2]);
  RunHooks hooks;
  hooks.frame = [&](const Frame& frame) { writer.write_frame(frame); };
  const RunResult result = run_case(*reading.value, 1, hooks);
  writer.write_final(result.last, result.summary);
  return ended(result.summary.status) ? 0 : 3;
}

} // namespace

int main(int count, char** arguments) {
  if (count < 3) {
    std::fprintf(stderr, "unbounded_run CASE.toml FOLDER [KEY=VALUE]...\n");
    return 1;
  }
  try {
    return run(count, arguments);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "unbounded_run: %s\n", error.what());
    return 1;
  }
}
