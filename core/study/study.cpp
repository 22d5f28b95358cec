// SPDX-License-Identifier: GPL-3.0-or-later
// The study file -> entries -> Study, key by key; then the case with the settings of each run.
#include "core/study/study.hpp"

#include "core/base/text.hpp"
#include "core/input/schema.hpp"
#include "core/setup/prepare_case.hpp"
#include "core/study/study_plan.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <set>

namespace plyform {

namespace {

using Kind = TomlNode::Kind;

/// A table of the study file, its dotted path, and where mistakes go.
struct Part {
  const TomlNode& table;
  std::string item; ///< dial.1; empty at the top
  Diagnostics& diagnostics;

  std::string path(const std::string& key) const { return item.empty() ? key : item + "." + key; }
  void fail(const TomlNode& value, const std::string& key, const std::string& rule,
            const std::string& remedy) const {
    diagnostics.error(value.at, path(key), value.source_text, rule, remedy);
  }
  void missing(const std::string& key, const std::string& remedy) const {
    diagnostics.error(table.at, path(key), "", "is missing", remedy);
  }
};

/// A key and what completes "give the ...".
struct StudyKey {
  const char *name, *meaning;
};

constexpr StudyKey study_keys[] = {{"title", "title of the chart"},
                                   {"case", "case file or its folder, seen from the study file"},
                                   {"settings", "settings of every run, each \"KEY=VALUE\""},
                                   {"presets", "names for --accuracy"},
                                   {"reference", "table of the reference run"},
                                   {"dial", "dials, each under [[dial]]"}};
constexpr StudyKey reference_keys[] = {
    {"step", "factor of solver.step_factor"},
    {"duration", "factor of solver.duration"},
    {"element_size", "factor of the element_size of every blank"},
    {"settings", "settings of the reference, each \"KEY=VALUE\""}};
constexpr StudyKey dial_keys[] = {{"name", "name of the dial's line"},
                                  {"key", "key of the case, as in --set, or element_size"},
                                  {"values", "values of the key, as a list"}};

template <std::size_t count>
std::string give(const StudyKey (&keys)[count], const std::string& key) {
  for (const StudyKey& known : keys)
    if (key == known.name) return std::string("give the ") + known.meaning;
  return "";
}

template <std::size_t count>
void report_unknown(const Part& part, const StudyKey (&keys)[count], const char* place) {
  std::vector<std::string> known;
  for (const StudyKey& key : keys)
    known.push_back(key.name);
  for (const TomlNode& child : part.table.children) {
    if (std::find(known.begin(), known.end(), child.key) != known.end()) continue;
    const std::string nearest = nearest_word(child.key, known);
    part.diagnostics.error(child.key_at, part.path(child.key), child.source_text,
                           fmt::format("unknown key, {} has no {}", place, child.key),
                           nearest.empty() ? "it has " + joined(known)
                                           : fmt::format("did you mean {}?", nearest));
  }
}

/// A text that is not empty; empty if it is missing or wrong.
std::string read_word(const Part& part, const char* key, const std::string& remedy, bool required) {
  const TomlNode* value = part.table.find(key);
  if (!value) {
    if (required) part.missing(key, remedy);
  } else if (value->kind != Kind::string) {
    part.fail(*value, key, "must be a string", remedy);
  } else if (value->text.empty()) {
    part.fail(*value, key, "must not be empty", remedy);
  } else {
    return value->text;
  }
  return "";
}

/// KEY=VALUE strings; a wrong one is reported and left out.
std::vector<std::string> read_settings(const Part& part, const std::string& remedy) {
  std::vector<std::string> settings;
  const TomlNode* list = part.table.find("settings");
  if (list && list->kind != Kind::list) part.fail(*list, "settings", "must be a list", remedy);
  if (!list || list->kind != Kind::list) return settings;
  for (std::size_t i = 0; i < list->children.size(); ++i) {
    const TomlNode& item = list->children[i];
    const std::string key = fmt::format("settings.{}", i);
    if (item.kind != Kind::string || !split_setting(item.text))
      part.fail(item, key, "must be a string KEY=VALUE",
                "write for example \"solver.fibre_softening=25\"");
    else
      settings.push_back(item.text);
  }
  return settings;
}

std::vector<std::string> read_presets(const Part& part) {
  static const std::vector<std::string> known = Study{}.presets;
  const TomlNode* list = part.table.find("presets");
  if (!list) return known;
  const std::string remedy = "give a list of " + joined(known) + ", or [] for none";
  std::vector<std::string> presets;
  if (list->kind != Kind::list) part.fail(*list, "presets", "must be a list", remedy);
  if (list->kind != Kind::list) return presets;
  for (std::size_t i = 0; i < list->children.size(); ++i) {
    const TomlNode& item = list->children[i];
    const std::string key = fmt::format("presets.{}", i);
    if (std::find(known.begin(), known.end(), item.text) == known.end())
      part.fail(item, key, "must be one of " + joined(known), remedy);
    else if (std::find(presets.begin(), presets.end(), item.text) != presets.end())
      part.fail(item, key, "stands twice", "take one of the two out");
    else
      presets.push_back(item.text);
  }
  return presets;
}

void read_factor(const Part& part, const char* key, double& factor) {
  const TomlNode* value = part.table.find(key);
  if (!value) return;
  if (!value->is_number() || !(value->number > 0.0) || !std::isfinite(value->number))
    part.fail(*value, key, "must be a number greater than 0", give(reference_keys, key));
  else
    factor = value->number;
}

StudyReference read_reference(const Part& study) {
  StudyReference reference;
  const TomlNode* table = study.table.find("reference");
  if (!table) return reference;
  if (table->kind != Kind::table) {
    study.fail(*table, "reference", "must be a table", "write [reference] above its keys");
    return reference;
  }
  const Part part{*table, "reference", study.diagnostics};
  report_unknown(part, reference_keys, "the reference");
  read_factor(part, "step", reference.step);
  read_factor(part, "duration", reference.duration);
  read_factor(part, "element_size", reference.element_size);
  reference.settings = read_settings(part, give(reference_keys, "settings"));
  return reference;
}

/// A value as it stands behind KEY= in --set; empty and a report if it is none.
std::string read_value(const Part& dial, const TomlNode& value, const std::string& key,
                       bool factor) {
  const std::string remedy = factor ? "give a factor of the case's own element_size"
                                    : "give a number, or a word for keys that take one";
  const bool word = value.kind == Kind::string && !value.text.empty() &&
                    value.text.find_first_of("'\n\r") == std::string::npos;
  if (value.is_number() && std::isfinite(value.number) && (!factor || value.number > 0.0))
    return value.source_text;
  if (word && !factor) return "'" + value.text + "'";
  dial.fail(value, key, factor ? "must be a number greater than 0" : "must be a number or a word",
            remedy);
  return "";
}

void read_values(const Part& part, StudyDial& dial) {
  const TomlNode* list = part.table.find("values");
  const std::string remedy = give(dial_keys, "values");
  if (!list) return part.missing("values", remedy);
  if (list->kind != Kind::list || list->children.empty())
    return part.fail(*list, "values", "must be a list with at least one value", remedy);
  std::set<std::string> texts;
  std::set<double> numbers;
  for (std::size_t i = 0; i < list->children.size(); ++i) {
    const TomlNode& item = list->children[i];
    const std::string key = fmt::format("values.{}", i);
    const std::string value = read_value(part, item, key, dial.key == element_size_key);
    if (value.empty()) continue;
    if (!texts.insert(file_name_of(item.is_number() ? value : item.text)).second ||
        (item.is_number() && !numbers.insert(item.number).second))
      part.fail(item, key, "stands twice", "take one of the two out");
    else
      dial.values.push_back(value);
  }
}

std::vector<StudyDial> read_dials(const Part& study) {
  std::vector<StudyDial> dials;
  const TomlNode* list = study.table.find("dial");
  if (!list) return dials;
  const auto is_table = [](const TomlNode& entry) { return entry.kind == Kind::table; };
  if (list->kind != Kind::list ||
      !std::all_of(list->children.begin(), list->children.end(), is_table)) {
    study.fail(*list, "dial", "must be a list of tables", "write each dial under [[dial]]");
    return dials;
  }
  std::set<std::string> names{"reference", "case", "preset"};
  for (std::size_t i = 0; i < list->children.size(); ++i) {
    const Part part{list->children[i], fmt::format("dial.{}", i), study.diagnostics};
    report_unknown(part, dial_keys, "a dial");
    StudyDial& dial = dials.emplace_back();
    dial.name = read_word(part, "name", give(dial_keys, "name"), true);
    dial.key = read_word(part, "key", give(dial_keys, "key"), true);
    if (!dial.name.empty() && !names.insert(file_name_of(dial.name)).second)
      part.fail(*part.table.find("name"), "name", "is the name of another line of the chart too",
                "give each dial a name of its own, other than reference, case and preset");
    read_values(part, dial);
  }
  return dials;
}

std::filesystem::path read_case_path(const Part& study, const std::filesystem::path& folder) {
  const std::string text = read_word(study, "case", give(study_keys, "case"), true);
  if (text.empty()) return {};
  std::filesystem::path path = (folder / text).lexically_normal();
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) path /= "case.toml";
  if (!std::filesystem::is_regular_file(path, ignored))
    study.fail(*study.table.find("case"), "case", "there is no file " + path.string(),
               give(study_keys, "case"));
  return path;
}

// ---- the case with the settings of each run ----

/// What the case says against settings, told of the study's value that they come from.
void report(const CaseError& error, const Place& at, const std::string& item,
            const std::string& source_text, Diagnostics& diagnostics) {
  const std::string equals = error.value.empty() ? "" : " = " + error.value;
  diagnostics.error(at, item, source_text,
                    fmt::format("does not fit the case: {}{} {}", error.item, equals, error.rule),
                    error.remedy);
}

/// Lists of settings item by item, so that a mistake is told at the one that brings it in. True if
/// the case is sound with all of them on top of `before`.
bool check_settings(const std::filesystem::path& file, std::vector<std::string> before,
                    const Part& part, const std::vector<std::string>& settings) {
  for (std::size_t i = 0; i < settings.size(); ++i) {
    before.push_back(settings[i]);
    const PreparedCase reading = prepare_case(file, split_settings(before));
    if (reading.value) continue;
    const TomlNode& item = part.table.find("settings")->children[i];
    report(reading.errors.front(), item.at, part.path(fmt::format("settings.{}", i)),
           item.source_text, part.diagnostics);
    return false;
  }
  return true;
}

/// The factor of the reference that a mistake comes from.
const char* factor_behind(const CaseError& error) {
  if (error.item == "solver.step_factor") return "step";
  return error.item == "solver.duration" ? "duration" : "element_size";
}

void check_reference(const Study& study, const StudyRun& run, const Part& top) {
  static const TomlNode none;
  const TomlNode* table = top.table.find("reference");
  const Part part{table ? *table : none, "reference", top.diagnostics};
  std::vector<std::string> before = study.settings;
  if (!check_settings(study.case_file, before, part, study.reference.settings)) return;
  const PreparedCase reading = prepare_case(study.case_file, split_settings(run.settings));
  if (reading.value) return;
  const char* factor = factor_behind(reading.errors.front());
  const TomlNode* value = table ? table->find(factor) : nullptr;
  report(reading.errors.front(),
         value   ? value->at
         : table ? table->at
                 : top.table.at,
         part.path(factor), value ? value->source_text : "", top.diagnostics);
}

/// One dial: a key that the case does not have is reported once, a value that it does not allow
/// each time.
void check_dial(const Study& study, const StudyPlan& plan, int index, const Part& top) {
  const StudyDial& dial = study.dials[index];
  const TomlNode& table = top.table.find("dial")->children[index];
  const Part part{table, fmt::format("dial.{}", index), top.diagnostics};
  std::size_t i = 0;
  for (const StudyPoint& point : plan.points) {
    if (point.dial != index) continue;
    const std::string item = fmt::format("values.{}", i);
    const TomlNode& value = table.find("values")->children[i++];
    const StudyRun& run = plan.runs[point.run];
    if (dial.key == element_size_key && run.settings.size() == study.settings.size() &&
        point.value != 1.0)
      return part.fail(*table.find("key"), "key", "no blank of the case has an element_size",
                       "take the dial out: blanks from mesh files have the file's mesh");
    const PreparedCase reading = prepare_case(study.case_file, split_settings(run.settings));
    if (reading.value) continue;
    const CaseError& error = reading.errors.front();
    const bool of_key =
        error.file == override_file && error.column <= static_cast<int>(dial.key.size());
    const TomlNode& wrong = of_key ? *table.find("key") : value;
    report(error, wrong.at, part.path(of_key ? "key" : item), wrong.source_text, top.diagnostics);
    if (of_key) return;
  }
}

void check_runs(const Study& study, const Part& top) {
  Diagnostics& diagnostics = top.diagnostics;
  PreparedCase bare = prepare_case(study.case_file, split_settings(study.settings));
  if (!bare.value) {
    bare = prepare_case(study.case_file, {});
    diagnostics.errors.insert(diagnostics.errors.end(), bare.errors.begin(), bare.errors.end());
    if (bare.value) check_settings(study.case_file, {}, top, study.settings);
    return;
  }
  const StudyPlan plan = plan_study(study);
  check_reference(study, plan.runs.front(), top);
  for (std::size_t i = 0; i < study.dials.size(); ++i)
    check_dial(study, plan, static_cast<int>(i), top);
}

} // namespace

