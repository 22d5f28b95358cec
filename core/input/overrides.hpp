// SPDX-License-Identifier: GPL-3.0-or-later
// --set KEY=VALUE, done to the entries of the file before they are checked.
#pragma once

#include "core/input/case_file.hpp"
#include "core/input/toml_tree.hpp"

#include <filesystem>

namespace plyform {

/// Puts the value where the dotted path says (list items by number from 0), makes the tables on
/// the way if the table of keys knows them. A fabric given as a file is read first if the path
/// leads into it; `folder` is the case file's. Mistakes are reported in the file "--set".
void apply_override(TomlNode& root, const Override& change, const std::filesystem::path& folder,
                    Diagnostics& diagnostics);

/// Puts the table read from a fabric file in the place of its path; a file that cannot be read is
/// reported at the path, which is then not sound. `item`: fabrics.NAME.
void load_fabric(TomlNode& entry, const std::string& item, const std::filesystem::path& folder,
                 Diagnostics& diagnostics);

/// The same for all fabrics that are still paths.
void load_fabrics(TomlNode& root, const std::filesystem::path& folder, Diagnostics& diagnostics);

/// Where a path written in an entry leads: beside the file it stands in, and for overrides beside
/// the case file.
std::filesystem::path resolve_path(const TomlNode& entry, const std::filesystem::path& folder);

} // namespace plyform
