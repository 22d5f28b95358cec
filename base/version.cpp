// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/version.hpp"

namespace plyform {

const char* version() {
  return PLYFORM_VERSION;
}

} // namespace plyform
