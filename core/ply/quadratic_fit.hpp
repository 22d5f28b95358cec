// SPDX-License-Identifier: GPL-3.0-or-later
// The quadratic polynomial nearest to values at nodes.
#pragma once

#include "base/geometry.hpp"

#include <span>
#include <vector>

namespace plyform {

/// Weights of each node (columns) in the value, the derivatives d/d1, d/d2 and the second
/// derivatives d2/d11, d2/d22, d2/d12 of the polynomial at its origin (rows); mm.
struct QuadraticFit {
  Eigen::MatrixXd rows;
  bool determined; ///< whether the nodes determine it; if not, what they leave open is zero
};

/// Nodes nearer to the origin than `size` (mm) count fully, others by the eighth power of the
/// distance less.
QuadraticFit fit_quadratic(std::span<const Vec2> x, const std::vector<int>& nodes,
                           const Vec2& origin, double size);

} // namespace plyform
