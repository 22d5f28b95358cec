// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/input/keys/case_identity.hpp"

#include "base/format.hpp"
#include "base/text.hpp"
#include "base/version.hpp"
#include "core/input/keys/overrides.hpp"

namespace plyform {
namespace {

/// Where and how something is written makes no other case of it.
void add(const TomlNode& node, const std::filesystem::path& folder, std::string& text) {
  text += node.key + (node.key.empty() ? "" : "=");
  switch (node.kind) {
  case TomlNode::Kind::table:
  case TomlNode::Kind::list:
    text += node.kind == TomlNode::Kind::table ? "{" : "[";
    for (const TomlNode& child : node.children)
      add(child, folder, text);
    text += node.kind == TomlNode::Kind::table ? "}" : "]";
    break;
  case TomlNode::Kind::integer:
  case TomlNode::Kind::number:
    text += fmt::format("{}", node.number);
    break;
  case TomlNode::Kind::string: {
    text += fmt::format("{}:{}", node.text.size(), node.text);
    std::error_code ignored;
    std::string reason;
    if (const auto file = resolve_path(node, folder);
        std::filesystem::is_regular_file(file, ignored))
      if (const std::optional<std::string> content = read_file(file, most_mesh_bytes, reason))
        text += fmt::format("<{}:{}>", content->size(), *content);
    break;
  }
  default:
    text += node.source_text;
  }
  text += "\n";
}

} // namespace

std::string identity_of(const TomlNode& root, const std::filesystem::path& folder) {
  std::string text = version() + std::string("\n");
  add(root, folder, text);
  return text;
}

} // namespace plyform
