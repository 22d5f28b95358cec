// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/input/keys/entries.hpp"

#include "base/format.hpp"
#include "base/text.hpp"
#include "core/input/keys/overrides.hpp"
#include "core/input/keys/schema_check.hpp"

namespace plyform {
namespace {

/// The list's item of that number, or null and a report.
TomlNode* item_at(const TableView& list, const Place& at, const std::string& step,
                  Diagnostics& diagnostics) {
  if (const auto place = place_in_list(*list.entry, step)) return &list.entry->children[*place];
  diagnostics.error(at, item_of(list, step), "", fmt::format("{} has no item {}", list.item, step),
                    items_remedy(*list.entry));
  return nullptr;
}

/// Warns of names that keys cannot use.
void check_names(const TomlNode& root, Diagnostics& diagnostics) {
  for (const TomlNode& list : root.children) {
    if (list.kind != TomlNode::Kind::list) continue;
    for (std::size_t i = 0; i < list.children.size(); ++i)
      if (const TomlNode* name = list.children[i].find("name");
          name && name->kind == TomlNode::Kind::string && is_number_of_item(name->text))
        diagnostics.warning(name->at,
                            fmt::format("{0}.{1}.name = \"{2}\": in keys of --set, studies and "
                                        "Python {0}.{2} is a number, counted from 0, and this item "
                                        "is {0}.{1}; a letter in the name ends the doubt",
                                        list.key, i, name->text));
  }
}

} // namespace

std::optional<TomlNode> read_entries(const std::filesystem::path& file,
                                     const std::vector<Override>& overrides,
                                     Diagnostics& diagnostics) {
  std::string reason;
  const std::string name = file.string();
  const std::optional<std::string> content = read_text(file, reason);
  if (!content) {
    diagnostics.error({name, 1, 1}, "", "", "the case file " + reason,
                      "give the path of a case file");
    return std::nullopt;
  }
  std::optional<TomlNode> entries = parse_entries(*content, name, diagnostics);
  if (!entries) return std::nullopt;
  const std::filesystem::path folder = folder_of(file);
  for (const Override& change : overrides)
    apply_override(*entries, change, folder, diagnostics);
  load_fabrics(*entries, folder, diagnostics);
  check_section({&*entries, "", ""}, diagnostics);
  check_names(*entries, diagnostics);
  return entries;
}

const TomlNode* find_entry(TomlNode& root, const std::string& key, Diagnostics& diagnostics) {
  TableView at{&root, "", ""};
  for (std::size_t from = 0; at.entry && from <= key.size();) {
    const std::size_t dot = std::min(key.find('.', from), key.size());
    const std::string name = key.substr(from, dot - from);
    const Place place{"", 1, static_cast<int>(from) + 1};
    TableView next{nullptr, at.pattern + "[]", item_of(at, name)};
    if (at.entry->kind == TomlNode::Kind::list) {
      next.entry = item_at(at, place, name, diagnostics);
    } else if (at.entry->kind == TomlNode::Kind::table) {
      next.pattern = pattern_of(at.pattern, name);
      if (next.pattern.empty()) report_unknown_key(at, place, name, "", diagnostics);
      next.entry = at.entry->find(name);
    } else {
      diagnostics.error(place, next.item, "",
                        fmt::format("{} is a single value and has no {}", at.item, name),
                        fmt::format("ask for {} itself", at.item));
    }
    at = next;
    from = dot + 1;
  }
  return diagnostics.errors.empty() ? at.entry : nullptr;
}

} // namespace plyform
