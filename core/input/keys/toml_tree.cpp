// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/input/keys/toml_tree.hpp"

#include "base/format.hpp"
#include "base/text.hpp"
#include "core/input/keys/toml_depth.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <string_view>
#include <toml++/toml.h>

namespace plyform {

TomlNode* TomlNode::find(const std::string& name) {
  const auto it = std::find_if(children.begin(), children.end(),
                               [&](const TomlNode& child) { return child.key == name; });
  return kind == Kind::table && it != children.end() ? &*it : nullptr;
}

const TomlNode* TomlNode::find(const std::string& name) const {
  return const_cast<TomlNode*>(this)->find(name);
}

namespace {

/// Byte offset of the column-th character (from 1) of UTF-8 text.
std::size_t byte_of_column(std::string_view line, std::size_t column) {
  std::size_t byte = 0;
  for (std::size_t c = 1; c < column && byte < line.size(); ++c) {
    ++byte;
    while (byte < line.size() && (static_cast<unsigned char>(line[byte]) & 0xC0U) == 0x80U)
      ++byte;
  }
  return byte;
}

/// A line, and where every so many characters of it begin: a list of numbers may be one long line.
struct SourceLine {
  static constexpr std::size_t apart = 256; // characters
  std::string_view text;
  std::vector<std::size_t> marks{}; ///< bytes before characters apart, 2 apart, ...

