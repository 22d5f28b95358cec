// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace plyform {

/// "major.minor.patch", the version of CMakeLists.txt.
const char* version();

} // namespace plyform
