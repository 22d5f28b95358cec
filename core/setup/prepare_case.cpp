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

PickedCase pick_case(const std::filesystem::path& file, const std::vector<Override>& overrides) {
  PickedCase picked;
  picked.reading = read_case(file, overrides);
  if (!picked.reading.value) return picked;
  const auto [fixed, keys] = parameters_set(picked.reading.overridden);
  picked.coarsening = pick_cost_parameters(*picked.reading.value, fixed);
  if (picked.reading.value->accuracy.shear_error > 0.0 && !keys.empty())
    picked.notes.push_back(
        fmt::format("accuracy asked for: {} as set by hand, the others picked around {}",
                    joined(keys), keys.size() == 1 ? "it" : "them"));
  return picked;
}

PreparedCase prepare_case(const std::filesystem::path& file,
                          const std::vector<Override>& overrides) {
  PickedCase picked = pick_case(file, overrides);
  PreparedCase prepared;
  if (picked.reading.value) prepared.meshes = check_case(picked.reading);
  prepared.value = std::move(picked.reading.value);
  prepared.coarsening = picked.coarsening;
  prepared.identity = std::move(picked.reading.identity);
  prepared.errors = std::move(picked.reading.errors);
  prepared.warnings = std::move(picked.reading.warnings);
  prepared.notes = std::move(picked.notes);
  return prepared;
}

} // namespace plyform
