// SPDX-License-Identifier: GPL-3.0-or-later
// Which triangles are slivers for the search for closest points. Plain numbers: kernels include it.
#pragma once

namespace plyform {

/// Square of the sine of the angle at a below which a triangle is treated as a sliver. At 6 degrees
/// (1) of contact/point_triangle.hpp still has 1e-14; a fabric locks at 50 to 60 degrees of shear,
/// its triangles stay above 15.
constexpr double sliver_sine2 = 0.01;
/// Smallest det (mm^4), so that 1 / det stays finite: triangles of 1e-77 mm are slivers as well.
/// The smallest normal double.
constexpr double smallest_det = 2.2250738585072014e-308;

} // namespace plyform
