// SPDX-License-Identifier: GPL-3.0-or-later
// What must hold for the signed distance to anything, whatever the shape.
#pragma once

#include "contact/shapes/tool_shape.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace plyform::testing {

inline SurfacePoint ask(const ToolShape& shape, const Vec3& p) {
  SurfaceHint hint;
  return signed_distance(shape, p, hint);
}

struct RandomPoints {
  std::mt19937_64 engine;
  explicit RandomPoints(unsigned seed) : engine(seed) {}
  double in(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine);
  }
  Vec3 in(const Box3& box) {
    return {in(box.min().x(), box.max().x()), in(box.min().y(), box.max().y()),
            in(box.min().z(), box.max().z())};
  }
};

/// The normal is the gradient: unit, central differences with step h agree, except where a
/// medial axis (kink of the distance) lies within h; there the two one-sided slopes differ, and the
/// point is left out. Returns how many points were compared.
inline int check_gradient(const ToolShape& shape, const Box3& box, int count, unsigned seed) {
  // Truncation h^2/(6 rho^2) for radii of curvature rho > 0.1 mm, rounding 1e-13/h.
  constexpr double h = 1e-5, tolerance = 1e-6;
  RandomPoints random(seed);
  int compared = 0;
  for (int i = 0; i < count; ++i) {
    const Vec3 p = random.in(box);
    const SurfacePoint here = ask(shape, p);
    EXPECT_NEAR(here.normal.norm(), 1.0, 1e-12) << p.transpose();
    Vec3 slope;
    bool smooth = true;
    for (int k = 0; k < 3; ++k) {
      const double ahead = ask(shape, p + h * Vec3::Unit(k)).distance;
      const double behind = ask(shape, p - h * Vec3::Unit(k)).distance;
      slope[k] = (ahead - behind) / (2.0 * h);
      // Second difference: h/rho at most where smooth, of the order of 1 at a kink.
      smooth = smooth && std::abs(ahead - 2.0 * here.distance + behind) < 1e-3 * h;
    }
    if (!smooth) continue;
    ++compared;
    const double error = (slope - here.normal).norm();
    EXPECT_TRUE(error < tolerance) << p.transpose() << "  error " << error << "\n normal "
                                   << here.normal.transpose() << "\n slope " << slope.transpose();
    if (::testing::Test::HasFailure()) break;
  }
  return compared;
}

/// |s(p) - s(q)| <= |p - q|, up to rounding.
inline void check_lipschitz(const ToolShape& shape, const Box3& box, int count, unsigned seed) {
  RandomPoints random(seed);
  for (int i = 0; i < count; ++i) {
    const Vec3 p = random.in(box);
    const Vec3 q = i % 2 ? random.in(box) : Vec3(p + 1e-3 * Vec3::Random());
    const double change = std::abs(ask(shape, p).distance - ask(shape, q).distance);
    ASSERT_TRUE(change <= (p - q).norm() + 1e-10) << p.transpose() << " to " << q.transpose();
  }
}

} // namespace plyform::testing
