// SPDX-License-Identifier: GPL-3.0-or-later
// What a case says by its keys: the file with its fabric files in their places, overrides done,
// defaults filled in.
#pragma once

#include "core/input/keys/case_keys.hpp"
#include "core/input/keys/toml_tree.hpp"

#include <filesystem>

namespace plyform {

/// The entries of a case file, checked against the table of keys: what is wrong is reported and
/// marked as not valid. Nothing if the file cannot be read or is no TOML.
std::optional<TomlNode> read_entries(const std::filesystem::path& file,
                                     const std::vector<Override>& overrides,
                                     Diagnostics& diagnostics);

/// The entry of a key, a dotted path with list items by number from 0 or by name. Null if the case
/// has none: a key without default that is not given. Null and a report (place: column within the
/// key) if the table of keys has no such key, or a list no such item.
const TomlNode* find_entry(TomlNode& root, const std::string& key, Diagnostics& diagnostics);

} // namespace plyform
