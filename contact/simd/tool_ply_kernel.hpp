// SPDX-License-Identifier: GPL-3.0-or-later
// The force law of contact/forces/tool_ply.hpp as its two compiled copies see it: plain numbers and
// pointers, nothing inline (contact/simd/simd.hpp says why).
#pragma once

#include "contact/simd/contact_points.hpp"

namespace plyform {

/// What the kernel reads and writes of a contact. Motions and forces: 3 a node.
struct ToolPlyKernelContact {
  ToolPlyPoint* points; ///< gaps and normals are those of this step, before the tool's advance
  const std::int32_t* active; ///< points to look at
  int active_count;
  const double* area;                     ///< mm^2, of the nodes
  const double* motion;                   ///< mm, of the nodes in this step
  double* force;                          ///< N, on the nodes
  double tool_motion[3];                  ///< mm, in this step
  double advance[3];                      ///< mm, of the tool since the gaps were measured
  double stiffness, tangential, friction; ///< k, k_t, mu of contact/forces/contact_law.hpp
  double max_depth, per_depth2;           ///< delta and 1/delta^2 of it; finite
  double damping_per_dt;                  ///< c / dt, or 0
};

/// Added up over the points that touch; `on_nodes`: their forces.
struct ToolPlyKernelTotals {
  double elastic, friction, damping, penetration, slip, step_ratio;
  int touching;
  double on_nodes[3];
};

ToolPlyKernelTotals tool_ply_kernel_generic(const ToolPlyKernelContact& contact);
ToolPlyKernelTotals tool_ply_kernel_avx2(const ToolPlyKernelContact& contact);

} // namespace plyform
