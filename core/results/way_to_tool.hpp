// SPDX-License-Identifier: GPL-3.0-or-later
// Where a straight line meets the surface of a tool.
#pragma once

#include "contact/forces/tool_ply.hpp"

namespace plyform {

/// How far (mm) the surface of a tool lies from x along the unit vector d, at most `most`: negative
/// where x is in the tool, infinite where the line meets none. To a thousandth of `most`.
double way_to_tool(const ToolBody& tool, const Vec3& x, const Vec3& d, double most);

} // namespace plyform
