// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/input/keys/toml_tree.hpp"

#include <filesystem>
#include <string>

namespace plyform {

/// Text that is the same for two cases only if they have the same results: version of plyform,
/// every key with its value, fabric files in their places, and the content of all files that values
/// name (meshes), seen from the file that has the value, or from `folder` for an override.
std::string identity_of(const TomlNode& root, const std::filesystem::path& folder);

} // namespace plyform
