// SPDX-License-Identifier: GPL-3.0-or-later
// Writes a fabric file with another law. It is generated from its entries, not edited as text,
// because a law may be in a table, an inline table or under dotted keys.
#include "base/format.hpp"
#include "core/input/keys/toml_tree.hpp"
#include "core/input/parts/fabric_file.hpp"

#include <algorithm>
#include <stdexcept>
#include <string_view>

namespace plyform {
namespace {

/// Name of what a key states: keys of one name stand for each other.
std::string_view subject_of(std::string_view key) {
  if (key == "stiffness" || key == "table" || key == "polynomial" || key == "negative_polynomial")
    return "law";
  if (key == "viscosity" || key == "viscous") return "viscosity";
  if (key == "bending_stiffness" || key == "bending_table") return "bending";
  if (key == "shear_modulus" || key == "c10" || key == "c01" || key == "stretch_limit")
    return "rubber";
  return key;
}

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
      result += std::string("\\") + c;
    else if (byte < 0x20 || byte == 0x7F)
      result += fmt::format("\\u{:04X}", byte);
    else
      result += c;
  }
  return result + "\"";
}

std::string key_text(const std::string& key) {
  constexpr const char* bare = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
  return key.empty() || key.find_first_not_of(bare) != std::string::npos ? quoted(key) : key;
}

/// A value as text on one line; lists of pairs have one pair per line.
std::string value_text(const TomlNode& entry) {
  std::string items;
  switch (entry.kind) {
  case TomlNode::Kind::string:
    return quoted(entry.text);
  case TomlNode::Kind::list: {
    const bool rows = std::any_of(entry.children.begin(), entry.children.end(),
                                  [](const TomlNode& e) { return e.kind == TomlNode::Kind::list; });
    for (const TomlNode& child : entry.children)
      items += (rows ? "\n    " : items.empty() ? "" : " ") + value_text(child) + ",";
    if (!rows && !items.empty()) items.pop_back();
    return "[" + items + (rows ? "\n]" : "]");
  }
  case TomlNode::Kind::table:
    for (const TomlNode& child : entry.children)
      items += (items.empty() ? " " : ", ") + key_text(child.key) + " = " + value_text(child);
    return "{" + items + " }";
  default:
    return entry.source_text; // numbers, dates: as the user wrote them
  }
}

struct FabricText {
  std::vector<std::string> lines; ///< of the file read
  const LawText& law;
  std::string out;

  bool is_comment(int line) const {
    if (line < 1 || static_cast<std::size_t>(line) > lines.size()) return false;
    const std::string& text = lines[static_cast<std::size_t>(line) - 1];
    const std::size_t start = text.find_first_not_of(" \t");
    return start != std::string::npos && text[start] == '#';
  }
  void put(const std::string& line) { out += line + "\n"; }
};

void put_comment_above(FabricText& to, int line) {
  int first = line;
  while (to.is_comment(first - 1))
    --first;
  for (; first < line; ++first)
    to.put(to.lines[static_cast<std::size_t>(first) - 1]);
}

/// The comment after a value on its line, with the blanks before it; empty if there is none.
std::string comment_behind(const FabricText& from, const TomlNode& entry) {
  const auto index = static_cast<std::size_t>(entry.at.line) - 1;
  if (entry.at.line < 1 || index >= from.lines.size() || entry.source_text.empty()) return "";
  const std::string& line = from.lines[index];
  const std::size_t equals = line.find('=');
  const std::size_t value =
      equals == std::string::npos ? equals : line.find(entry.source_text, equals + 1);
  if (value == std::string::npos) return "";
  const std::size_t behind = value + entry.source_text.size();
  const std::size_t mark = line.find_first_not_of(" \t", behind);
  return mark == std::string::npos || line[mark] != '#' ? "" : line.substr(behind);
}

void put_law(FabricText& to) {
  if (to.law.value.empty()) return;
  for (std::string line : to.law.comment) {
    for (char& c : line)
      if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = ' ';
    to.put("# " + line);
  }
  to.put(to.law.key + " = " + to.law.value);
  for (const auto& [key, value] : to.law.beside)
    to.put(key + " = " + value);
}

