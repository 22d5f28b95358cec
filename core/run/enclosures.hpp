// SPDX-License-Identifier: GPL-3.0-or-later
// Whether two plies with a load between them enclose what it acts on. The pressure on a sheet has
// the resultant p times its vector area, which its border alone decides; two sheets with the same
// border have opposite ones, whatever lies between. What is left over is a force that no vacuum
// has, but for what a symmetry plane bears along its normal.
//
// Where two sheets of different meshes touch each other under a load between them, contact of nodes
// with faces presses the nodes of one unevenly (docs/tried.md). Limp sheets then dent at single
// nodes. How far a node stands out is its distance from the middle of those around it, along its
// normal, less the mean of these distances of those around it, which a bent sheet has everywhere.
#pragma once

#include "core/solver/scene.hpp"

#include <string>
#include <vector>

namespace plyform {

/// Doubts about loads between two plies whose borders have parted, or which dent each other.
std::vector<std::string> doubts_of_enclosures(const Scene& s);

} // namespace plyform
