// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/setup/prepare_case.hpp"

#include "base/format.hpp"
#include "base/text.hpp"
#include "base/thread_pool.hpp"
#include "core/input/checks/unit_checks.hpp"
#include "core/model/motion.hpp"
#include "core/setup/instant.hpp"
#include "core/setup/part_of_scene.hpp"
#include "core/setup/size_ahead.hpp"

#include <cmath>

namespace plyform {
namespace {

std::string duration_text(double seconds) {
  if (seconds > 2.0 * 86400.0) return fmt::format("{:.2g} days", seconds / 86400.0);
  return seconds > 7200.0 ? fmt::format("{:.2g} hours", seconds / 3600.0)
                          : fmt::format("{:.2g} minutes", seconds / 60.0);
}

/// Refuses a case that would take more memory or time than anybody has asked for knowingly.
void check_size(CaseReading& reading) {
  const SizeAhead size = size_ahead(*reading.value, available_cores());
  const double memory = machine_memory();
  if (!too_large(size, memory)) return;
  const SourceLocation& blank = reading.parts.blanks[static_cast<std::size_t>(size.largest)];
  reading.errors.push_back(
      {blank.at.file, blank.at.line, blank.at.column, blank.item + ".element_size",
       fmt::format("{:g}",
                   reading.value->blanks[static_cast<std::size_t>(size.largest)].element_size),
       fmt::format("makes {:.2g} triangles of all plies: about {:.2g} GB of memory, of {:.2g} GB "
                   "here, and {} of computing",
                   size.triangles, size.bytes / 1e9, memory / 1e9, duration_text(size.seconds)),
       "choose larger elements, a shorter solver.duration or more solver.fibre_softening, or go on "
       "with --yes-large"});
  reading.value.reset();
}

/// Refuses meshes whose triangles, or the smallest of them, would take as much.
std::optional<CaseError> fault_of_meshes(const Case& data, const std::vector<BlankMesh>& meshes,
                                         const CaseParts& parts) {
  const SizeAhead size = size_of_meshes(data, meshes, available_cores());
  const double memory = machine_memory();
  if (!too_large(size, memory)) return std::nullopt;
  const SourceLocation& blank = parts.blanks[at(data.plies[size.ply].blank)];
  return CaseError{
      blank.at.file,
      blank.at.line,
      blank.at.column,
      blank.item,
      "",
      fmt::format(
          "has triangles in its mesh with a height of {:.2g} mm, at ({:.4g}, {:.4g}): about "
          "{:.2g} steps of {:.0f} triangles, {} of computing and {:.2g} GB of memory",
          size.smallest, size.where.x(), size.where.y(), size.steps, size.triangles,
          duration_text(size.seconds), size.bytes / 1e9),
      "take what is so small out of the outline (a hole?) or its zones, give larger "
      "elements, "
      "a shorter solver.duration or more solver.fibre_softening, or go on with --yes-large"};
}

/// Replaces what is said of a scene that cannot work by what is at its bottom: a body in another
/// unit.
void blame(const UnitSuspicion& unit, CaseReading& reading) {
  const Place& at = unit.at.at;
  reading.errors = {{at.file, at.line, at.column, unit.at.item, unit.name, unit.rule, unit.remedy}};
  reading.value.reset();
}

void add_warning(CaseReading& reading, const Place& at, const std::string& text) {
  Diagnostics told; // which makes it printable
  told.warning(at, text);
  reading.warnings.push_back(std::move(told.warnings.front()));
}

/// Says beside all else that a body may be in another unit. Numbers of the case file are in mm, so
/// that what is wrong with their scene may be something else.
void warn_of(const UnitSuspicion& unit, CaseReading& reading) {
  add_warning(reading, unit.at.at,
              fmt::format("{}{}: {}; {}", unit.at.item, unit.name.empty() ? "" : " = " + unit.name,
                          unit.rule, unit.remedy));
}

/// Checks size and scene, and whether a body in another unit is behind what is wrong with them.
std::vector<BlankMesh> check_scene_and_units(CaseReading& reading, CaseSize size) {
  std::optional<UnitSuspicion> unit = suspect_unit(*reading.value, reading.parts, false);
  if (unit && unit->is_drawing) { // nobody waits for the mesh of a blank of 8 m
    blame(*unit, reading);
    return {};
  }
  const Case before = *reading.value;
  std::vector<BlankMesh> meshes;
  if (size == CaseSize::sensible) check_size(reading);
  if (reading.value) meshes = check_case(reading);
  if (reading.value && size == CaseSize::sensible)
    if (auto fault = fault_of_meshes(*reading.value, meshes, reading.parts)) {
      reading.errors.push_back(std::move(*fault));
      reading.value.reset();
    }
  const bool broken = !reading.value;
  if (broken && !unit) unit = suspect_unit(before, reading.parts, true);
  if (!unit) return meshes;
  if (broken && unit->from_file)
    blame(*unit, reading);
  else
    warn_of(*unit, reading);
  return meshes;
}

/// Warns of a stroke so fast, or fibres so soft, that no shape comes out that means anything.
void check_prediction(CaseReading& reading) {
  constexpr double most = 10.0, good = 3.0; // degrees: a third of what parts are sheared; a draft
  const PredictedError error = predicted_error(*reading.value);
  if (std::isinf(error.inertia) || std::isinf(error.softening)) {
    const SourceLocation& solver = reading.parts.solver;
    reading.errors.push_back(
        {solver.at.file, solver.at.line, solver.at.column, "solver.duration",
         fmt::format("{:g}", reading.value->solver.duration),
         "is none in which these fabrics could be formed: they have no stiffness to speak of, or "
         "no time",
         "check stiffness and shear of the fabrics, or give a solver.duration without asking for "
         "an "
         "accuracy"});
    return reading.value.reset();
  }
  if (!(std::hypot(error.inertia, error.softening) > most)) return;
  const bool fast = error.inertia > error.softening;
  const std::string remedy =
      fast ? fmt::format("give a solver.duration of {:.2g} s or more", // falls with the third power
                         reading.value->solver.duration * std::cbrt(error.inertia / good))
           : std::string("give less solver.fibre_softening");
  add_warning(
      reading, reading.parts.solver.at,
      fmt::format("shear angles would be off by more than {:g} degrees, as predicted: {}; {}", most,
                  fast ? fmt::format("in {:g} s plies are thrown, not formed",
                                     reading.value->solver.duration)
                       : std::string("the fibres are too soft"),
                  remedy));
}

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

/// Refuses an instant answer where there is none.
void check_instant(PreparedCase& prepared) {
  const std::string reason = not_for_plies_alone(*prepared.value);
  if (reason.empty()) return;
  const SourceLocation& solver = prepared.parts.solver;
  prepared.errors.push_back({solver.at.file, solver.at.line, solver.at.column, "accuracy.instant",
                             "true",
                             "forms each ply alone, which says nothing of this case: " + reason,
                             "take --accuracy draft, or none"});
  prepared.value.reset();
}

} // namespace

PickedCase pick_case(const std::filesystem::path& file, const std::vector<Override>& overrides) {
  PickedCase picked;
  picked.reading = read_case(file, overrides);
  if (!picked.reading.value) return picked;
  const auto [fixed, keys] = parameters_set(picked.reading.overridden);
  picked.fixed = fixed;
  if (picked.reading.value->accuracy.shear_error > 0.0) {
    if (longest_strokes(*picked.reading.value).longest() == 0.0 &&
        picked.reading.value->loads.empty())
      picked.notes.emplace_back("accuracy asked for: it does nothing, since nothing is driven by a "
                                "stroke, by which duration, softening and mesh would be picked");
    else if (const std::string odd = not_measured(*picked.reading.value); !odd.empty())
      picked.notes.push_back("accuracy asked for: it does nothing, since the rule by which "
                             "duration, softening and mesh would be picked was " +
                             odd);
    if (!picked.notes.empty()) return picked;
  }
  const bool awaited_scene = awaits_scene(*picked.reading.value);
  picked.coarsening = pick_cost_parameters(*picked.reading.value, fixed);
  if (const std::string missed = missed_accuracy(*picked.reading.value);
      !missed.empty() && !awaits_scene(*picked.reading.value))
    picked.reading.warnings.push_back(file.string() + ": warning: " + missed);
  if (picked.reading.value->accuracy.shear_error > 0.0 && !keys.empty())
    picked.notes.push_back(
        fmt::format("accuracy asked for: {} as set by hand, the others picked around {}",
                    joined(keys), keys.size() == 1 ? "it" : "them"));
  if (awaited_scene && !awaits_scene(*picked.reading.value))
    picked.notes.emplace_back(needs_small_elements(*picked.reading.value)
                                  ? "accuracy asked for: elements are small throughout, as meshes "
                                    "from the scene do not reach it"
                                  : "accuracy asked for: the largest elements keep it throughout, "
                                    "so that none are made smaller for what is round in tools");
  return picked;
}

PreparedCase prepare_case(const std::filesystem::path& file, const std::vector<Override>& overrides,
                          CaseSize size) {
  PickedCase picked = pick_case(file, overrides);
  PreparedCase prepared;
  if (picked.reading.value) prepared.meshes = check_scene_and_units(picked.reading, size);
  if (picked.reading.value) check_prediction(picked.reading);
  prepared.value = std::move(picked.reading.value);
  prepared.coarsening = picked.coarsening;
  prepared.identity = std::move(picked.reading.identity);
  prepared.given = std::move(picked.reading.given);
  prepared.errors = std::move(picked.reading.errors);
  prepared.warnings = std::move(picked.reading.warnings);
  prepared.notes = std::move(picked.notes);
  prepared.fixed = picked.fixed;
  prepared.parts = std::move(picked.reading.parts);
  prepared.size = size;
  if (prepared.value && prepared.value->accuracy.instant)
    check_instant(prepared); // it looks for symmetry itself
  else
    take_part(prepared);
  return prepared;
}

void check_meshes(PreparedCase& prepared) {
  if (!prepared.value || prepared.size == CaseSize::any) return;
  auto fault = fault_of_meshes(*prepared.value, prepared.meshes, prepared.parts);
  if (!fault) return;
  prepared.errors.push_back(std::move(*fault));
  prepared.value.reset();
}

} // namespace plyform
