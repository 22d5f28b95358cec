// SPDX-License-Identifier: GPL-3.0-or-later
// Element sizes that a scout has found, kept in the user's cache folder, so that `run` after
// `check` does not scout again: $XDG_CACHE_HOME/plyform, or ~/.cache/plyform. Their key is the
// identity of the case and the build of the program. What cannot be read or written there is not
// kept, and no error; the oldest go where all take too much.
#pragma once

#include "core/setup/scout.hpp"

#include <optional>
#include <string>

namespace plyform {

/// Sizes of the plies of this case, with what their scout has left unseen; its work is not kept.
std::optional<Scouted> kept_sizes(const std::string& identity, std::size_t plies);

void keep_sizes(const std::string& identity, const Scouted& scouted);

} // namespace plyform
