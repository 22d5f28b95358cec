// SPDX-License-Identifier: GPL-3.0-or-later
// The curve that a fabric should give in a shear test.
#pragma once

#include "base/diagnostics.hpp"
#include "tools/identify/arguments.hpp"

namespace plyform {

/// arguments.points + 1 rows from 0 to arguments.to, each vector as long.
struct TheoryCurve {
  std::vector<double> displacement, shear_deg, force; ///< mm, degrees, N
  double bending = 0.0;                               ///< share of the load, of in-plane bending
  bool stitched = false;                              ///< stitches pull beside the crossing
};

/// Reports errors of the fabric, the sizes and the range, and returns nothing then.
std::optional<TheoryCurve> theory_curve(const TheoryArguments& arguments, Diagnostics& diagnostics);

} // namespace plyform
