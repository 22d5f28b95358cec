// SPDX-License-Identifier: GPL-3.0-or-later
#define PLYFORM_LANES 8
#include "contact/simd/tool_ply_body.hpp"

namespace plyform {

ToolPlyKernelTotals tool_ply_kernel_avx512(const ToolPlyKernelContact& contact) {
  return tool_kernel(contact);
}

} // namespace plyform
