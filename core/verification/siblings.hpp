// SPDX-License-Identifier: GPL-3.0-or-later
// Siblings of a case: the same scene with other cost parameters, from whose differences the error
// of each is estimated (bands.hpp), and twins, which differ by nothing to speak of. Each differs
// from another run in one parameter. Where the mesh can be coarser (q = 2):
//
//   coarser    elements b times as large              against the run: mesh
//   faster     and the stroke in 1/q of the time      against `coarser`: inertia
//   softer     and twice the softening                against `faster`: softened fibres
//   twin       `faster` with a ply turned by 1e-3 deg, the first tool moved by 1e-3 of an element,
//              triangles of free meshes and files in another order    against `faster`: chance
//   late twin  the run from 0.6 of its time on, turned and moved as much    against the run: chance
//   later twin likewise from 0.8 on, the other way, if the others have left time for it
//
// Where it cannot (tools rounder than their radius allows, a mesh from a file, boundaries that
// would hold other nodes, bending that needs this mesh):
//
//   faster     the stroke in 1/q of the time          against the run: inertia
//   finer      and elements b times as large, b < 1; a mesh from a file bisected
//                                                     against `faster`: mesh
//   softer, late twins (from 0.75 and 0.85) as above
//
// Where twice the softening does nothing, as yarns bear compression, half of what acts in its
// place. With b = 1.4 and q = 2 they cost 0.40, 0.20, 0.14 (0.28), 0.20, 0.45 and 0.2 of the run;
// in the second set q is such that all cost 1.2.
#pragma once

#include "core/mesh/mesh_blank.hpp"
#include "core/model/case.hpp"

#include <string>
#include <vector>

namespace plyform {

struct Scene;

enum class Cause { mesh, inertia, softening, chance, late_chance, later_chance };

struct Sibling {
  Cause cause;
  std::string name;
  Case data;
  std::vector<BlankMesh> meshes; ///< of its plies
  double from = 0.0;             ///< share of the time at which it leaves the run; 0: the start
  Vec3 move = Vec3::Zero();      ///< mm, of its first tool that moves
};

struct Siblings {
  std::vector<Sibling> runs; ///< in the order above
  /// b, of the mesh's sibling over what it is compared with; 1: there is none.
  double coarsening = 1.0;
  /// resolves_all (no_band.hpp) of the run's mesh, and no pressure or closed mould forms plies.
  bool resolved = true;
  double speed = 2.0; ///< q
  /// Error over difference; below 0: the sibling is stiffer, and has half of the error; 0: no fibre
  /// is softened, so that there is no such error.
  double softening = 1.0;
  std::vector<std::string> left_out; ///< what has no sibling, or another one, and why, a sentence
};

/// The siblings of a case. b is the largest of 1.4, 1.3, 1.2 that the mesh takes: tools, outlines
/// and boundaries, and 1.8 elements in each transition zone of in-plane bending
/// (bending_resolution.hpp asks for 2.5; with 1.4 equal runs differ by degrees). meshes: of the
/// run's plies; if empty, they are meshed here.
Siblings siblings_of(const Case& data, const std::vector<BlankMesh>& meshes = {});

/// Moves the first tool that moves, of a scene of this case that has not begun, by `by` (mm).
void move_first_tool(const Case& data, const Vec3& by, Scene& scene);

} // namespace plyform
