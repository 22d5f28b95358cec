// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/setup/prepare_case.hpp"

#include "core/accuracy/error_model.hpp"
#include "core/base/text.hpp"

#include <fmt/format.h>

namespace plyform {
namespace {

/// Which cost parameters overrides have set, and the keys of these overrides.
std::pair<FixedParameters, std::vector<std::string>>
parameters_set(const std::set<std::string>& overridden) {
  FixedParameters fixed;
  std::vector<std::string> keys;
  for (const std::string& key : overridden) {
    bool* parameter = nullptr;
    if (key == "solver.duration") parameter = &fixed.duration;
    if (key == "solver.fibre_softening") parameter = &fixed.softening;
    if (key.starts_with("blanks.") && key.ends_with(".element_size"))
      parameter = &fixed.element_size;
    if (!parameter) continue;
    *parameter = true;
    keys.push_back(key);
  }
  return {fixed, keys};
}

} // namespace

PreparedCase prepare_case(const std::filesystem::path& file,
                          const std::vector<Override>& overrides) {
  CaseReading reading = read_case(file, overrides);
  PreparedCase prepared;
  if (reading.value) {
    const auto [fixed, keys] = parameters_set(reading.overridden);
    prepared.coarsening = pick_cost_parameters(*reading.value, fixed);
    if (reading.value->accuracy.shear_error > 0.0 && !keys.empty())
      prepared.notes.push_back(
          fmt::format("accuracy asked for: {} as set by hand, the others picked around {}",
                      joined(keys), keys.size() == 1 ? "it" : "them"));
    prepared.meshes = check_case(reading);
  }
  prepared.value = std::move(reading.value);
  prepared.errors = std::move(reading.errors);
  prepared.warnings = std::move(reading.warnings);
  return prepared;
}

} // namespace plyform
