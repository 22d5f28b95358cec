// SPDX-License-Identifier: GPL-3.0-or-later
#define PLYFORM_LANES 8
#include "core/ply/membrane_simd_body.hpp"

namespace plyform {

KernelReport membrane_kernel_avx512(const KernelBlock& block, const KernelLaw& law, const double* x,
                                    double per_dt) {
  return membrane_kernel(block, law, x, per_dt);
}

KernelEnergy membrane_energy_avx512(const KernelBlock& block, const KernelLaw& law, const double* x,
                                    double per_dt) {
  return membrane_energy_kernel(block, law, x, per_dt);
}

} // namespace plyform
