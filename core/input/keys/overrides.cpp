// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/input/keys/overrides.hpp"

#include "base/format.hpp"
#include "base/text.hpp"
#include "core/input/keys/schema_check.hpp"

#include <algorithm>

namespace plyform {

namespace {

/// One part of a dotted path.
struct Step {
  std::string name;
  int column;
};

std::vector<Step> split_path(const std::string& path) {
  std::vector<Step> steps;
  std::size_t from = 0;
  while (true) {
    const std::size_t dot = path.find('.', from);
    steps.push_back({path.substr(from, dot - from), static_cast<int>(from) + 1});
    if (dot == std::string::npos) return steps;
    from = dot + 1;
  }
}

/// The value of an override; a bare word that is not a TOML value is read as a string.
std::optional<TomlNode> override_value(const Override& change, Diagnostics& diagnostics) {
  const auto& [key, source_text] = change;
  const int column = static_cast<int>(key.size()) + 2;
  std::string reason;
  std::optional<TomlNode> value = parse_value(source_text, override_file, column, reason);
  if (value && key.size() > 0) return value;
  const std::size_t start = source_text.find_first_not_of(" \t");
  const bool bare = start != std::string::npos &&
                    std::string("\"'[{#\n").find(source_text[start]) == std::string::npos &&
                    source_text.find('\n') == std::string::npos;
  if (!bare) {
    diagnostics.error({override_file, 1, column}, key, source_text,
                      "must be a TOML value or a word, and " + reason,
                      "write KEY=VALUE, texts with spaces in quotes: " + key + "='\"a b\"'");
    return std::nullopt;
  }
  TomlNode word;
  word.kind = TomlNode::Kind::string;
  word.text = word.source_text = source_text;
  word.at = word.key_at = {override_file, 1, column};
  return word;
}

/// Position during the descent along a path: the entry, its pattern and its dotted path so far.
struct Walk {
  TomlNode* entry;
  std::string pattern, item;
  TomlNode* grown = nullptr; ///< the first entry that got a new last member on the way
};

/// The list item that a step names; reports an error and returns null if there is none.
TomlNode* list_item(const Walk& walk, const Step& step, const std::string& key,
                    Diagnostics& diagnostics) {
  if (const auto place = place_in_list(*walk.entry, step.name))
    return &walk.entry->children[*place];
  diagnostics.error({override_file, 1, step.column}, key, "",
                    fmt::format("{} has no item {}", walk.item, step.name),
                    items_remedy(*walk.entry) +
                        (walk.entry->children.empty() ? "; give the list as a whole" : ""));
  return nullptr;
}

/// The member of a table that a step names, created if it does not exist; reports an error and
/// returns null if the table of keys does not have it.
TomlNode* member(Walk& walk, const Step& step, const std::string& pattern,
                 Diagnostics& diagnostics) {
  const Place at{override_file, 1, step.column};
  if (pattern.empty()) {
    report_unknown_key({walk.entry, walk.pattern, walk.item}, at, step.name, "", diagnostics);
    return nullptr;
  }
  if (TomlNode* entry = walk.entry->find(step.name)) return entry;
  const KeyKind kind = find_key(pattern)->kind;
  TomlNode made;
  made.key = step.name;
  made.at = made.key_at = at;
  const bool table = kind == KeyKind::table || kind == KeyKind::map || kind == KeyKind::fabric;
  made.kind = table ? TomlNode::Kind::table : TomlNode::Kind::list;
  walk.entry->children.push_back(made);
  if (!walk.grown) walk.grown = walk.entry;
  return &walk.entry->children.back();
}

/// Descends by one step; reports an error and returns false if that is impossible.
bool descend(Walk& walk, const Step& step, const std::string& key, Diagnostics& diagnostics) {
  std::string pattern;
  TomlNode* next = nullptr;
  if (walk.entry->kind == TomlNode::Kind::list) {
    pattern = walk.pattern + "[]";
    next = list_item(walk, step, key, diagnostics);
  } else if (walk.entry->kind == TomlNode::Kind::table) {
    pattern = pattern_of(walk.pattern, step.name);
    next = member(walk, step, pattern, diagnostics);
  } else {
    diagnostics.error({override_file, 1, step.column}, key, "",
                      fmt::format("{} is a single value and has no {}", walk.item, step.name),
                      fmt::format("set {} itself", walk.item));
  }
  walk = {next, pattern, (walk.item.empty() ? "" : walk.item + ".") + step.name, walk.grown};
  return next != nullptr;
}

} // namespace

void apply_override(TomlNode& root, const Override& change, const std::filesystem::path& folder,
                    Diagnostics& diagnostics) {
  std::optional<TomlNode> value = override_value(change, diagnostics);
  if (!value) return;
  const std::vector<Step> steps = split_path(change.first);
  Walk walk{&root, "", ""};
  for (const Step& step : steps) {
    if (walk.pattern == "fabrics.NAME") load_fabric(*walk.entry, walk.item, folder, diagnostics);
    if (!walk.entry->valid) return; // the fabric's file cannot be read; has been reported
    if (descend(walk, step, change.first, diagnostics)) continue;
    if (walk.grown) walk.grown->children.pop_back(); // an invalid path leaves the tree unchanged
    return;
  }
  value->key = walk.entry->key;
  value->key_at = {override_file, 1, steps.back().column};
  *walk.entry = std::move(*value);
}

std::filesystem::path resolve_path(const TomlNode& entry, const std::filesystem::path& folder) {
  const bool overridden = entry.at.file == override_file;
  return (overridden ? folder : folder_of(entry.at.file)) / entry.text;
}

void load_fabric(TomlNode& entry, const std::string& item, const std::filesystem::path& folder,
                 Diagnostics& diagnostics) {
  if (entry.kind != TomlNode::Kind::string || !entry.valid) return;
  const std::filesystem::path file = resolve_path(entry, folder);
  std::string reason = "must not be empty";
  const std::optional<std::string> content =
      entry.text.empty() ? std::nullopt : read_text(file, reason);
  const std::string name = file.lexically_normal().string();
  if (!content) {
    diagnostics.error(entry.at, item, entry.source_text,
                      entry.text.empty() ? reason : name + " " + reason,
                      "give the fabric file's path, seen from the file that names it");
    entry.valid = false;
    return;
  }
  std::optional<TomlNode> table = parse_entries(*content, name, diagnostics);
  if (!table) {
    entry.valid = false;
    return;
  }
  table->key = entry.key;
  table->key_at = entry.key_at;
  entry = std::move(*table);
}

void load_fabrics(TomlNode& root, const std::filesystem::path& folder, Diagnostics& diagnostics) {
  TomlNode* fabrics = root.find("fabrics");
  if (!fabrics || fabrics->kind != TomlNode::Kind::table) return;
  for (TomlNode& entry : fabrics->children)
    load_fabric(entry, "fabrics." + entry.key, folder, diagnostics);
}

} // namespace plyform
