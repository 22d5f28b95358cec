// SPDX-License-Identifier: GPL-3.0-or-later
// Interface of the compiled copies of the kernel of contact/forces/ply_ply.hpp: plain numbers
// and pointers, nothing inline (reason: base/simd.hpp).
#pragma once

#include "contact/simd/contact_points.hpp"

namespace plyform {

/// Input and output of the kernel. Positions (mm), motions (mm, in this step) and forces (N): 3
/// numbers per node.
struct PlyPlyKernelContact : ContactKernelLaw {
  PlyPlyPoint* points;
  const std::int32_t* active; ///< numbers of the active points
  int active_count;
  double* free_until; ///< mm, of the points (contact/search/active_list.hpp)
  const double *slave_x, *slave_motion, *master_x, *master_motion;
  const double* fold_bound; ///< of the master's faces (contact/search/fold_bound.hpp), or null
  /// 3 per face of the master, SheetEdges::faces_across; needed only with fold_bound
  const std::int32_t* faces_across;
  const std::int32_t* triangles; ///< 3 nodes per face of the master
  const std::int32_t* faces;     ///< of PlyPlyContact
  const float* face_distance;    ///< mm, of PlyPlyContact
  double *slave_force, *master_force;
  double max_displacement; ///< mm, RelativeMotion::max_displacement
  double path_length;      ///< mm (contact/search/active_list.hpp)
  double distance;         ///< mm, h before forming
  /// Present thickness over that before forming, of the nodes (both null: 1), and what share of h
  /// the slave has.
  const double *slave_ratio, *master_ratio;
  double slave_share;
  double per_vacuum_gap;                        ///< 1/mm, 1 / g_q of (V); 0: there is none
  double vacuum, vacuum_before;                 ///< N/mm^2, of PlyPlyContact
  const double *slave_area, *master_area;       ///< mm^2, of the nodes now
  const double *slave_celsius, *master_celsius; ///< degC, of the nodes; null: not asked for
  void* self;                                   ///< first argument of the callbacks
  /// Called if a point that carried force has opened; last_gap: mm, of the step before.
  void (*open)(void* self, std::int32_t point, double last_gap);
  /// Called if a point is on the other side of its face or too deep; `distance`: mm.
  void (*fault)(void* self, std::int32_t point, double distance);
};

/// Relative difference of squared distances below which two faces count as equally close. On a
/// common edge or corner they are; the couple of friction acts on one of them, and which one must
/// not depend on rounding.
constexpr double same_distance = 1e-10;

/// PlyPlyPoint::other (mm) of a point whose closest face is point.face: the distance at the search
/// of the nearest of its faces that shares no node with point.face; the largest double if there is
/// none. triangles, faces, face_distance: as of PlyPlyKernelContact.
double distance_of_others(const PlyPlyPoint& point, const std::int32_t* triangles,
                          const std::int32_t* faces, const float* face_distance);

/// ContactTotals of this step over the points: sums, maxima and minima.
struct PlyPlyKernelTotals {
  double elastic, friction, damping, compaction, vacuum, penetration, slip, step_ratio;
  int touching;
};

PlyPlyKernelTotals ply_ply_kernel_generic(const PlyPlyKernelContact& contact);
PlyPlyKernelTotals ply_ply_kernel_avx2(const PlyPlyKernelContact& contact);
PlyPlyKernelTotals ply_ply_kernel_avx512(const PlyPlyKernelContact& contact);

} // namespace plyform
