// SPDX-License-Identifier: GPL-3.0-or-later
// Interface of the compiled copies of the kernel of contact/forces/tool_ply.hpp: plain numbers
// and pointers, nothing inline (reason: base/simd.hpp).
#pragma once

#include "contact/simd/contact_points.hpp"

namespace plyform {

/// Input and output of the kernel. Motions and forces: 3 numbers per node.
struct ToolPlyKernelContact : ContactKernelLaw {
  ToolPlyPoint* points; ///< gaps and normals are those of this step, before the tool's advance
  const std::int32_t* active; ///< numbers of the active points
  int active_count;
  const double* area;            ///< mm^2, of the nodes
  const double* motion;          ///< mm, of the nodes in this step
  double* force;                 ///< N, on the nodes
  double tool_motion[3];         ///< mm, in this step
  double advance[3];             ///< mm, of the tool since the gaps were measured
  const double* thickness_ratio; ///< r, of the nodes; null: 1
  const double* celsius;         ///< degC, of the nodes; null: not asked for
  double tool_celsius;           ///< degC
  double* kept_at;               ///< SlidingPlace::kept of nodes, if the law asks for it
};

/// ContactTotals of this step over the points: sums, maxima and minima. on_nodes: sum of the forces
/// on the nodes, N.
struct ToolPlyKernelTotals {
  double elastic, friction, damping, compaction, penetration, slip, step_ratio;
  int touching;
  double on_nodes[3];
};

ToolPlyKernelTotals tool_ply_kernel_generic(const ToolPlyKernelContact& contact);
ToolPlyKernelTotals tool_ply_kernel_avx2(const ToolPlyKernelContact& contact);
ToolPlyKernelTotals tool_ply_kernel_avx512(const ToolPlyKernelContact& contact);

} // namespace plyform
