// SPDX-License-Identifier: GPL-3.0-or-later
// Linearised contact forces under small displacements, with sticking friction: the contribution of
// contact to K and C of M x'' + C x' + K x = 0, whose largest eigenvalue limits the stable time
// step (core/solver/stable_time_step.hpp).
//
//   y   mm    displacements of the nodes
//   n   -     unit normal of the contact;  G y = sum of share_i y_i    mm
//   slip      tangential part of G y - turn x r                        (P) of ply_ply.hpp
//   F_i = share_i [ along n (n . G y) + across slip ], and on the corners of the face also the
//         forces of the couple (M) of ply_ply.hpp (L)
#pragma once

#include "contact/forces/edge_edge.hpp"
#include "contact/forces/face_rotation.hpp"
#include "contact/forces/ply_ply.hpp"
#include "contact/forces/tool_ply.hpp"

#include <optional>
#include <span>
#include <vector>

namespace plyform {

/// Arm and face of the couple that friction between a node and a face exerts on the face.
struct TangentCouple {
  Vec3 arm; ///< mm
  FaceFrame face;
};

/// One contact, linearised, between up to four nodes: the first `own` of them are nodes of the
/// slave (or the only) sheet, the rest, up to `nodes`, of the other.
struct ContactTangent {
  std::array<std::int32_t, 4> node{};
  std::array<double, 4> share{};
  int own = 1, nodes = 1;
  Vec3 normal = Vec3::Zero();
  std::optional<TangentCouple> couple;
  double along = 0.0, across = 0.0; ///< N/mm
};

/// Factors of the stiffness and of the damping in the sum that makes up ContactTangent::along and
/// ContactTangent::across (damping: 1/s).
struct TangentFactors {
  double stiffness = 1.0, damping = 0.0;
};

/// Appends to `springs` the contacts that are closed, or whose last measured gap is <= margin (mm).
void append_tangents(const ToolPlyContact& contact, const SurfaceKinematics& ply, double margin,
                     const TangentFactors& factors, std::vector<ContactTangent>& springs);
void append_tangents(const PlyPlyContact& contact, const SurfaceKinematics& slave,
                     const SurfaceKinematics& master, std::span<const Triangle> master_triangles,
                     double margin, const TangentFactors& factors,
                     std::vector<ContactTangent>& springs);
void append_tangents(const EdgeEdgeContact& contact, const SurfaceKinematics& a,
                     const SurfaceKinematics& b, double margin, const TangentFactors& factors,
                     std::vector<ContactTangent>& springs);

/// Adds (L), N, to the forces of both sheets. own_y, other_y: displacements of all nodes of the
/// slave (or the only) and of the other sheet, mm; for self-contact both are the same sheet.
void add_tangent_forces(std::span<const ContactTangent> springs, std::span<const Vec3> own_y,
                        std::span<const Vec3> other_y, std::span<Vec3> own_force,
                        std::span<Vec3> other_force);

} // namespace plyform
