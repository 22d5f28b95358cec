// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes of the same blank that differ from a given one: finer ones, and the same one in another
// order.
#pragma once

#include "core/mesh/mesh_blank.hpp"

namespace plyform {

/// Every triangle bisected once, at the middle of its longest side, and once or twice more where a
/// neighbour has cut another side: a conforming mesh of two to four times as many triangles
/// (exactly two where longest sides are shared, as in squares with diagonals). Nodes of the old
/// mesh keep their numbers; sides on the rim stay on it.
BlankMesh bisected(const BlankMesh& mesh);

/// The same triangles in another order, the same every time. Nodes keep their numbers.
BlankMesh renumbered(BlankMesh mesh);

} // namespace plyform
