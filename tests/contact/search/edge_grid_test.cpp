// SPDX-License-Identifier: GPL-3.0-or-later
// The grid of edges finds every edge whose box meets the box asked for, and hardly another.
#include "contact/search/edge_grid.hpp"
#include "support/contact_checks.hpp"

#include <gtest/gtest.h>
#include <set>

namespace plyform::edge_grid_test {
namespace {

TEST(EdgeGrid, FindsTheEdgesWhoseBoxesMeetTheOneAskedFor) {
  Random random(3);
  for (const double far : {0.0, 1e4}) { // from the origin
    OwnedSheet sheet = square_sheet(12, 5.0, 0.0);
    for (Vec3& x : sheet.x)
      x = Vec3(x.y(), far + x.z(), x.x()) + 2.0 * random_vector(random); // upright
    const SheetEdges edges = sheet_edges(sheet.triangles, sheet.x);
    std::vector<std::int32_t> some;
    for (std::size_t e = 0; e < edges.all.size(); ++e)
      if (random() % 3 != 0) some.push_back(static_cast<std::int32_t>(e));
    const EdgeGrid grid(edges.all, sheet.x, some);
    int met = 0;
    for (int i = 0; i < 800; ++i) {
      const Vec3 middle = 35.0 * random_vector(random) + Vec3(0, far, 0);
      const Vec3 half = 6.0 * random_vector(random).cwiseAbs();
      const Box3 box(middle - half, middle + half);
      std::set<std::int32_t> found;
      grid.visit(box, [&](std::int32_t e) { EXPECT_TRUE(found.insert(e).second) << e; });
      for (const std::int32_t e : some) {
        const Box3 of_edge = edge_box(edges.all[at(e)], sheet.x, 0.0);
        const bool meets = of_edge.intersects(box);
        met += meets ? 1 : 0;
        EXPECT_TRUE(found.contains(e) || !meets) << e;
        const double apart = of_edge.exteriorDistance(box);
        EXPECT_TRUE(!found.contains(e) || apart <= 1e-6 * (100.0 + far)) << e << ' ' << apart;
      }
    }
    EXPECT_GT(met, 300);
  }
}

TEST(EdgeGrid, OfNoEdgesFindsNone) {
  const OwnedSheet sheet = square_sheet(2, 5.0, 0.0);
  const SheetEdges edges = sheet_edges(sheet.triangles, sheet.x);
  const EdgeGrid grid(edges.all, sheet.x, {});
  grid.visit(Box3(Vec3::Constant(-100.0), Vec3::Constant(100.0)),
             [](std::int32_t e) { ADD_FAILURE() << e; });
}

} // namespace
} // namespace plyform::edge_grid_test
