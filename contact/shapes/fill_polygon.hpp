// SPDX-License-Identifier: GPL-3.0-or-later
// Area of a polygon, and triangles between its corners.
#pragma once

#include "base/geometry.hpp"

namespace plyform {

/// Area (mm^2), positive if the corners go round anticlockwise.
double area_of(const std::vector<Vec2>& polygon);

/// Anticlockwise triangles between the corners (mm) of a simple polygon, which may go round either
/// way. Of one that crosses itself: triangles of the parts that an odd number of sides shut off.
std::vector<Triangle> fill_polygon(const std::vector<Vec2>& polygon);

} // namespace plyform
