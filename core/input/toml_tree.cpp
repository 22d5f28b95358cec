// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/input/toml_tree.hpp"

#include <algorithm>
#include <cerrno>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <string_view>
#include <system_error>
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

/// The parsed text, in lines, to quote values as written.
struct Source {
  std::string name;
  std::vector<std::string_view> lines;
};

Source split_lines(std::string_view text, const std::string& name) {
  Source source{name, {}};
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    source.lines.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return source;
}

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

/// The first line of a region of the text, at most 60 characters.
std::string quote(const Source& source, const toml::source_region& region) {
  constexpr std::size_t longest = 60;
  if (region.begin.line == 0 || region.begin.line > source.lines.size()) return "";
  const std::string_view line = source.lines[region.begin.line - 1];
  const std::size_t from = byte_of_column(line, region.begin.column);
  const bool more_lines = region.end.line > region.begin.line;
  std::size_t to = more_lines ? line.size() : byte_of_column(line, region.end.column);
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

} // namespace

std::optional<TomlNode> parse_entries(const std::string& text, const std::string& name,
                                      Diagnostics& diagnostics) {
  const Source source = split_lines(text, name);
  try {
    const toml::table table = toml::parse(std::string_view(text), std::string_view(name));
    return convert(table, source);
  } catch (const toml::parse_error& error) {
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

} // namespace plyform
