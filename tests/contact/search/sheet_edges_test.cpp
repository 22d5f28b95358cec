// SPDX-License-Identifier: GPL-3.0-or-later
// Patches of edges: every edge is in one, and their motion is bounded.
#include "contact/search/sheet_edges.hpp"
#include "support/contact_checks.hpp"

#include <algorithm>
#include <gtest/gtest.h>

namespace plyform::sheet_edges_test {
namespace {

TEST(SheetEdges, EveryEdgeIsInAPatchThatHoldsItsNodes) {
  OwnedSheet sheet = square_sheet(20, 5.0, 0.0);
  for (Vec3& x : sheet.x)
    x = Vec3(x.z(), x.x(), 0.5 * x.y()); // upright
  const SheetEdges edges = sheet_edges(sheet.triangles, sheet.x);
  ASSERT_EQ(edges.patch.size(), edges.all.size());
  EXPECT_GT(edges.patch_nodes.size(), 20u);
  for (std::size_t e = 0; e < edges.all.size(); ++e) {
    const auto& nodes = edges.patch_nodes.at(static_cast<std::size_t>(edges.patch[e]));
    EXPECT_TRUE(std::binary_search(nodes.begin(), nodes.end(), edges.all[e].a));
    EXPECT_TRUE(std::binary_search(nodes.begin(), nodes.end(), edges.all[e].b));
  }
  for (const auto& nodes : edges.patch_nodes) // neighbours
    for (const std::int32_t n : nodes)
      EXPECT_LT((sheet.x[n] - sheet.x[nodes.front()]).norm(), 45.0);
}

TEST(SheetEdges, FacesAcrossShareTheTwoOtherCorners) {
  const OwnedSheet sheet = square_sheet(5, 4.0, 0.0);
  const SheetEdges edges = sheet_edges(sheet.triangles, sheet.x);
  ASSERT_EQ(edges.faces_across.size(), sheet.triangles.size());
  std::size_t free = 0;
  for (std::size_t t = 0; t < sheet.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t face = edges.faces_across[t][k];
      if (face == no_face) {
        ++free;
        continue;
      }
      const Triangle& other = sheet.triangles.at(at(face));
      EXPECT_NE(at(face), t);
      for (const std::size_t corner : {(k + 1) % 3, (k + 2) % 3})
        EXPECT_EQ(std::count(other.begin(), other.end(), sheet.triangles[t][corner]), 1);
      EXPECT_EQ(std::count(other.begin(), other.end(), sheet.triangles[t][k]), 0);
    }
  EXPECT_EQ(free, 20u); // sides of the rim
}

TEST(SheetEdges, SaysWhereSeveralFacesAreAcross) {
  const std::vector<Vec3> x{{0, 0, 0}, {0, 4, 0}, {4, 2, 0}, {-4, 2, 0}, {0, 2, 4}};
  const std::vector<Triangle> book{{0, 2, 1}, {0, 1, 3}, {4, 0, 1}}; // three leaves on one edge
  const SheetEdges edges = sheet_edges(book, x);
  EXPECT_EQ(edges.faces_across[0][1], several_faces);
  EXPECT_EQ(edges.faces_across[1][2], several_faces);
  EXPECT_EQ(edges.faces_across[2][0], several_faces);
  EXPECT_EQ(edges.faces_across[2][1], no_face);
}

TEST(SheetEdges, MotionOfPatchesBoundsThatOfTheirNodes) {
  Random random(1);
  const OwnedSheet a = square_sheet(6, 5.0, 0.0), b = square_sheet(9, 4.0, 1.0);
  const SheetEdges edges_a = sheet_edges(a.triangles, a.x), edges_b = sheet_edges(b.triangles, b.x);
  std::vector<Vec3> motion_a(a.x.size()), motion_b(b.x.size());
  for (std::vector<Vec3>* motion : {&motion_a, &motion_b})
    for (Vec3& u : *motion)
      u = Vec3(3, -4, 5) + random_vector(random);
  std::vector<Box3> boxes_a, boxes_b;
  patch_motions(edges_a, motion_a, boxes_a);
  patch_motions(edges_b, motion_b, boxes_b);
  double closest = 0.0;
  for (std::size_t p = 0; p < boxes_a.size(); ++p)
    for (std::size_t q = 0; q < boxes_b.size(); ++q) {
      const double bound = relative_motion(boxes_a[p], boxes_b[q]);
      for (const std::int32_t m : edges_a.patch_nodes[p])
        for (const std::int32_t n : edges_b.patch_nodes[q]) {
          EXPECT_LE((motion_a[m] - motion_b[n]).norm(), bound);
          closest = std::max(closest, (motion_a[m] - motion_b[n]).norm() / bound);
        }
    }
  EXPECT_GT(closest, 0.6); // the common part, of 7 mm, is not in it
}

} // namespace
} // namespace plyform::sheet_edges_test
