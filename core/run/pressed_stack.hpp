// SPDX-License-Identifier: GPL-3.0-or-later
// Tools that press the plies between them. Where two tools whose places are prescribed leave less
// room than the plies are thick, nothing gives way but contact: the force is then that of its
// stiffness, a number of the solver, not of cloth, if the plies' fabrics do not say how they give
// way (Fabric::compaction), or are pressed beyond what they say. A tool pushed by a force, as a
// blank-holder, passes on what it is given.
//
//   N  N  normal force of a contact;  side: above or below a ply, by its normals
//   a node passes on to its other side no more than the smaller sum of N of both; what comes from
//   a tool does so in its share of the sum on its side, and leaves in the shares of the contacts of
//   the other side: to another tool, or to nodes of the next ply; nothing passes through a contact
//   that is inside its compaction curve, as that says what it bears                             (1)
#pragma once

#include "core/results/summary.hpp"
#include "core/solver/scene.hpp"

#include <vector>

namespace plyform {

/// N, per tool: what passes by (1) straight through the plies to another tool, both with prescribed
/// places; 0 of pushed tools. For the last forces computed.
std::vector<double> forces_through_plies(const Scene& scene);

/// To be called at each output, with stroke (mm) and time (s) of the one before: ends what is known
/// of the tools more than a tenth of whose force passes straight through the plies.
void follow_known_forces(const Scene& scene, double stroke_mm, double time_s,
                         std::vector<KnownForce>& known);

} // namespace plyform
