// SPDX-License-Identifier: GPL-3.0-or-later
// Forces at the rims of tools. Contact acts at nodes, each with the whole area of its own: at a
// node beside the rim of a tool that ends there, as a platen smaller than the plies, the rim covers
// a part of it alone, or of areas beyond. What that makes of a force through the thickness is
// measured here by the share of each triangle that the tool lies over.
#pragma once

#include "core/solver/scene.hpp"

#include <string>
#include <vector>

namespace plyform {

/// Doubts about forces of tools whose rims lie within plies.
std::vector<std::string> doubts_of_rims(const Scene& s);

} // namespace plyform
