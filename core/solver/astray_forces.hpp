// SPDX-License-Identifier: GPL-3.0-or-later
// Forces over edges that the mesh does not follow. Contact acts at nodes, along the tool's normal.
// Where elements are longer than an edge is round, a node before it turns the ply by half a right
// angle and more, and is pressed along the normal of the flat that it still lies on: the force has
// a part along the ply, which holds it back before the edge and pushes it on behind.
//
//   N    N    normal force of a node on a tool
//   phi  rad  between the tool's normal there and the ply's, the mean of the triangles at the node
//   S    N    sum of N sin(phi) over the nodes on a tool: forces astray
//   L    N    what draws the plies: the largest force of a driven tool or boundary, else of any
//
// Over an arc that a few nodes share, phi is a fraction of the turn from node to node. A strip
// drawn over an edge by elements of 2.5 mm has S/L of 1.2, 0.8, 1.1, 0.45, 0.15 and 0.12 over radii
// of 0, 0.5, 1.5, 2.5, 3.5 and 5 mm, and pulls off by 170, 170, 24, 3, 4 and 0.4 %; a draft of
// hemisphere_0 0.17.
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
