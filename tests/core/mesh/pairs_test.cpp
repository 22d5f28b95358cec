// SPDX-License-Identifier: GPL-3.0-or-later
// StrainGroups of triangles: each in one, small, in one piece, the halves of a square together.
#include "core/mesh/pairs.hpp"
#include "support/membrane_checks.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <set>

namespace plyform::pairs_test {
namespace {

BlankMesh meshed(MeshKind kind) {
  BlankSpec spec = rectangle(100.0, 60.0, 7.0, kind);
  if (kind == MeshKind::free) spec.outline.holes = {{{-5, -5}, {5, -5}, {0, 5}}};
  return mesh_blank(spec, 0.3, 0.3 + 0.5 * std::numbers::pi);
}

constexpr MeshKind kinds[] = {MeshKind::diagonal, MeshKind::crossed, MeshKind::fibres,
                              MeshKind::free};

bool share_a_side(const Triangle& s, const Triangle& t) {
  return std::count_if(s.begin(), s.end(),
                       [&](int n) { return std::find(t.begin(), t.end(), n) != t.end(); }) == 2;
}

TEST(StrainGroups, HoldEveryTriangleOnce) {
  for (const MeshKind kind : kinds) {
    const BlankMesh mesh = meshed(kind);
    for (const StrainGroups& p : {pair_triangles(mesh), single_triangles(mesh.triangles.size())}) {
      std::vector<std::int32_t> sorted = p.triangles;
      std::sort(sorted.begin(), sorted.end());
      ASSERT_EQ(sorted.size(), mesh.triangles.size());
      for (std::size_t e = 0; e < sorted.size(); ++e)
        EXPECT_EQ(sorted[e], static_cast<std::int32_t>(e));
      ASSERT_GE(p.begin.size(), 2u);
      EXPECT_EQ(p.begin.front(), 0);
      EXPECT_EQ(p.begin.back(), static_cast<std::int32_t>(sorted.size()));
    }
  }
}

TEST(StrainGroups, AreSmallAndInOnePiece) {
  for (const MeshKind kind : kinds) {
    const BlankMesh mesh = meshed(kind);
    const StrainGroups p = pair_triangles(mesh);
    int alone = 0;
    for (std::size_t i = 0; i + 1 < p.begin.size(); ++i) {
      const int size = p.begin[i + 1] - p.begin[i];
      EXPECT_GE(size, 1);
      EXPECT_LE(size, most_in_group);
      alone += size == 1;
      // of three at most: in one piece if one of them touches all others
      bool in_one_piece = false;
      for (int a = p.begin[i]; a < p.begin[i + 1]; ++a) {
        bool touches_all = true;
        for (int b = p.begin[i]; b < p.begin[i + 1]; ++b)
          touches_all =
              touches_all &&
              (a == b || share_a_side(mesh.triangles[p.triangles[static_cast<std::size_t>(a)]],
                                      mesh.triangles[p.triangles[static_cast<std::size_t>(b)]]));
        in_one_piece = in_one_piece || touches_all;
      }
      EXPECT_TRUE(in_one_piece) << i;
    }
    // one alone has only full groups around it: few. They stiffen the mesh.
    EXPECT_LE(alone, 0.02 * static_cast<double>(mesh.triangles.size()));
  }
}

TEST(StrainGroups, PairTheHalvesOfEverySquare) {
  const BlankMesh mesh = mesh_blank(rectangle(90.0, 60.0, 7.5), 0.0, 1.5);
  const StrainGroups p = pair_triangles(mesh);
  EXPECT_EQ(2 * (p.begin.size() - 1), mesh.triangles.size());
  for (std::size_t i = 0; i + 1 < p.begin.size(); ++i) {
    ASSERT_EQ(p.begin[i + 1] - p.begin[i], 2);
    std::set<int> nodes;
    Eigen::AlignedBox2d box;
    for (int k = p.begin[i]; k < p.begin[i + 1]; ++k)
      for (const int n : mesh.triangles[p.triangles[static_cast<std::size_t>(k)]]) {
        nodes.insert(n);
        box.extend(mesh.x[n]);
      }
    EXPECT_EQ(nodes.size(), 4u);
    EXPECT_NEAR(box.sizes().x(), 7.5, 1e-9);
    EXPECT_NEAR(box.sizes().y(), 7.5, 1e-9);
  }
}

TEST(StrainGroups, AreTheSameEveryTime) {
  for (const MeshKind kind : kinds) {
    const StrainGroups p = pair_triangles(meshed(kind)), q = pair_triangles(meshed(kind));
    EXPECT_EQ(p.begin, q.begin);
    EXPECT_EQ(p.triangles, q.triangles);
  }
}

} // namespace
} // namespace plyform::pairs_test
