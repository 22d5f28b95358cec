// SPDX-License-Identifier: GPL-3.0-or-later
#define PLYFORM_LANES 8
#include "core/ply/bending_simd_body.hpp"

namespace plyform {

void bending_kernel_avx512(const BendingKernelBlock& block, const BendingKernelLaw& law,
                           const double* x) {
  bending_kernel(block, law, x);
}

} // namespace plyform
