// SPDX-License-Identifier: GPL-3.0-or-later
// What the element kernel must at least move and compute.
#pragma once

#include "core/ply/membrane_simd.hpp"
#include "tests/bench/machine.hpp"

namespace plyform {

/// One pass of simd_forces over all blocks and of simd_force over all nodes, each array once: nodes
/// that several blocks share are read again only out of a cache.
inline Traffic lane_traffic(const MembraneSimd& l, std::size_t nodes) {
  Traffic t = traffic(l.triangles->size(), sizeof(SimdTriangles));
  t += traffic(static_cast<std::size_t>(l.packs), sizeof(SimdYarnStates), 2.0); // read and written
  t += traffic(l.nodes.size(), sizeof(std::int32_t));
  t += traffic(nodes, sizeof(Vec3));                    // places
  t += traffic(l.force.size(), sizeof(SimdForce), 2.0); // written, then read and added up
  t += traffic(l.force_of.size(), sizeof(NodeForces));
  return t;
}

/// Operations on doubles a triangle, counted by hand in core/ply/membrane_simd_kernel.cpp for a
/// shear law of three terms and yarns of one stiffness; a division or a root counts as one.
inline double element_operations(bool averaged) {
  return averaged ? 183.0 : 168.0;
}

} // namespace plyform
