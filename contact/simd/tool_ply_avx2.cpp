// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/simd/tool_ply_body.hpp"

namespace plyform {

ToolKernelSums tool_kernel_avx2(const ToolKernelContact& contact) {
  return tool_kernel(contact);
}

} // namespace plyform