std::optional<Override> split_setting(const std::string& setting) {
  const std::size_t equals = setting.find('=');
  if (equals == std::string::npos || equals == 0) return std::nullopt;
  return Override{setting.substr(0, equals), setting.substr(equals + 1)};
}

std::vector<Override> split_settings(const std::vector<std::string>& settings) {
  std::vector<Override> overrides;
  for (const std::string& setting : settings)
    overrides.push_back(*split_setting(setting));
  return overrides;
}

StudyReading read_study(const std::filesystem::path& file) {
  Diagnostics diagnostics;
  StudyReading reading;
  std::string reason;
  const std::string name = file.string();
  if (const std::optional<std::string> content = read_text(file, reason); !content) {
    diagnostics.error({name, 1, 1}, "", "", "the study file " + reason,
                      "give the path of a study file");
  } else if (std::optional<TomlNode> root = parse_entries(*content, name, diagnostics)) {
    root->at = {name, 1, 1};
    const Part top{*root, "", diagnostics};
    Study study;
    report_unknown(top, study_keys, "the study");
    study.title = read_word(top, "title", give(study_keys, "title"), false);
    study.case_file = read_case_path(top, file.parent_path());
    study.settings = read_settings(top, give(study_keys, "settings"));
    study.presets = read_presets(top);
    study.reference = read_reference(top);
    study.dials = read_dials(top);
    if (study.title.empty()) study.title = file.stem().string();
    if (diagnostics.errors.empty()) check_runs(study, top);
    if (diagnostics.errors.empty()) reading.value = std::move(study);
  }
  std::stable_sort(diagnostics.errors.begin(), diagnostics.errors.end(),
                   [](const CaseError& a, const CaseError& b) {
                     return std::pair(a.line, a.column) < std::pair(b.line, b.column);
                   });
  reading.errors = std::move(diagnostics.errors);
  return reading;
}

} // namespace plyform
