// SPDX-License-Identifier: GPL-3.0-or-later
// Differences of fields between meshes, against fields whose difference is known.
#include "core/results/field_difference.hpp"

#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace plyform::field_difference_test {
namespace {

using Field = std::function<double(double, double)>;

/// A rectangle of 120 x 40 mm in nx x ny cells of one diagonal, inner nodes moved by up to `shake`
/// of a cell, at height 2.
PlyFrame rectangle(int nx, int ny, double shake) {
  PlyFrame ply;
  for (int j = 0; j <= ny; ++j)
    for (int i = 0; i <= nx; ++i) {
      const bool inner = i > 0 && i < nx && j > 0 && j < ny;
      const double dx = inner ? shake * std::sin(12.9 * i + 78.2 * j) : 0.0;
      const double dy = inner ? shake * std::sin(39.3 * i - 11.1 * j) : 0.0;
      ply.x0.emplace_back((i + dx) * 120.0 / nx - 60.0, (j + dy) * 40.0 / ny, 2.0);
    }
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      const int a = j * (nx + 1) + i, b = a + 1, c = a + nx + 1, d = c + 1;
      ply.triangles.push_back({a, b, d});
      ply.triangles.push_back({a, d, c});
    }
  return ply;
}

/// The field's values at the centres of the triangles as shear angles.
PlyFrame with_shear(PlyFrame ply, const Field& field) {
  for (const Triangle& t : ply.triangles) {
    Vec3 centre = Vec3::Zero();
    for (const std::int32_t node : t)
      centre += ply.x0[node] / 3.0;
    ply.shear_deg.push_back(field(centre.x(), centre.y()));
  }
  return ply;
}

Frame frame_of(std::vector<PlyFrame> plies) {
  Frame frame;
  frame.plies = std::move(plies);
  return frame;
}

double linear(double x, double y) {
  return 3.0 + 0.25 * x - 0.5 * y; // up to some 40 degrees
}

constexpr double rounding = 1e-11; // of numbers up to 40, some ten operations each

TEST(FieldError, InterpolatesALinearFieldExactlyBetweenMeshes) {
  const PlyFrame coarse = rectangle(7, 3, 0.3), fine = rectangle(31, 11, 0.2);
  for (const auto& [from, to] : {std::pair{&coarse, &fine}, std::pair{&fine, &coarse}}) {
    std::vector<double> nodal;
    for (const Vec3& x : from->x0)
      nodal.push_back(linear(x.x(), x.y()));
    const std::vector<double> found = interpolate(*from, nodal, to->x0);
    ASSERT_EQ(found.size(), to->x0.size());
    for (std::size_t i = 0; i < found.size(); ++i)
      EXPECT_NEAR(found[i], linear(to->x0[i].x(), to->x0[i].y()), rounding);
  }
}

TEST(FieldError, TakesTheNearestPlaceForPointsOutside) {
  const PlyFrame ply = rectangle(7, 3, 0.3);
  std::vector<double> nodal;
  for (const Vec3& x : ply.x0)
    nodal.push_back(linear(x.x(), x.y()));
  const std::vector<Vec3> points{{61, 20, 0}, {-90, 45, 0}, {3, -0.1, 9}};
  const std::vector<double> found = interpolate(ply, nodal, points);
  EXPECT_NEAR(found[0], linear(60, 20), rounding);
  EXPECT_NEAR(found[1], linear(-60, 40), rounding);
  EXPECT_NEAR(found[2], linear(3, 0), rounding);
}

TEST(FieldError, IsZeroOfAFieldAgainstItself) {
  const auto wave = [](double x, double y) { return 20.0 * std::sin(0.1 * x) * std::cos(0.2 * y); };
  const Frame frame = frame_of({with_shear(rectangle(9, 4, 0.3), wave)});
  const FieldError error = shear_error(frame, frame);
  EXPECT_NEAR(error.rms, 0.0, rounding);
  EXPECT_NEAR(error.max, 0.0, rounding);
}

