// SPDX-License-Identifier: GPL-3.0-or-later
// Sheets in contact that own their arrays, for tests.
#pragma once

#include "contact/forces/tool_ply.hpp"

#include <cmath>
#include <random>

namespace plyform {

using Random = std::mt19937_64;

inline double signed_unit(Random& random) {
  return std::uniform_real_distribution<double>(-1.0, 1.0)(random);
}

inline Vec3 random_vector(Random& random) {
  const double x = signed_unit(random), y = signed_unit(random);
  return {x, y, signed_unit(random)};
}

/// What a SurfaceKinematics views.
struct OwnedSheet {
  std::vector<Vec3> x, motion;
  std::vector<double> area;
  std::vector<Triangle> triangles;

  SurfaceKinematics state() const {
    return {x, motion, area, {}};
  } // no spread: every face is looked at

  /// To x + step.
  void move(const std::vector<Vec3>& step) {
    motion = step;
    for (std::size_t n = 0; n < x.size(); ++n)
      x[n] += step[n];
  }
};

inline OwnedSheet points_only(std::vector<Vec3> x, double area) {
  OwnedSheet sheet;
  sheet.motion.assign(x.size(), Vec3::Zero());
  sheet.area.assign(x.size(), area);
  sheet.x = std::move(x);
  return sheet;
}

/// cells x cells squares of `size` mm from (-half, -half), one diagonal each, at height z.
inline OwnedSheet square_sheet(int cells, double size, double z) {
  std::vector<Vec3> x;
  for (int j = 0; j <= cells; ++j)
    for (int i = 0; i <= cells; ++i)
      x.emplace_back((i - 0.5 * cells) * size, (j - 0.5 * cells) * size, z);
  OwnedSheet sheet = points_only(std::move(x), size * size);
  for (int j = 0; j < cells; ++j)
    for (int i = 0; i < cells; ++i) {
      const int a = j * (cells + 1) + i, b = a + 1, c = a + cells + 1, d = c + 1;
      sheet.triangles.push_back({a, b, d});
      sheet.triangles.push_back({a, d, c});
    }
  return sheet;
}

inline double largest_norm(const std::vector<Vec3>& vectors) {
  double largest = 0.0;
  for (const Vec3& v : vectors)
    if (!(v.norm() <= largest) && !std::isnan(largest)) largest = v.norm(); // NaN stays
  return largest;
}

/// Largest difference between `force` and minus the central difference of energy(), over the
/// largest force; energy() looks at x.
template <class Energy>
double gradient_error(std::vector<Vec3>& x, const std::vector<Vec3>& force, double h,
                      const Energy& energy) {
  std::vector<Vec3> difference;
  for (std::size_t n = 0; n < x.size(); ++n) {
    Vec3 gradient;
    for (int i = 0; i < 3; ++i) {
      const double old = x[n][i];
      x[n][i] = old + h;
      const double above = energy();
      x[n][i] = old - h;
      gradient[i] = (above - energy()) / (2.0 * h);
      x[n][i] = old;
    }
    difference.emplace_back(force[n] + gradient);
  }
  return largest_norm(difference) / largest_norm(force);
}

} // namespace plyform
