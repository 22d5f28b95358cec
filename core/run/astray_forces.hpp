// SPDX-License-Identifier: GPL-3.0-or-later
// Forces over edges that the mesh does not follow. Contact acts at nodes, along the tool's normal.
// Where elements are longer than an edge is round, a node before it turns the ply by half a right
// angle and more, and is pressed along the normal of the flat that it still lies on: the force has
// a part along the ply, which holds it back before the edge and pushes it on behind.
//
//   N    N    normal force of a node on a tool
//   phi  rad  between the tool's normal there and the ply's, the mean of the triangles at the node
//   S    N    sum of N sin(phi) over the nodes on a tool: forces astray
//   L    N    what draws the plies: the largest force of a driven tool or boundary, or of the
//             pressure on a ply over its whole face, else of any tool
//
// Over an arc that a few nodes share, phi is a fraction of the turn from node to node. A strip that
// elements of 2.5 mm draw over an edge has S/L of 0.5, 0.26 and 0.32 over radii of 0, 0.5 and 1.5
// mm, where its pull is 2.7, 2.6 and 0.75 times what it should be, and under 0.2 over 5 and 8 mm,
// where that is right to 1 %.
#pragma once

#include "core/solver/scene.hpp"

#include <vector>

namespace plyform {

/// S / L of one tool at each output so far.
using AstrayForce = std::vector<double>;

/// The median of the later half of the outputs, as single ones catch a ply that swings; 0 if there
/// are none.
double astray_share(const AstrayForce& astray);

/// S of each tool, N, for the last forces computed.
std::vector<double> forces_astray(const Scene& scene);

/// To be called at each output: adds to what is of each tool.
void follow_astray_forces(const Scene& scene, std::vector<AstrayForce>& astray);

} // namespace plyform