  explicit SourceLine(std::string_view line) : text(line) {
    for (std::size_t byte = 0;;) {
      byte += byte_of_column(text.substr(byte), apart + 1);
      if (byte >= text.size()) return;
      marks.push_back(byte);
    }
  }
  std::size_t byte_of(std::size_t column) const {
    if (column == 0) return 0;
    const std::size_t mark = std::min((column - 1) / apart, marks.size());
    const std::size_t from = mark == 0 ? 0 : marks[mark - 1];
    return from + byte_of_column(text.substr(from), column - mark * apart);
  }
};

/// The parsed text, in lines, to quote values as written.
struct Source {
  std::string name;
  std::vector<SourceLine> lines;
};

Source split_lines(std::string_view text, const std::string& name) {
  Source source{name, {}};
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    source.lines.emplace_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return source;
}

/// The first line of a region of the text, at most 60 characters.
std::string quote(const Source& source, const toml::source_region& region) {
  constexpr std::size_t longest = 60;
  if (region.begin.line == 0 || region.begin.line > source.lines.size()) return "";
  const SourceLine& marked = source.lines[region.begin.line - 1];
  const std::string_view line = marked.text;
  const std::size_t from = marked.byte_of(region.begin.column);
  const bool more_lines = region.end.line > region.begin.line;
  std::size_t to = more_lines ? line.size() : marked.byte_of(region.end.column);
  if (more_lines && to > from && line[to - 1] == '\r') --to;
  const std::string_view all = line.substr(from, std::max(from, to) - from);
  const std::size_t kept = byte_of_column(all, longest + 1);
  return std::string(all.substr(0, kept)) + (more_lines || kept < all.size() ? " ..." : "");
}

Place place_of(const Source& source, const toml::source_position& position) {
  return {source.name, static_cast<int>(position.line), static_cast<int>(position.column)};
}

TomlNode convert(const toml::node& node, const Source& source);

void convert_members(const toml::table& table, const Source& source, TomlNode& entry) {
  for (auto&& [key, value] : table) {
    TomlNode child = convert(value, source);
    child.key = std::string(key.str());
    child.key_at = place_of(source, key.source().begin);
    entry.children.push_back(std::move(child));
  }
  // toml++ sorts keys by name; errors are reported in the order of the file.
  std::stable_sort(entry.children.begin(), entry.children.end(),
                   [](const TomlNode& a, const TomlNode& b) {
                     return std::pair(a.key_at.line, a.key_at.column) <
                            std::pair(b.key_at.line, b.key_at.column);
                   });
}

TomlNode convert(const toml::node& node, const Source& source) {
  TomlNode entry;
  entry.at = entry.key_at = place_of(source, node.source().begin);
  entry.source_text = quote(source, node.source());
  if (const toml::table* table = node.as_table()) {
    convert_members(*table, source, entry);
  } else if (const toml::array* array = node.as_array()) {
    entry.kind = TomlNode::Kind::list;
    for (const toml::node& item : *array)
      entry.children.push_back(convert(item, source));
  } else if (const auto* text = node.as_string()) {
    entry.kind = TomlNode::Kind::string;
    entry.text = text->get();
  } else if (const auto* integer = node.as_integer()) {
    entry.kind = TomlNode::Kind::integer;
    entry.number = static_cast<double>(integer->get());
  } else if (const auto* number = node.as_floating_point()) {
    entry.kind = TomlNode::Kind::number;
    entry.number = number->get();
  } else {
    entry.kind = node.is_boolean() ? TomlNode::Kind::boolean : TomlNode::Kind::date;
  }
  return entry;
}

/// Numbers that no double or 64 bits hold stop toml++ at their end: one of the same length in their
/// place, beyond the range of every key, lets the rest be read; what is quoted is what the file
/// has. Whether there was such a number.
bool within_reach(std::string& text, const Source& source, const toml::parse_error& error) {
  const std::string_view rule = error.description();
  const toml::source_position at = error.source().begin;
  if (rule.find("could not be interpreted as a value") == rule.npos &&
      rule.find("is not representable in 64 bits") == rule.npos)
    return false;
  if (at.line == 0 || at.line > source.lines.size()) return false;
  const SourceLine& line = source.lines[at.line - 1];
  const std::size_t end = line.byte_of(at.column);
  std::size_t begin = end;
  while (begin > 0 &&
         (std::isalnum(static_cast<unsigned char>(line.text[begin - 1])) != 0 ||
          std::string_view("._+-").find(line.text[begin - 1]) != std::string_view::npos))
    --begin;
  if (begin < end && (line.text[begin] == '-' || line.text[begin] == '+')) ++begin;
  if (end - begin < 5) return false;
  const auto from = static_cast<std::size_t>(line.text.data() - source.lines.front().text.data());
  text.replace(from + begin, end - begin, fmt::format("1e{:0{}}", 300, end - begin - 2));
  return true;
}

} // namespace

std::optional<TomlNode> parse_entries(const std::string& text, const std::string& name,
                                      Diagnostics& diagnostics) {
  if (text.size() > most_case_bytes) {
    diagnostics.error({name, 1, 1}, "", "",
                      fmt::format("has {} bytes, more than the {} that a case or fabric may have",
                                  text.size(), most_case_bytes),
                      "put meshes and drawings into files of their own");
    return std::nullopt;
  }
  const Source source = split_lines(text, name);
  if (const std::optional<TomlPlace> deep = nested_too_deep(text)) {
    diagnostics.error({name, deep->line, deep->column}, "", "",
                      fmt::format("goes more than {} levels deep", most_nested),
                      "take dots out of the key, or brackets out of the list: no key of a case or "
                      "fabric is as deep");
    return std::nullopt;
  }
  std::string readable = text;
  for (int most = 100;; --most) // of numbers beyond reach
    try {
      const toml::table table = toml::parse(std::string_view(readable), std::string_view(name));
      return convert(table, source);
    } catch (const toml::parse_error& error) {
      if (most > 0 && within_reach(readable, source, error)) continue;
      diagnostics.error(place_of(source, error.source().begin), "", "",
                        "is no TOML: " + std::string(error.description()),
                        "correct the line, or the bracket or quote left open before it");
      return std::nullopt;
    }
}

std::optional<TomlNode> parse_value(const std::string& text, const std::string& name, int column,
                                    std::string& reason) {
  if (text.find('\n') != std::string::npos) {
    reason = "it has more than one line";
    return std::nullopt;
  }
  // The value is parsed after a key padded with spaces, so that errors have the right column.
  const std::string line = fmt::format("v{:{}}={}", "", std::max(column, 3) - 3, text);
  Diagnostics diagnostics;
  std::optional<TomlNode> table = parse_entries(line, name, diagnostics);
  if (!table) {
    reason = diagnostics.errors.front().rule;
    return std::nullopt;
  }
  return std::move(table->children.front());
}

bool is_number_of_item(const std::string& step) {
  return !step.empty() && step.find_first_not_of("0123456789") == std::string::npos;
}

std::optional<std::size_t> place_in_list(const TomlNode& list, const std::string& step) {
  const std::vector<TomlNode>& items = list.children;
  if (is_number_of_item(step)) {
    std::size_t index = items.size();
    std::from_chars(step.data(), step.data() + step.size(), index);
    return index < items.size() ? std::optional(index) : std::nullopt;
  }
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const TomlNode* name = items[i].find("name");
    if (!name || name->kind != TomlNode::Kind::string || name->text != step) continue;
    if (found) return std::nullopt;
    found = i;
  }
  return found;
}

std::string items_remedy(const TomlNode& list) {
  if (list.children.empty()) return "it has no items";
  std::string names;
  for (const TomlNode& item : list.children)
    if (const TomlNode* name = item.find("name"); name && name->kind == TomlNode::Kind::string)
      names += (names.empty() ? ", or by a name that one has alone: " : ", ") + name->text;
  return fmt::format("its items are numbered from 0 to {}", list.children.size() - 1) + names;
}

} // namespace plyform
