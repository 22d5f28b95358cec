// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/search/fold_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plyform {

// For each node: the mean direction of the normals around it, and the largest deviation `off` of a
// normal from it. By the triangle inequality the normals of two faces that share the node differ by
// no more than the sum of their deviations.
void fold_bounds(std::span<const Vec3> x, std::span<const Triangle> triangles,
                 std::vector<double>& fold_bound) {
  const auto at = [](int n) { return static_cast<std::size_t>(n); };
  std::vector<Vec3> normal(triangles.size()), mean(x.size(), Vec3::Zero());
  std::vector<double> off(x.size(), 0.0);
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    const Triangle& t = triangles[f];
    normal[f] = (x[at(t[1])] - x[at(t[0])]).cross(x[at(t[2])] - x[at(t[0])]).normalized();
    for (const int n : t)
      mean[at(n)] += normal[f];
  }
  for (Vec3& m : mean)
    m.normalize();
  for (std::size_t f = 0; f < triangles.size(); ++f)
    for (const int n : triangles[f]) {
      const double here = (normal[f] - mean[at(n)]).squaredNorm();
      if (!(here <= off[at(n)])) off[at(n)] = here; // NaN too
    }
  for (double& o : off)
    o = std::sqrt(o);
  fold_bound.resize(triangles.size());
  constexpr double most = 0.4;
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    double chord = 0.0;
    for (const int n : triangles[f])
      chord = std::max(chord, (normal[f] - mean[at(n)]).norm() + off[at(n)]);
    // An angle is less than 1.1 times its chord (the difference of unit normals) up to a right
    // angle, and tan(a) < a / (1 - a^2 / 2) below a = 1.2.
    const double a = 0.5 * (1.1 * chord + fold_margin);
    fold_bound[f] =
        a < most ? 1.2 * a / (1.0 - 0.5 * a * a) : std::numeric_limits<double>::infinity();
  }
}

} // namespace plyform
