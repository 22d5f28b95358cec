// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/format.hpp"
#include "base/text.hpp"
#include "base/units.hpp"
#include "core/input/case_file.hpp"
#include "tools/cli/commands.hpp"

#include <nlohmann/json.hpp>

namespace plyform {
namespace {

/// Text of a key's default: "default ..." or "required ...".
std::string fallback_of(const KeyInfo& k) {
  const bool required = k.fallback.rfind("required", 0) == 0;
  return required || k.fallback.empty() ? k.fallback : "default " + k.fallback;
}

void print_text(const KeyInfo& k) {
  fmt::print("{}\n    {}", k.key, k.type);
  if (!k.unit.empty() && k.unit != "-") fmt::print(", {}", k.unit);
  for (const std::string& part : {fallback_of(k), k.range})
    if (!part.empty()) fmt::print("; {}", part);
  fmt::print("\n    {}\n", k.meaning);
}

/// Text of a Markdown table cell, with | escaped.
std::string cell(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2)
    text.insert(at, 1, '\\');
  return text;
}

void print_markdown(const std::vector<KeyInfo>& keys) {
  fmt::print("# Keys of case and fabric files\n\nMade by `plyform keys --markdown`. NAME stands "
             "for a name of your choice, [] for an item of a list. A fabric file has the keys "
             "below fabrics.NAME.\n");
  std::string table = "none";
  for (const KeyInfo& k : keys) {
    if (const std::string of = k.key.substr(0, k.key.find_first_of(".[")); of != table) {
      table = of;
      fmt::print("\n## {}\n\n| key | type, unit | default | range | meaning |\n"
                 "|---|---|---|---|---|\n",
                 table);
    }
    const std::string unit = k.unit.empty() || k.unit == "-" ? "" : ", " + k.unit;
    fmt::print("| `{}` | {} | {} | {} | {} |\n", k.key, cell(k.type + unit), cell(k.fallback),
               cell(k.range), cell(k.meaning));
  }
}

/// The table of units, a line each quantity; or for programs, what each is in mm, N, rad, N/mm2, s.
void print_units(bool json) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const std::string& name : unit_names())
    all.push_back({{"name", name},
                   {"quantity", quantity_name(find_unit(name)->quantity)},
                   {"factor", find_unit(name)->factor}});
  if (json) return fmt::print("{}\n", all.dump());
  for (const Quantity q :
       {Quantity::length, Quantity::force, Quantity::angle, Quantity::strain, Quantity::stretch,
        Quantity::force_per_length, Quantity::stress, Quantity::time})
    fmt::print("{}\n    {}\n", quantity_name(q), joined(unit_names(q)));
  fmt::print("force per length, stress and strain also as quotients: kgf/cm, lbf/in2, mm/m\n");
}

} // namespace

int keys_command(bool markdown, bool json, bool units) {
  if (units) {
    print_units(json);
    return exit_done;
  }
  const std::vector<KeyInfo> keys = case_keys();
  if (json)
    fmt::print("{}\n", case_keys_json());
  else if (markdown)
    print_markdown(keys);
  else
    for (const KeyInfo& k : keys)
      print_text(k);
  return exit_done;
}

} // namespace plyform