TEST(FieldError, IsTheOffsetOfAnOffsetFieldOnAnyMesh) {
  const auto constant = [](double, double) { return 12.0; };
  const auto less = [](double, double) { return 10.5; };
  const Frame run = frame_of({with_shear(rectangle(7, 3, 0.3), less)});
  const Frame reference = frame_of({with_shear(rectangle(31, 11, 0.2), constant)});
  const FieldError error = shear_error(run, reference);
  EXPECT_NEAR(error.rms, 1.5, rounding);
  EXPECT_NEAR(error.p99, 1.5, rounding);
  EXPECT_NEAR(error.max, 1.5, rounding);
}

TEST(FieldError, WeighsByTheReferencesArea) {
  // One ply of the two is off by 3: half of the area, as all plies are equal.
  const auto zero = [](double, double) { return 0.0; };
  const auto three = [](double, double) { return -3.0; };
  const PlyFrame mesh = rectangle(8, 4, 0.3);
  const Frame run = frame_of({with_shear(mesh, zero), with_shear(rectangle(6, 6, 0.0), three)});
  const Frame reference = frame_of({with_shear(mesh, zero), with_shear(mesh, zero)});
  const FieldError error = shear_error(run, reference);
  EXPECT_NEAR(error.rms, 3.0 / std::sqrt(2.0), rounding);
  EXPECT_NEAR(error.p99, 3.0, rounding);
  EXPECT_NEAR(error.p95, 3.0, rounding);
  EXPECT_NEAR(error.mean, 1.5, rounding);
}

TEST(FieldError, GivesTheDifferenceAtTheNodesOfTheReference) {
  const auto two = [](double, double) { return 2.0; };
  const auto five = [](double, double) { return 5.0; };
  const Frame run = frame_of({with_shear(rectangle(7, 3, 0.3), two)});
  const Frame reference = frame_of({with_shear(rectangle(5, 2, 0.2), five)});
  const FieldDifference found = field_difference(run, reference, "shear_angle_deg");
  ASSERT_EQ(found.at_nodes.size(), 1u);
  ASSERT_EQ(found.at_nodes[0].size(), reference.plies[0].x0.size());
  for (const double difference : found.at_nodes[0])
    EXPECT_NEAR(difference, -3.0, rounding);
}

TEST(FieldError, FallsWithTheSizeOfTheElementsOfASmoothField) {
  const auto wave = [](double x, double y) { return 20.0 * std::sin(0.1 * x) * std::cos(0.1 * y); };
  const Frame reference = frame_of({with_shear(rectangle(192, 64, 0.0), wave)});
  std::vector<double> errors;
  for (const int n : {12, 24, 48})
    errors.push_back(
        shear_error(frame_of({with_shear(rectangle(n, n / 3, 0.0), wave)}), reference).rms);
  // Means are of second order inside and of first on the rim, a strip whose width is of first order
  // too: together 1.5 at least.
  EXPECT_GT(errors[0] / errors[1], std::pow(2.0, 1.4));
  EXPECT_GT(errors[1] / errors[2], std::pow(2.0, 1.4));
  EXPECT_LT(errors[2], 0.5);
}

TEST(FieldError, RefusesRunsOfOtherPlyCounts) {
  const PlyFrame ply = with_shear(rectangle(4, 2, 0.0), linear);
  try {
    shear_error(frame_of({ply}), frame_of({ply, ply}));
    FAIL() << "compared one ply with two";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "a run of 1 plies cannot be compared with one of 2");
  }
}

TEST(FieldError, IsNotANumberWhereAFieldIsNone) {
  PlyFrame ply = with_shear(rectangle(4, 2, 0.0), linear);
  const Frame reference = frame_of({ply});
  ply.shear_deg[3] = std::numeric_limits<double>::quiet_NaN();
  const FieldError error = shear_error(frame_of({ply}), reference);
  EXPECT_TRUE(std::isnan(error.rms) && std::isnan(error.p99) && std::isnan(error.max));
}

} // namespace
} // namespace plyform::field_difference_test
