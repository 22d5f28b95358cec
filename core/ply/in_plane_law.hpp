// SPDX-License-Identifier: GPL-3.0-or-later
// What a ply answers to stretch and shear in its plane, and the one place that chooses between
// yarns (yarns_in_plane.cpp; four at a time in membrane_simd.hpp) and a sheet without them
// (sheet_in_plane.cpp).
#pragma once

#include "core/ply/membrane.hpp"

namespace plyform {

/// A law as functions of a membrane m and the places x (mm) of its nodes.
struct InPlaneLaw {
  bool yarns; ///< then pairs of triangles may share strains, and the kernel computes four at a time

  /// q of (Q) for groups [begin, end), as element_forces (core/ply/membrane.hpp).
  GroupReport (*forces)(Membrane& m, std::span<const Vec3> x, double dt, int begin, int end,
                        std::span<ElementForce> q);
  /// Of all triangles.
  MembraneEnergy (*energy)(const Membrane& m, std::span<const Vec3> x);
  /// Bound of a triangle's largest eigenvalue of H (G x I), N/mm^3, of what is not yarns; null if
  /// yarns and their shear are all.
  double (*stiffness)(const Membrane& m, const FibreState& s, const Gram& g);
};

extern const InPlaneLaw yarns_in_plane, sheet_in_plane;

inline const InPlaneLaw& in_plane_law(const Fabric& fabric) {
  return fabric.has_yarns() ? yarns_in_plane : sheet_in_plane;
}

} // namespace plyform
