// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/ply/membrane_simd_body.hpp"

namespace plyform {

KernelReport membrane_kernel_generic(const KernelBlock& block, const KernelLaw& law,
                                     const double* x, double per_dt) {
  return membrane_kernel(block, law, x, per_dt);
}

KernelEnergy membrane_energy_generic(const KernelBlock& block, const KernelLaw& law,
                                     const double* x, double per_dt) {
  return membrane_energy_kernel(block, law, x, per_dt);
}

} // namespace plyform
