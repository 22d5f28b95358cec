// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/tool_kernel_body.hpp"

namespace plyform {

ToolKernelSums tool_kernel_any(const ToolKernelContact& contact) {
  return tool_kernel(contact);
}

} // namespace plyform
