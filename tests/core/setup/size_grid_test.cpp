// SPDX-License-Identifier: GPL-3.0-or-later
// Sizes of triangles made a grid that a blank is meshed by.
#include "core/mesh/mesh_blank.hpp"
#include "core/mesh/size_field.hpp"
#include "core/setup/size_grid.hpp"
#include "support/scene_checks.hpp"

#include <gtest/gtest.h>
#include <numbers>

namespace plyform::size_grid_test {
namespace {

constexpr double largest = 4.0, small = 1.0; // mm

/// A ply of 40 mm, placed so, and sizes that are small in the triangle at its middle.
struct Placed {
  Ply place;
  PlyFrame ply;
  AskedSizes sizes;
  std::vector<Vec2> small_at; ///< as seen from the blank
};

Placed placed(double rotation, const Vec2& seed) {
  Placed p;
  p.place.rotation = rotation, p.place.seed = seed;
  const BlankMesh mesh = mesh_blank(rectangle(40.0, 40.0, largest), 0.0, 0.0);
  for (const Vec2& x : mesh.x) {
    const Vec2 there = seed + Eigen::Rotation2Dd(rotation) * x;
    p.ply.x0.emplace_back(there.x(), there.y(), 0.0);
  }
  p.ply.triangles = mesh.triangles;
  p.sizes.resize(mesh.triangles.size());
  for (auto& places : p.sizes)
    places.fill(largest);
  const std::size_t middle = mesh.triangles.size() / 2;
  p.sizes[middle].fill(small);
  const Triangle& t = mesh.triangles[middle];
  for (const auto& w : asked_places)
    p.small_at.emplace_back(w[0] * mesh.x[at(t[0])] + w[1] * mesh.x[at(t[1])] +
                            w[2] * mesh.x[at(t[2])]);
  return p;
}

TEST(SizeGrid, KeepsWhatIsAskedForWhereverThePlyLies) {
  for (const double rotation : {0.0, 0.7}) {
    const Placed p = placed(rotation, {100.0, -30.0});
    BlankSpec blank = rectangle(40.0, 40.0, largest);
    blank.sizes = size_grid(p.ply, p.place, p.sizes, largest, 0.3);
    const SizeField field = make_size_field(blank);
    for (const Vec2& x : p.small_at)
      EXPECT_LE(wanted_size(field, x), 1.1 * small); // between points of the grid
    EXPECT_EQ(wanted_size(field, Vec2(19.0, 19.0)), largest);
  }
}

TEST(SizeGrid, BisectionsOfTheAlignedSizeLeadToTheLeast) {
  const Placed p = placed(0.0, Vec2::Zero());
  SizeGrid grid = size_grid(p.ply, p.place, p.sizes, largest, 0.3);
  EXPECT_NEAR(aligned_size(grid, largest), largest, 1e-9); // 4 is 1 bisected four times
  EXPECT_NEAR(aligned_size(grid, 0.99 * largest), 2.0 * std::numbers::sqrt2, 1e-9);
  for (double& size : grid.size)
    size = largest;
  EXPECT_EQ(aligned_size(grid, largest), largest);
}

TEST(SizeGrid, GrowsNoFasterThanAMeshCan) {
  const Placed p = placed(0.0, Vec2::Zero());
  const SizeGrid grid = size_grid(p.ply, p.place, p.sizes, largest, 0.3);
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column + 1 < grid.columns; ++column) {
      const auto i = static_cast<std::size_t>(row * grid.columns + column);
      EXPECT_LE(std::abs(grid.size[i + 1] - grid.size[i]), size_growth * grid.spacing + 1e-12);
    }
}

} // namespace
} // namespace plyform::size_grid_test
