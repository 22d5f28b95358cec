// SPDX-License-Identifier: GPL-3.0-or-later
// Points and constants of contact, as search, forces and kernels share them: plain numbers and no
// functions, since the kernels include this file (contact/simd/simd.hpp says why).
//
// A kernel loads four numbers of a point at once. Points therefore consist of rows of 32 bytes,
// told apart by the empty lines below; the kernels assert what they take for a row.
#pragma once

#include <cstdint>

namespace plyform {

/// q of (E), contact/forces/contact_law.hpp, at least, and the depth over delta where that is: what
/// is deeper is a fault, whose force need not be right, only finite.
constexpr double least_room = 1e-3, deepest_sound = 0.9995;

/// What one contact remembers from step to step.
struct ContactHistory {
  double s[3] = {};         ///< mm, (T) of contact/forces/contact_law.hpp
  double damping_force = 0; ///< N, of the last step, for the trapezoidal work sum

  double normal_force = 0; ///< N
  double slip = 0;         ///< mm, way slid since it touched
};

/// One node of a ply near a tool.
struct alignas(32) ToolPlyPoint {
  ContactHistory memory; ///< a row and a half
  double gap = 0.0;      ///< mm, distance minus half thickness; infinite: inactive
  double last_gap = 0.0; ///< mm, gap of the step before; of an inactive point: when deactivated

  double normal[3] = {};        ///< in space, of this step or when it was last measured
  std::int32_t node, hint = -1; ///< hint: memory of signed_distance
};

/// One slave node and one connected patch of master faces near it (two patches: a fold); h:
/// contact/forces/ply_ply.hpp.
struct alignas(32) PlyPlyPoint {
  ContactHistory memory; ///< a row and a half
  double area = 0.0;     ///< mm^2 that the contact stands for
  double gap = 0.0;      ///< mm, distance minus h, of the last step; infinite: inactive

  double w[2] = {};                ///< weights of corners b and c at the closest point
  double last_search_foot[2] = {}; ///< weights of b and c at its foot on the face's plane, when all
                                   ///< its faces were last searched

  double other = 0.0; ///< mm, at the search, to the next face that shares no node with `face`
  float gap_when_deactivated = 0.0F; ///< mm
  std::int32_t node, face = 0;       ///< closest face; of those that tie the first
  std::int32_t first_face, end_face; ///< range in PlyPlyContact::faces
  std::int32_t side = 0; ///< +1: on the side of the face normal, -1: other, 0: not known
};

} // namespace plyform
