// SPDX-License-Identifier: GPL-3.0-or-later
// Contact points and constants of contact, as search, forces and kernels share them: plain numbers
// and no functions, since the kernels include this file (reason: base/simd.hpp).
//
// A kernel loads four numbers of a point at once. Points therefore consist of rows of 32 bytes,
// separated by the empty lines below; the kernels assert the offsets of the rows that they load.
#pragma once

#include "contact/face_across.hpp"
#include "contact/surface_hint.hpp"

#include <cstdint>

namespace plyform {

/// Lower limit of q in (E), (N) and (K) of contact/forces/contact_law.hpp, and the ratio
/// u = p / delta at which q reaches it. A contact deeper than that is a fault that ends the run;
/// the limit only keeps its force finite.
constexpr double least_remaining = 1e-3, deepest_valid = 0.9995;

/// Share of its remaining depth by which a contact may deepen in a step, at a depth of u:
/// step_share + shallow_share (1 - u)^5. From any depth the stiffness (K) then grows by 2.3 to 2.4
/// times, and with it energy is kept; with half of the remaining depth it grows by 8 times.
constexpr double step_share = 0.25, shallow_share = 0.14;

/// contact/forces/compaction_curve.hpp, as kernels see it.
struct CompactionTable {
  const double *pressure = nullptr, *energy = nullptr; ///< N/mm^2, N/mm, at the ends of pieces
  int pieces = 0;                                      ///< 0: there is none
  double per_spacing = 0.0;                            ///< 1/mm
  double packed = 0.0;                                 ///< mm
};

/// What a place that slides has, and what its law of friction goes by: the left side of (I) of
/// contact/forces/friction_law.hpp.
struct SlidingPlace {
  double stretch;         ///< S, mm
  double held;            ///< mm, |s| of the step before
  double stiffness;       ///< k_t, N/mm^3, per present area
  double pressure;        ///< p, N/mm^2
  double slip;            ///< mm, slid since it has touched
  double angle;           ///< f_a
  double area;            ///< mm^2, before forming
  double celsius;         ///< degC, of the film; NaN: not known
  double* kept = nullptr; ///< what its law keeps of the place (FrictionLaw::keeps); null: nothing
};

/// The law of a contact (contact/forces/contact_law.hpp) as kernels see it.
struct ContactKernelLaw {
  double stiffness, tangential, friction; ///< k, k_t, mu
  double max_depth, per_depth2;           ///< delta and 1/delta^2; finite
  double damping_per_dt;                  ///< c / dt, or 0
  double depth_limit;                     ///< mm, delta and what lies before the densest packing
  CompactionTable loading, unloading;     ///< unloading: no pieces where it goes back as it came
  double sliding_gap;                     ///< mm, of ContactLaw
  double* compacted; ///< mm, per slave node: greatest depth so far; null without `unloading`
  /// Returns |s| (mm) that is left of a stretch; null: Coulomb's law with one coefficient. Else
  /// `friction` only says that there is some.
  double (*stuck)(void* sliding, const SlidingPlace& place);
  void* sliding; ///< first argument of it
  bool keeps;    ///< whether it asks for SlidingPlace::kept
};

/// History variables of one contact.
struct ContactHistory {
  double s[3] = {};         ///< mm, (T) of contact/forces/contact_law.hpp
  double damping_force = 0; ///< N, of the last step, for the trapezoidal work sum

  double normal_force = 0; ///< N
  double slip = 0;         ///< mm, sliding distance since it closed
};

/// One node of a ply near a tool.
struct alignas(32) ToolPlyPoint {
  ContactHistory memory; ///< a row and a half
  double gap = 0.0;      ///< mm, distance minus half thickness; infinite: inactive
  double last_gap = 0.0; ///< mm, gap of the step before; if inactive, that when deactivated

  double normal[3] = {}; ///< unit normal in the global frame, when last measured
  std::int32_t node;

  SurfaceHint hint;
};

/// One slave node and one connected component of the master faces near it (a fold of the master has
/// two components, and so two points). h: contact/forces/ply_ply.hpp.
struct alignas(32) PlyPlyPoint {
  ContactHistory memory; ///< a row and a half
  double area = 0.0;     ///< mm^2, tributary area
  double gap = 0.0;      ///< mm, distance minus h, of the last step; infinite: inactive

  double w[2] = {};   ///< barycentric weights of corners b, c at the closest point
  double other = 0.0; ///< mm, distance at the search of the nearest face without a node of `face`
  float gap_when_deactivated = 0.0F; ///< mm
  std::int32_t node, face = 0;       ///< face: the closest; among equally close ones the lowest
  std::int32_t first_face, end_face; ///< range in PlyPlyContact::faces
  std::int32_t side = 0; ///< +1: on the side of the face normal, -1: opposite, 0: not known

  double by_angle = 1.0; ///< f_a of contact/forces/friction_law.hpp, at the last search
  double kept = 0.0;     ///< SlidingPlace::kept
};

} // namespace plyform
