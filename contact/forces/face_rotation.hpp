// SPDX-License-Identifier: GPL-3.0-or-later
// Rotation of a triangular face in a step, and the nodal forces equivalent to a couple on it.
//
//   n      -     unit normal of the face;  g_j  1/mm  gradient of the shape function of corner j
//   u_j    mm    motions of the corners in a step
//   dn   = - sum_j g_j (n . u_j)                                        change of the normal
//   turn = n x dn + 1/2 [ sum_j (g_j x u_j) . n ] n                     rad, of the face   (W)
//   F_j  = - [ g_j . (C x n) ] n + 1/2 (C . n) n x g_j                  from a couple C    (C)
//
// (W) is exact when the face moves as a rigid body. (C) is the derivative of turn . C with respect
// to u_j, so that the F_j do the work of the couple; hence sum F_j = 0 and sum x_j x F_j = C.
#pragma once

#include "base/geometry.hpp"

namespace plyform {

struct FaceFrame {
  Vec3 normal;
  std::array<Vec3, 3> gradient; ///< 1/mm
};

/// a, b, c: corners, mm; the area must not be zero.
inline FaceFrame face_frame(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 area = (b - a).cross(c - a);
  const double twice = area.norm();
  const Vec3 n = area / twice;
  return {n, {n.cross(c - b) / twice, n.cross(a - c) / twice, n.cross(b - a) / twice}};
}

/// Rotation (W), rad, of a face. u: displacements of its corners in the step, mm.
inline Vec3 face_turn(const FaceFrame& f, const std::array<Vec3, 3>& u) {
  Vec3 dn = Vec3::Zero();
  double spin = 0.0;
  for (std::size_t j = 0; j < 3; ++j) {
    dn -= f.normal.dot(u[j]) * f.gradient[j];
    spin += 0.5 * f.gradient[j].cross(u[j]).dot(f.normal);
  }
  return f.normal.cross(dn) + spin * f.normal;
}

/// Forces (C) on the corners, N, for a couple in N mm.
inline std::array<Vec3, 3> forces_of_couple(const FaceFrame& f, const Vec3& couple) {
  const Vec3 across = couple.cross(f.normal);
  const double spin = 0.5 * couple.dot(f.normal);
  std::array<Vec3, 3> force;
  for (std::size_t j = 0; j < 3; ++j)
    force[j] = -f.gradient[j].dot(across) * f.normal + spin * f.normal.cross(f.gradient[j]);
  return force;
}

} // namespace plyform
