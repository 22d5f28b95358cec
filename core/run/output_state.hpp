// SPDX-License-Identifier: GPL-3.0-or-later
// The state of a scene as results: fields of the plies and motion of the tools, in output units.
#pragma once

#include "base/thread_pool.hpp"
#include "core/results/result_writer.hpp"
#include "core/solver/scene.hpp"

namespace plyform {

/// The surfaces of the tools in space at time 0, for pictures: they stay as they are for a run.
std::vector<TriMesh> tool_surfaces(const Scene& scene, ThreadPool& pool);

/// Fields at the scene's present positions, of a part (Case::part_at) without wrinkles. Forces and
/// pressures are those of the last step. surfaces: of tool_surfaces.
Frame make_frame(const Scene& scene, const std::vector<TriMesh>& surfaces, const Energies& energy,
                 ThreadPool& pool);

/// Looks for wrinkles in all plies of a frame.
void add_wrinkles(const Scene& scene, ThreadPool& pool, Frame& frame);

/// Contact pressure at every node of one ply, N/mm^2: the normal contact forces on the two sides of
/// the ply are summed separately; the larger sum is divided by the node's area.
std::vector<double> contact_pressure(const Scene& scene, int ply);

/// Present displacement of the first driven tool, or else boundary, along its stroke, mm.
double current_stroke(const Scene& scene);

} // namespace plyform