/// Whether it is a list of tables, [[name]].
bool has_tables(const TomlNode& entry) {
  return entry.kind == TomlNode::Kind::list && !entry.children.empty() &&
         entry.children.front().kind == TomlNode::Kind::table;
}

/// A table with the header that it has in the file, and its path: "crossing.crimp" and
/// "crossing[0].crimp"; both empty for the file as a whole.
struct PlacedTable {
  const TomlNode& node;
  std::string header, path;
};

void put_table(FabricText& to, const PlacedTable& table);

/// The tables and lists of tables within a table.
void put_tables_of(FabricText& to, const PlacedTable& table) {
  for (const TomlNode& child : table.node.children) {
    const std::string key = key_text(child.key);
    const std::string header = (table.header.empty() ? "" : table.header + ".") + key;
    const std::string path = (table.path.empty() ? "" : table.path + ".") + key;
    const bool list = has_tables(child);
    if (!list && child.kind != TomlNode::Kind::table) continue;
    const std::vector<std::string>& without = to.law.without;
    if (std::find(without.begin(), without.end(), path) != without.end()) continue;
    int above = 0; // line of the header before: tables of one line have one comment
    for (std::size_t i = 0; i < (list ? child.children.size() : 1); ++i) {
      const TomlNode& node = list ? child.children[i] : child;
      if (!to.out.empty()) to.put("");
      if (node.at.line != above) put_comment_above(to, node.at.line);
      above = node.at.line;
      to.put(list ? "[[" + header + "]]" : "[" + header + "]");
      put_table(to, {node, header, list ? fmt::format("{}[{}]", path, i) : path});
    }
  }
}

void put_table(FabricText& to, const PlacedTable& table) {
  const bool here = table.path == to.law.table;
  bool law_due = here;
  for (const TomlNode& child : table.node.children) {
    if (here && subject_of(to.law.key) == subject_of(child.key)) {
      if (law_due) put_law(to);
      law_due = false;
    } else if (child.kind != TomlNode::Kind::table && !has_tables(child)) {
      put_comment_above(to, child.key_at.line);
      to.put(key_text(child.key) + " = " + value_text(child) + comment_behind(to, child));
    }
  }
  if (law_due) put_law(to);
  put_tables_of(to, table);
}

/// Adds the table of that path if it is not there; lists of tables must be.
void add_table(TomlNode& root, const std::string& path) {
  if (path.empty()) return;
  TomlNode* at = &root;
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t end = std::min(path.find('.', begin), path.size());
    const std::string part = path.substr(begin, end - begin);
    const std::size_t bracket = part.find('[');
    TomlNode* next = at->find(part.substr(0, bracket));
    if (bracket != std::string::npos) {
      const std::size_t item = std::stoul(part.substr(bracket + 1));
      if (!next || item >= next->children.size())
        throw std::invalid_argument("the fabric has no " + part);
      next = &next->children[item];
    } else if (!next) {
      TomlNode table;
      table.key = part;
      at->children.push_back(std::move(table));
      next = &at->children.back();
    }
    at = next;
    begin = end + 1;
  }
}

} // namespace

std::string with_law(const std::string& text, const LawText& law) {
  Diagnostics diagnostics;
  std::optional<TomlNode> root = parse_entries(text, "fabric", diagnostics);
  if (!root) throw std::invalid_argument(diagnostics.errors.front().text());
  FabricText to{{}, law, ""};
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    to.lines.push_back(text.substr(at, end - at));
    if (to.lines.back().ends_with('\r')) to.lines.back().pop_back();
    at = end + 1;
  }
  int top = 1; // the comment at the top, unless a key or table follows directly
  while (to.is_comment(top))
    ++top;
  const bool alone =
      top > 1 &&
      (static_cast<std::size_t>(top) > to.lines.size() ||
       to.lines[static_cast<std::size_t>(top) - 1].find_first_not_of(" \t") == std::string::npos);
  if (alone) {
    put_comment_above(to, top);
    to.put("");
  }
  add_table(*root, law.table);
  put_table(to, {*root, "", ""});
  return to.out;
}

} // namespace plyform
