// SPDX-License-Identifier: GPL-3.0-or-later
// Sums and extremes of fields. Area-weighted quantities use the areas before forming, so that they
// do not depend on local mesh refinement. A NaN among the values makes every result NaN.
#pragma once

#include <vector>

namespace plyform {

/// The largest value; NaN for none.
double largest(const std::vector<double>& values);

/// The smallest value; NaN for none.
double smallest(const std::vector<double>& values);

/// The largest |value|; 0 for none.
double largest_magnitude(const std::vector<double>& values);

/// The smallest |value| that is not exceeded on `share` (0 to 1) of the area; 0 for none. Sizes: m
/// values, m areas.
double percentile(const std::vector<double>& values, const std::vector<double>& areas,
                  double share);

/// sqrt(sum A v^2 / sum A); 0 for none. Sizes: m values, m areas.
double root_mean_square(const std::vector<double>& values, const std::vector<double>& areas);

/// Fraction of the area where the value exceeds the limit; 0 without area. Sizes: m values, m
/// areas.
double area_share_above(const std::vector<double>& values, double limit,
                        const std::vector<double>& areas);

} // namespace plyform
