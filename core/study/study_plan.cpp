// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/study_plan.hpp"

#include "core/base/text.hpp"
#include "core/base/version.hpp"
#include "core/input/overrides.hpp"
#include "core/input/schema_check.hpp"

#include <cctype>
#include <cstdint>
#include <cstdlib>
#include <fmt/format.h>
#include <stdexcept>

namespace plyform {

namespace {

/// Fowler, Noll and Vo's hash FNV-1a, 64 bits: tells files apart, no defence against forgery.
struct Hash {
  std::uint64_t state = 0xcbf29ce484222325U;
  void add(const std::string& text) {
    for (const char c : text + '\0') {
      state ^= static_cast<unsigned char>(c);
      state *= 0x100000001b3U;
    }
  }
};

/// Adds every file that a text in the entry leads to: fabrics, meshes of tools and blanks.
void add_files(const TomlNode& entry, const std::filesystem::path& folder, Hash& hash) {
  for (const TomlNode& child : entry.children)
    add_files(child, folder, hash);
  if (entry.kind != TomlNode::Kind::string || entry.text.empty()) return;
  std::string reason;
  if (const auto content = read_text(resolve_path(entry, folder), reason)) hash.add(*content);
}

[[noreturn]] void unreadable(const Diagnostics& diagnostics) {
  throw std::runtime_error(diagnostics.errors.empty() ? "the case cannot be read"
                                                      : diagnostics.errors.front().text());
}

/// The file's text parsed, settings done, files not yet loaded.
std::optional<TomlNode> plain_entries(const std::filesystem::path& file, const std::string& content,
                                      const std::vector<Override>& settings,
                                      Diagnostics& diagnostics) {
  std::optional<TomlNode> root = parse_entries(content, file.string(), diagnostics);
  if (!root) return std::nullopt;
  for (const Override& change : settings)
    apply_override(*root, change, file.parent_path(), diagnostics);
  return root;
}

/// What the results of a run depend on.
std::string inputs_of(const Study& study, const StudyRun& run) {
  std::string reason;
  const std::optional<std::string> content = read_text(study.case_file, reason);
  if (!content) throw std::runtime_error(study.case_file.string() + " " + reason);
  Diagnostics diagnostics;
  const std::vector<Override> settings = split_settings(run.settings);
  const auto root = plain_entries(study.case_file, *content, settings, diagnostics);
  if (!root) unreadable(diagnostics);
  Hash hash;
  hash.add(*content);
  add_files(*root, study.case_file.parent_path(), hash);
  std::string text = fmt::format("plyform {}\nfiles {:016x}\n", version(), hash.state);
  if (!run.accuracy.empty()) text += "accuracy " + run.accuracy + "\n";
  for (const std::string& setting : run.settings)
    text += "set " + setting + "\n";
  return text;
}

/// The number that stands under a dotted path; NaN if there is none.
double number_at(const TomlNode& root, const std::string& path) {
  const TomlNode* entry = &root;
  for (std::size_t from = 0; entry && from <= path.size();) {
    const std::size_t dot = std::min(path.find('.', from), path.size());
    const std::string step = path.substr(from, dot - from);
    const bool list = entry->kind == TomlNode::Kind::list;
    const std::size_t index = static_cast<std::size_t>(std::atol(step.c_str()));
    if (list)
      entry = index < entry->children.size() ? &entry->children[index] : nullptr;
    else
      entry = entry->find(step);
    from = dot + 1;
  }
  return entry && entry->is_number() ? entry->number : std::numeric_limits<double>::quiet_NaN();
}

TomlNode entries_or_throw(const Study& study, const std::vector<std::string>& settings) {
  Diagnostics diagnostics;
  std::optional<TomlNode> root =
      case_entries(study.case_file, split_settings(settings), diagnostics);
  if (!root) unreadable(diagnostics);
  return std::move(*root);
}

double as_number(const std::string& value) {
  std::string reason;
  const std::optional<TomlNode> entry = parse_value(value, "", 1, reason);
  return entry && entry->is_number() ? entry->number : std::numeric_limits<double>::quiet_NaN();
}

using Settings = std::vector<std::string>;

Settings together(Settings first, const Settings& more) {
  first.insert(first.end(), more.begin(), more.end());
  return first;
}

/// The case's settings, those of the reference, then its factors.
Settings reference_settings(const Study& study) {
  const StudyReference& reference = study.reference;
  Settings settings = together(study.settings, reference.settings);
  const TomlNode root = entries_or_throw(study, settings);
  const auto times = [&](const char* key, double factor) {
    const double own = number_at(root, key);
    if (factor != 1.0) settings.push_back(fmt::format("{}={}", key, own * factor));
  };
  times("solver.step_factor", reference.step);
  times("solver.duration", reference.duration);
  if (reference.element_size == 1.0) return settings;
  return together(settings, element_size_settings(root, reference.element_size));
}

void add_run(const Study& study, StudyPlan& plan, StudyPoint point, StudyRun run) {
  run.inputs = inputs_of(study, run);
  point.run = plan.runs.size();
  plan.points.push_back(std::move(point));
  plan.runs.push_back(std::move(run));
}

void add_dial(const Study& study, int index, const TomlNode& root, StudyPlan& plan) {
  const StudyDial& dial = study.dials[index];
  const bool sizes = dial.key == element_size_key;
  const double own = sizes ? 1.0 : number_at(root, dial.key);
  plan.own.push_back(own);
  for (const std::string& value : dial.values) {
    StudyPoint point{PointKind::dial, dial.name, dial.key + "=" + value, value, index, 1};
    const bool word = value.front() == '\'';
    if (word) point.label = value.substr(1, value.size() - 2);
    if (sizes) point.label = "\u00d7" + value;
    point.value = as_number(value);
    if (point.value == own) { // the case's own run, which comes second
      plan.points.push_back(std::move(point));
      continue;
    }
    const Settings change =
        sizes ? element_size_settings(root, point.value) : Settings{point.setting};
    add_run(study, plan, point,
            {file_name_of(dial.name) + "=" + file_name_of(word ? point.label : value),
             together(study.settings, change), "", ""});
  }
}

} // namespace

std::string file_name_of(const std::string& text) {
  std::string name;
  for (const char c : text) {
    const auto u = static_cast<unsigned char>(c);
    name += u < 0x80 && (std::isalnum(u) || c == '.' || c == '+' || c == '-') ? c : '_';
  }
  return name;
}

std::optional<TomlNode> case_entries(const std::filesystem::path& file,
                                     const std::vector<Override>& settings,
                                     Diagnostics& diagnostics) {
  std::string reason;
  const std::optional<std::string> content = read_text(file, reason);
  if (!content) {
    diagnostics.error({file.string(), 1, 1}, "", "", "the case file " + reason,
                      "give the path of a case file");
    return std::nullopt;
  }
  std::optional<TomlNode> root = plain_entries(file, *content, settings, diagnostics);
  if (!root) return std::nullopt;
  load_fabrics(*root, file.parent_path(), diagnostics);
  check_section({&*root, "", ""}, diagnostics);
  return root;
}

std::vector<std::string> element_size_settings(const TomlNode& root, double factor) {
  std::vector<std::string> settings;
  if (const TomlNode* blanks = root.find("blanks"))
    for (const TomlNode& blank : blanks->children)
      if (const TomlNode* size = blank.find("element_size"); size && size->is_number())
        settings.push_back(
            fmt::format("blanks.{}.element_size={}", blank.key, size->number * factor));
  return settings;
}

StudyPlan plan_study(const Study& study) {
  StudyPlan plan;
  const StudyReference& r = study.reference;
  StudyPoint reference{.kind = PointKind::reference, .line = "reference", .label = "reference"};
  reference.setting =
      fmt::format("step={} duration={} element_size={}", r.step, r.duration, r.element_size);
  for (const std::string& setting : r.settings)
    reference.setting += " " + setting;
  add_run(study, plan, reference, {"reference", reference_settings(study), "", ""});
  add_run(study, plan, {.line = "case", .label = "case"}, {"case", study.settings, "", ""});
  for (const std::string& preset : study.presets)
    add_run(study, plan,
            {.kind = PointKind::preset, .line = "preset", .setting = preset, .label = preset},
            {"preset=" + preset, study.settings, preset, ""});
  const TomlNode root = entries_or_throw(study, study.settings);
  for (std::size_t i = 0; i < study.dials.size(); ++i)
    add_dial(study, static_cast<int>(i), root, plan);
  return plan;
}

} // namespace plyform
