// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/setup/key_value.hpp"

#include "core/input/keys/entries.hpp"

namespace plyform {
namespace {

/// Puts the cost parameters of the picked case (each has the unit of the file) into the entries.
void put_cost_parameters(TomlNode& root, const Case& picked) {
  const auto put = [](TomlNode* entry, double value) {
    if (entry && entry->number != value)
      entry->kind = TomlNode::Kind::number, entry->number = value;
  };
  if (TomlNode* solver = root.find("solver")) {
    put(solver->find("duration"), picked.solver.duration);
    put(solver->find("fibre_softening"), picked.solver.fibre_softening);
  }
  TomlNode* blanks = root.find("blanks");
  for (std::size_t b = 0; blanks && b < blanks->children.size(); ++b)
    put(blanks->children[b].find("element_size"), picked.blanks[b].element_size);
}

} // namespace

std::optional<TomlNode> value_of_key(const std::filesystem::path& file,
                                     const std::vector<Override>& overrides, const std::string& key,
                                     Diagnostics& unknown) {
  Diagnostics mistakes;
  std::optional<TomlNode> entries = read_entries(file, overrides, mistakes);
  if (!entries) return std::nullopt;
  if (const PickedCase picked = pick_case(file, overrides); picked.reading.value)
    put_cost_parameters(*entries, *picked.reading.value);
  const TomlNode* found = find_entry(*entries, key, unknown);
  return found ? std::optional(*found) : std::nullopt;
}

} // namespace plyform
