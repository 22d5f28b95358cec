// SPDX-License-Identifier: GPL-3.0-or-later
// Forces at the rims of tools. Contact acts at nodes, each with the whole area of its own: at a
// node beside the rim of a tool that ends there, as a platen smaller than the plies, the rim covers
// a part of it that the mesh does not tell. So a force through the thickness is known to half of
// what acts at such nodes.
#pragma once

#include "core/solver/scene.hpp"

#include <string>
#include <vector>

namespace plyform {

/// N, of each tool: what acts on plies that give way through their thickness at nodes beside which
/// another is past the tool's rim.
std::vector<double> rim_forces(const Scene& s);

/// Doubts about forces of tools whose rims lie within plies.
std::vector<std::string> doubts_of_rims(const Scene& s);

} // namespace plyform
