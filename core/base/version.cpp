// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/version.hpp"

namespace plyform {

const char* version() {
  return PLYFORM_VERSION;
}

} // namespace plyform
