// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/version.hpp"

namespace plyform {

const char* version() {
  return PLYFORM_VERSION;
}

} // namespace plyform
