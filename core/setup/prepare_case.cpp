// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/setup/prepare_case.hpp"

#include "core/accuracy/error_model.hpp"
#include "core/base/text.hpp"

#include <fmt/format.h>

namespace plyform {
namespace {

/// The dials that overrides have set, and their keys.
std::pair<FixedDials, std::vector<std::string>> dials_set(const std::set<std::string>& overridden) {
  FixedDials fixed;
  std::vector<std::string> keys;
  for (const std::string& key : overridden) {
    bool* dial = nullptr;
    if (key == "solver.duration") dial = &fixed.duration;
    if (key == "solver.fibre_softening") dial = &fixed.softening;
    if (key.starts_with("blanks.") && key.ends_with(".element_size")) dial = &fixed.element_size;
    if (!dial) continue;
    *dial = true;
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
    const auto [fixed, keys] = dials_set(reading.overridden);
    prepared.coarsening = pick_dials(*reading.value, fixed);
    if (reading.value->accuracy.shear_error > 0.0 && !keys.empty())
      prepared.notes.push_back(
          fmt::format("accuracy asked for: {} as set by hand, the other dials picked around {}",
                      joined(keys), keys.size() == 1 ? "it" : "them"));
    prepared.meshes = check_case(reading);
  }
  prepared.value = std::move(reading.value);
  prepared.errors = std::move(reading.errors);
  prepared.warnings = std::move(reading.warnings);
  return prepared;
}

} // namespace plyform
