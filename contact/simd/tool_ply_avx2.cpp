// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/simd/tool_ply_body.hpp"

namespace plyform {

ToolPlyKernelTotals tool_ply_kernel_avx2(const ToolPlyKernelContact& contact) {
  return tool_kernel(contact);
}

} // namespace plyform
