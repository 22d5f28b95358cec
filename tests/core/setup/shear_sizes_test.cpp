// SPDX-License-Identifier: GPL-3.0-or-later
// The error estimate of Zienkiewicz and Zhu and the sizes that follow from it.
#include "core/mesh/mesh_blank.hpp"
#include "core/setup/shear_sizes.hpp"
#include "support/scene_checks.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace plyform::shear_sizes_test {
namespace {

constexpr double width = 40.0; // mm

/// A flat ply with the shear (degrees) that `shear` gives at a centroid.
template <class Field>
PlyFrame sheared(double size, const Field& shear) {
  BlankSpec blank = rectangle(width, width, size);
  blank.mesh = MeshKind::alternating;
  const BlankMesh mesh = mesh_blank(blank, 0.0, 0.0);
  PlyFrame ply;
  for (const Vec2& x : mesh.x)
    ply.x0.emplace_back(x.x(), x.y(), 0.0);
  ply.x = ply.x0;
  ply.triangles = mesh.triangles;
  for (const Triangle& t : mesh.triangles)
    ply.shear_deg.push_back(
        shear(Vec2((mesh.x[at(t[0])] + mesh.x[at(t[1])] + mesh.x[at(t[2])]) / 3.0)));
  return ply;
}

/// The root mean square of the estimates at least three elements inside of the rim.
double estimate_inside(const PlyFrame& ply, double size) {
  const std::vector<double> estimates = shear_error_estimates(ply);
  double sum = 0.0, count = 0.0;
  for (std::size_t t = 0; t < estimates.size(); ++t) {
    const Vec3& x = ply.x0[at(ply.triangles[t][0])];
    if (std::max(std::abs(x.x()), std::abs(x.y())) > 0.5 * width - 4.0 * size) continue;
    sum += estimates[t] * estimates[t], count += 1.0;
  }
  return std::sqrt(sum / count);
}

TEST(ShearSizes, AnEvenSlopeHasNoError) {
  const PlyFrame ply = sheared(2.0, [](const Vec2& x) { return 0.5 * x.x() - 0.2 * x.y(); });
  EXPECT_LT(estimate_inside(ply, 2.0), 1e-10); // degrees; rounding
}

// Of x^2 the error of a linear element goes with h^2 exactly.
TEST(ShearSizes, TheEstimateGoesWithTheSquareOfTheSize) {
  const auto bent = [](const Vec2& x) { return x.x() * x.x(); };
  const double coarse = estimate_inside(sheared(2.0, bent), 2.0);
  const double fine = estimate_inside(sheared(1.0, bent), 2.0);
  EXPECT_GT(coarse, 0.0);
  EXPECT_NEAR(coarse / fine, 4.0, 0.2); // rows at the rim of what is counted differ
}

TEST(ShearSizes, KeepTheErrorAskedForAndRefineWhereShearBends) {
  Frame last;
  last.plies = {sheared(2.0, [](const Vec2& x) { return 5.0 * std::tanh(x.x() / 3.0); })};
  const std::vector<double> estimates = shear_error_estimates(last.plies[0]);
  std::vector<AskedSizes> sizes(1, AskedSizes(estimates.size()));
  for (auto& places : sizes[0])
    places.fill(2.0);
  double before = 0.0;
  for (const double e : estimates)
    before += e * e / static_cast<double>(estimates.size());
  lower_to_shear(last, 0.5 * std::sqrt(before), 0.1, sizes);
  double after = 0.0, in_bend = 2.0, outside = 0.0;
  for (std::size_t t = 0; t < estimates.size(); ++t) {
    const double size = sizes[0][t][0], left = estimates[t] * size * size / 4.0;
    after += left * left / static_cast<double>(estimates.size());
    const double x = std::abs(last.plies[0].x0[at(last.plies[0].triangles[t][0])].x());
    if (x < 4.0) in_bend = std::min(in_bend, size);
    if (x > 14.0) outside = std::max(outside, size);
  }
  EXPECT_NEAR(std::sqrt(after / before), 0.5, 0.01);
  EXPECT_LT(in_bend, 1.5);
  EXPECT_EQ(outside, 2.0);
}

} // namespace
} // namespace plyform::shear_sizes_test
