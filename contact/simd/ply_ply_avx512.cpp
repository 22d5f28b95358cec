// SPDX-License-Identifier: GPL-3.0-or-later
#define PLYFORM_LANES 8
#include "contact/simd/ply_ply_body.hpp"

namespace plyform {

PlyPlyKernelTotals ply_ply_kernel_avx512(const PlyPlyKernelContact& contact) {
  return sheet_kernel(contact);
}

} // namespace plyform
