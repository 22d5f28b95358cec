// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/input/keys/given_values.hpp"

#include "base/archive.hpp"
#include "base/format.hpp"
#include "base/read_file.hpp"
#include "core/input/keys/overrides.hpp"

#include <algorithm>
#include <cstdint>

namespace plyform {
namespace {

using Values = std::vector<std::pair<std::string, std::string>>;

constexpr std::size_t longest_given = 200; ///< bytes of a value: more is told by its checksum

std::uint64_t sum_of(std::string bytes) {
  HashArchive hash;
  hash.bytes(bytes.data(), bytes.size());
  return hash.hash();
}

std::string text_of(const TomlNode& node);

std::string with_file(const TomlNode& node, const std::filesystem::path& folder) {
  std::error_code ignored;
  std::string reason;
  const std::filesystem::path file = resolve_path(node, folder);
  if (!std::filesystem::is_regular_file(file, ignored)) return node.text;
  const std::optional<std::string> content = read_file(file, most_mesh_bytes, reason);
  if (!content) return node.text;
  return fmt::format("{} ({} bytes, {:016x})", node.text, content->size(), sum_of(*content));
}

/// A list or table in a list, in one line.
std::string joined_text(const TomlNode& node) {
  std::string text;
  for (const TomlNode& child : node.children)
    text +=
        (text.empty() ? "" : ", ") + (child.key.empty() ? "" : child.key + " = ") + text_of(child);
  return node.kind == TomlNode::Kind::list ? "[" + text + "]" : "{" + text + "}";
}

std::string text_of(const TomlNode& node) {
  if (node.is_number()) return fmt::format("{}", node.number);
  if (node.kind == TomlNode::Kind::string) return node.text;
  if (node.kind == TomlNode::Kind::list || node.kind == TomlNode::Kind::table)
    return joined_text(node);
  return node.source_text;
}

std::string shortened(const std::string& text) {
  if (text.size() <= longest_given) return text;
  return fmt::format("{}... ({} bytes, {:016x})", text.substr(0, longest_given / 2), text.size(),
                     sum_of(text));
}

bool of_tables(const TomlNode& list) {
  return !list.children.empty() &&
         std::all_of(list.children.begin(), list.children.end(),
                     [](const TomlNode& item) { return item.kind == TomlNode::Kind::table; });
}

/// The name that one item alone has, else its number.
std::string word_of(const TomlNode& list, std::size_t item) {
  const TomlNode* name = list.children[item].find("name");
  if (!name || name->kind != TomlNode::Kind::string) return std::to_string(item);
  return place_in_list(list, name->text) == item ? name->text : std::to_string(item);
}

void add(const TomlNode& node, const std::string& key, const std::filesystem::path& folder,
         Values& values) {
  const std::string before = key.empty() ? "" : key + ".";
  if (node.kind == TomlNode::Kind::table) {
    for (const TomlNode& child : node.children)
      add(child, before + child.key, folder, values);
  } else if (node.kind == TomlNode::Kind::list && of_tables(node)) {
    for (std::size_t i = 0; i < node.children.size(); ++i)
      add(node.children[i], before + word_of(node, i), folder, values);
  } else {
    const bool text = node.kind == TomlNode::Kind::string;
    values.emplace_back(key, shortened(text ? with_file(node, folder) : text_of(node)));
  }
}

} // namespace

std::vector<std::pair<std::string, std::string>> given_values(const TomlNode& root,
                                                              const std::filesystem::path& folder) {
  Values values;
  add(root, "", folder, values);
  return values;
}

} // namespace plyform
