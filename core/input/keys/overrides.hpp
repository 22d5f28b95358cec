// SPDX-License-Identifier: GPL-3.0-or-later
// Applies --set KEY=VALUE to the entries of the file before they are checked.
#pragma once

#include "core/input/keys/case_keys.hpp"
#include "core/input/keys/toml_tree.hpp"

#include <filesystem>

namespace plyform {

/// Sets the value at a dotted path (list items by number from 0 or by name), and creates tables
/// along the path if the table of keys has them. A fabric given as a file is read first if the path
/// leads into it; `folder` is the case file's. Errors are reported in the file "--set".
void apply_override(TomlNode& root, const Override& change, const std::filesystem::path& folder,
                    Diagnostics& diagnostics);

/// Replaces the path of a fabric file by the table read from it. Reports an error at the path,
/// which then becomes invalid, if the file cannot be read. item: fabrics.NAME.
void load_fabric(TomlNode& entry, const std::string& item, const std::filesystem::path& folder,
                 Diagnostics& diagnostics);

/// load_fabric for all fabrics that are still paths.
void load_fabrics(TomlNode& root, const std::filesystem::path& folder, Diagnostics& diagnostics);

/// Resolves a path of an entry: relative to the file that contains it, for overrides to the case
/// file.
std::filesystem::path resolve_path(const TomlNode& entry, const std::filesystem::path& folder);

} // namespace plyform
