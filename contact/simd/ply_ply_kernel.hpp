// SPDX-License-Identifier: GPL-3.0-or-later
// The kernel of contact/forces/ply_ply.hpp as its two compiled copies see it: plain numbers and
// pointers, nothing inline (contact/simd/simd.hpp says why).
#pragma once

#include "contact/simd/contact_points.hpp"

namespace plyform {

/// What the kernel reads and writes of a contact. Positions, motions and forces: 3 a node.
struct PlyPlyKernelContact {
  PlyPlyPoint* points;
  const std::int32_t* active; ///< points to look at
  int active_count;
  double* free_until; ///< mm, of the points (contact/search/active_list.hpp)
  const double *slave_x, *slave_motion, *master_x, *master_motion;
  const double* fold_bound;      ///< of the master's faces (contact/search/fold_bound.hpp), or null
  const std::int32_t* triangles; ///< 3 a face of the master
  const std::int32_t* faces;     ///< of the points, nearest first
  const double* face_distance;   ///< mm, when the search was done
  double *slave_force, *master_force;
  double max_displacement; ///< mm, of anything relative to anything since the search
  double path_length;      ///< mm (contact/search/active_list.hpp)
  double slide_limit;      ///< mm, as of PlyPlyContact, or 0 in steps of a full search
  double distance, stiffness, tangential,
      friction;                 ///< h, k, k_t, mu of contact/forces/contact_law.hpp
  double max_depth, per_depth2; ///< delta and 1/delta^2 of it; finite
  double damping_per_dt;        ///< c / dt, or 0
  void* self;
  /// A point that held something has opened; last_gap: mm, of the step before.
  void (*open)(void* self, std::int32_t point, double last_gap);
  /// A point may be on the wrong side or too deep; `distance`: mm.
  void (*fault)(void* self, std::int32_t point, double distance);
};

/// Where faces meet they are as close as each other; the friction's couple goes to one of them, and
/// it must not be rounding that says which. Of the square of the distance.
constexpr double same_distance = 1e-10;

/// `other` of a point whose closest face is point.face: the distance at the search of the nearest
/// of its faces that shares no node with that one. triangles, faces, face_distance: as above.
double distance_of_others(const PlyPlyPoint& point, const std::int32_t* triangles,
                          const std::int32_t* faces, const double* face_distance);

/// Added up over the points that touch.
struct PlyPlyKernelTotals {
  double elastic, friction, damping, penetration, slip, step_ratio;
  int touching;
};

PlyPlyKernelTotals ply_ply_kernel_generic(const PlyPlyKernelContact& contact);
PlyPlyKernelTotals ply_ply_kernel_avx2(const PlyPlyKernelContact& contact);

} // namespace plyform
