// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/input/keys/toml_tree.hpp"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace plyform {

/// What a case has, defaults included, in the order of its file: dotted keys (list items by their
/// names, else by number) and values in the file's units, as text: numbers with the digits that
/// tell them from all others, lists of values as [a, b], long ones shortened. Fabric files are in
/// their places. The value that names a file ends with that file's size and a checksum, so that two
/// runs can be told apart by it; `folder` is where overrides look for files.
std::vector<std::pair<std::string, std::string>> given_values(const TomlNode& root,
                                                              const std::filesystem::path& folder);

} // namespace plyform
