// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/simd/ply_ply_body.hpp"

namespace plyform {

SheetKernelSums sheet_kernel_avx2(const SheetKernelContact& contact) {
  return sheet_kernel(contact);
}

} // namespace plyform
