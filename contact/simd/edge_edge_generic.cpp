// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/simd/edge_edge_body.hpp"

namespace plyform {

void edge_edge_kernel_generic(const EdgeEdgeKernelPairs& pairs, EdgeEdgeDistance* distances) {
  measure_edges(pairs, distances);
}

} // namespace plyform
