// SPDX-License-Identifier: GPL-3.0-or-later
// What a case will take, estimated before any mesh is made, and by the mesh that was: triangles,
// memory, time.
#pragma once

#include "core/mesh/mesh_blank.hpp"
#include "core/model/case.hpp"

namespace plyform {

struct SizeAhead {
  double triangles = 0.0; ///< of all plies; those of mesh files are not known and left out
  double bytes = 0.0;     ///< of memory, about
  double seconds = 0.0;   ///< of wall time, about
  int largest = 0;        ///< index of the blank with the most triangles
  // By a mesh that was made:
  double steps = 0.0;
  double smallest = 0.0;     ///< mm, least height of a triangle
  Vec2 where = Vec2::Zero(); ///< mm, on the blank, a corner of it
  std::size_t ply = 0;       ///< whose it is
};

/// threads: that share the work.
SizeAhead size_ahead(const Case& data, int threads);

/// The same by the meshes of the plies, one each. The step is that of the scene at its start, where
/// it matters: where that of the smallest triangle alone would be too small. Throws
/// std::runtime_error as make_scene.
SizeAhead size_of_meshes(const Case& data, const std::vector<BlankMesh>& meshes, int threads);

/// Steps of a run whose smallest elements in this ply are squares of that side, mm: by the time
/// that a wave of tension takes through one. 0 where the ply has no yarns.
double steps_ahead(const Case& data, const Ply& ply, double size);

/// Bytes of memory, about, that a run of the case with so many triangles of all plies takes at its
/// peak: the program's own, and what plies and meshes of tools take.
double bytes_for(const Case& data, double triangles);

/// Bytes of memory that this machine has, or what a container or a limit of the process leaves of
/// it.
double machine_memory();

/// More than half of the memory, or more than a day: nobody starts that by mistake and is happy.
bool too_large(const SizeAhead& size, double memory);

} // namespace plyform
