// SPDX-License-Identifier: GPL-3.0-or-later
// Interface of the compiled copies of the kernel of contact/forces/edge_edge.hpp: plain numbers
// and pointers, nothing inline (reason: base/simd.hpp).
#pragma once

#include <cstdint>

namespace plyform {

/// Pairs of edges to measure. Positions: mm, 3 numbers per node.
struct EdgeEdgeKernelPairs {
  const std::int32_t* nodes; ///< 4 per pair: of the edge of the first sheet, and of the second's
  int count;
  const double *first, *second; ///< positions of the nodes of each sheet
};

/// One pair of edges as segments: their distance, and their closest points if those lie inside
/// both.
struct EdgeEdgeDistance {
  double distance; ///< mm, >= 0
  double s, t;     ///< closest points of the lines, in 0..1 if side is not 0
  /// sign of (x2 - x1) x (x4 - x3) . (y_a - y_b) of edge_edge.hpp; 0 if the closest points are not
  /// inside both edges, or the edges within 0.6 degrees of parallel
  std::int64_t side;
};

/// Measures all pairs; distances: one each.
void edge_edge_kernel_generic(const EdgeEdgeKernelPairs& pairs, EdgeEdgeDistance* distances);
void edge_edge_kernel_avx2(const EdgeEdgeKernelPairs& pairs, EdgeEdgeDistance* distances);
void edge_edge_kernel_avx512(const EdgeEdgeKernelPairs& pairs, EdgeEdgeDistance* distances);

} // namespace plyform
