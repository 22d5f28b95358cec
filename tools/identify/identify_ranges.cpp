// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/identify/identify_ranges.hpp"

#include <algorithm>

namespace plyform {
namespace {

/// "family[0]" and "stiffness" as messages of the reader name them: "family.0.stiffness".
std::string item_name(const std::string& table, const std::string& key) {
  std::string item;
  for (const char c : table)
    if (c != ']') item += c == '[' ? '.' : c;
  return item.empty() ? key : item + "." + key;
}

/// Whether a message is about one of the items, or numbers within it.
bool is_about(const std::string& message, const std::vector<std::string>& items) {
  return std::any_of(items.begin(), items.end(), [&message](const std::string& item) {
    const std::size_t end = item.size();
    return message.starts_with(item) && (message.size() == end || message[end] == '.' ||
                                         message[end] == ' ' || message[end] == ':');
  });
}

std::string after(const std::string& text, const std::string& word) {
  const std::size_t at = text.find(word);
  return at == std::string::npos ? text : text.substr(at + word.size());
}

constexpr const char* check_units = "check the units of the columns and of the options, and which "
                                    "columns are read";

} // namespace

void hold_to_keys(const std::vector<CaseError>& errors, const std::vector<std::string>& warnings,
                  const std::vector<std::string>& items, const Place& curve,
                  Diagnostics& diagnostics) {
  for (const CaseError& error : errors)
    diagnostics.error(curve, error.item, error.value,
                      fmt::format("comes out of the curves and {}", error.rule), check_units);
  for (const std::string& warning : warnings)
    if (const std::string text = after(warning, "warning: "); is_about(text, items))
      diagnostics.warning(curve, text + "; it comes out of the curves");
}

std::string fabric_text(const IdentifyArguments& a, const FabricReading& base,
                        const std::vector<LawText>& laws, Diagnostics& diagnostics) {
  std::string text = base.text;
  std::vector<std::string> items;
  for (const LawText& law : laws) {
    text = with_law(text, law);
    items.push_back(item_name(law.table, law.key));
    for (const auto& beside : law.beside)
      items.push_back(item_name(law.table, beside.first));
  }
  const bool rubber = base.value && base.value->families.empty();
  const FabricReading made = read_fabric_text(text, a.output, rubber);
  hold_to_keys(made.errors, made.warnings, items, {curve_argument(a.curves.front()).file, 1, 1},
               diagnostics);
  return text;
}

} // namespace plyform
