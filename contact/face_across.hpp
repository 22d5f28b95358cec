// SPDX-License-Identifier: GPL-3.0-or-later
// What stands in place of the number of the face across an edge. Plain numbers: kernels include it.
#pragma once

#include <cstdint>

namespace plyform {

/// There is none; there is more than one.
constexpr std::int32_t no_face = -1, several_faces = -2;

} // namespace plyform
