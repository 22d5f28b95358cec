// SPDX-License-Identifier: GPL-3.0-or-later
// The value that a case will run with, by its key.
#pragma once

#include "core/input/keys/toml_tree.hpp"
#include "core/setup/prepare_case.hpp"

namespace plyform {

/// What stands in the case for a key (a dotted path with list items by number from 0), after
/// overrides, or its default, in the units of the file; a cost parameter as it is picked where an
/// accuracy is asked for. Nothing if the case has no value for it, or the file cannot be read. A
/// key that does not exist is reported in `unknown`; other mistakes of the case are not.
std::optional<TomlNode> value_of_key(const std::filesystem::path& file,
                                     const std::vector<Override>& overrides, const std::string& key,
                                     Diagnostics& unknown);

} // namespace plyform
