// SPDX-License-Identifier: GPL-3.0-or-later
// In-plane law of a ply as a table of functions: of yarns (yarns_in_plane.cpp; membrane_simd.hpp
// computes several elements at a time) or of a sheet without yarns (sheet_in_plane.cpp).
#pragma once

#include "core/ply/membrane.hpp"

namespace plyform {

/// A law as functions of a membrane m and the positions x (mm) of its nodes.
struct InPlaneLaw {
  bool yarns; ///< whether strain groups may be pairs and the SIMD kernel can be used

  /// q of (Q) for groups [begin, end), as element_forces (core/ply/membrane.hpp).
  GroupReport (*forces)(const Membrane& m, std::span<const Vec3> x, double dt, int begin, int end,
                        const LawStates<YarnMemory>& states, std::span<ElementForce> q);
  /// (E) summed over all triangles, as membrane_energy.
  MembraneEnergy (*energy)(const Membrane& m, std::span<const Vec3> x,
                           std::span<const YarnMemory> states, double dt);
  /// Bound of the largest eigenvalue of H (G x I), N/mm^3, of a triangle of a sheet without yarns;
  /// null for yarns, whose bound is in membrane_eigenvalue.cpp.
  double (*stiffness)(const Membrane& m, const FibreState& s, const Gram& g);
};

extern const InPlaneLaw yarns_in_plane, sheet_in_plane;

inline const InPlaneLaw& in_plane_law(const Fabric& fabric) {
  return fabric.has_yarns() ? yarns_in_plane : sheet_in_plane;
}

} // namespace plyform
