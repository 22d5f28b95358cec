// SPDX-License-Identifier: GPL-3.0-or-later
#define PLYFORM_LANES 8
#include "contact/simd/edge_edge_body.hpp"

namespace plyform {

void edge_edge_kernel_avx512(const EdgeEdgeKernelPairs& pairs, EdgeEdgeDistance* distances) {
  measure_edges(pairs, distances);
}

} // namespace plyform
