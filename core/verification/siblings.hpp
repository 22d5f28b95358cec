// SPDX-License-Identifier: GPL-3.0-or-later
// Siblings of a case: the same scene with coarser cost parameters, from whose differences the error
// of each is estimated (bands.hpp). Each differs from another run in one parameter:
//
//   coarser   elements b times as large            against the run: mesh
//   faster    and the stroke in 1/q of the time    against `coarser`: inertia
//   softer    and twice the softening              against `faster`: softened fibres
//   twin      `faster`, one ply turned by 1e-6 deg against `faster`: chance
//
// With b = 1.4 and q = 2 they cost 0.40, 0.20, 0.14 and 0.20 of the run.
#pragma once

#include "core/model/case.hpp"

#include <string>
#include <vector>

namespace plyform {

enum class Cause { mesh, inertia, softening, chance };

struct Sibling {
  Cause cause;
  std::string name;
  Case data;
};

struct Siblings {
  std::vector<Sibling> runs;         ///< in the order above
  double coarsening = 1.0;           ///< b; 1: no coarser sibling
  double speed = 2.0;                ///< q
  std::vector<std::string> left_out; ///< causes without a sibling, and why, a sentence each
};

/// The siblings of a case with a stroke. b is the largest of 1.4, 1.3, 1.2 that the mesh takes:
/// tools, outlines and grips as in may_coarsen, and 1.8 elements in each transition zone of
/// in-plane bending (bending_resolution.hpp asks for 2.5; with 1.4 equal runs differ by degrees).
Siblings siblings_of(const Case& data);

} // namespace plyform
