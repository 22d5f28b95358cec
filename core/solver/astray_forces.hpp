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
// Over an arc that a few nodes share, phi is a fraction of the turn from node to node. Drawn over
// an edge with friction, tensions are within a percent where S stays under a twentieth of L.
#pragma once

#include "core/solver/scene.hpp"

#include <vector>

namespace plyform {

/// Sums over the outputs so far, of one tool, N: of S and of L.
struct AstrayForce {
  double astray = 0.0, load = 0.0;
  double share() const { return load > 0.0 ? astray / load : 0.0; }
};

/// S of each tool, N, for the last forces computed.
std::vector<double> forces_astray(const Scene& scene);

/// To be called at each output: adds to what is of each tool.
void follow_astray_forces(const Scene& scene, std::vector<AstrayForce>& astray);

} // namespace plyform
