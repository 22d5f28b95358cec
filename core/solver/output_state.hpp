// SPDX-License-Identifier: GPL-3.0-or-later
// The state of a scene as results: per-ply fields and tool motion in the units of the outside.
#pragma once

#include "core/results/result_writer.hpp"
#include "core/solver/scene.hpp"

namespace plyform {

/// Fields at the scene's present positions. Forces and pressures are those of the last step.
Frame make_frame(const Scene& scene, const Energies& energy);

/// Contact pressure at every node of one ply, N/mm^2: the normal contact forces on either side of
/// the ply are added up apart; the larger sum over the node's area counts.
std::vector<double> contact_pressure(const Scene& scene, int ply);

/// How much of it is done, mm.
double current_stroke(const Scene& scene);

} // namespace plyform
