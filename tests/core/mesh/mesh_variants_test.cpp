// SPDX-License-Identifier: GPL-3.0-or-later
// Finer meshes of the same blank, and the same mesh in another order.
#include "core/mesh/mesh_variants.hpp"
#include "core/mesh/pairs.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <map>
#include <numeric>

namespace plyform::mesh_variants_test {
namespace {

BlankMesh mesh_of(MeshKind kind) {
  BlankSpec blank;
  blank.outline.boundary = {{0, 0}, {60, 0}, {60, 40}, {0, 40}};
  blank.mesh = kind, blank.element_size = 5.0;
  return mesh_blank(blank, 0.0, 1.5707963267948966);
}

double area_of(const BlankMesh& mesh) {
  double twice = 0.0;
  for (const Triangle& t : mesh.triangles) {
    const Vec2 a = mesh.x[at(t[1])] - mesh.x[at(t[0])], b = mesh.x[at(t[2])] - mesh.x[at(t[0])];
    const double own = a.x() * b.y() - a.y() * b.x();
    EXPECT_GT(own, 0.0); // anticlockwise
    twice += own;
  }
  return 0.5 * twice;
}

/// Length of the sides that one triangle has alone; no side may have more than two.
double rim_of(const BlankMesh& mesh) {
  std::map<std::pair<int, int>, int> sides;
  for (const Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      ++sides[std::minmax(t[k], t[(k + 1) % 3])];
  double length = 0.0;
  for (const auto& [side, triangles] : sides) {
    EXPECT_LE(triangles, 2);
    if (triangles == 1) length += (mesh.x[at(side.first)] - mesh.x[at(side.second)]).norm();
  }
  return length;
}

TEST(Bisected, IsConformingAndCoversTheSameBlank) {
  for (const MeshKind kind :
       {MeshKind::diagonal, MeshKind::alternating, MeshKind::crossed, MeshKind::free}) {
    const BlankMesh mesh = mesh_of(kind), fine = bisected(mesh);
    EXPECT_NEAR(area_of(fine), 2400.0, 1e-9);
    EXPECT_NEAR(rim_of(fine), 200.0, 1e-9); // a node in the middle of a side would add to it
    EXPECT_GE(fine.triangles.size(), 2 * mesh.triangles.size());
    EXPECT_LE(fine.triangles.size(), 4 * mesh.triangles.size());
    for (std::size_t n = 0; n < mesh.x.size(); ++n)
      EXPECT_EQ(fine.x[n], mesh.x[n]);
    const StrainGroups groups = pair_triangles(fine);
    EXPECT_LE(static_cast<double>(groups.begin.size() - 1),
              0.51 * static_cast<double>(fine.triangles.size())); // hardly any is single
  }
  EXPECT_EQ(bisected(mesh_of(MeshKind::alternating)).triangles.size(),
            2 * mesh_of(MeshKind::alternating).triangles.size());
}

TEST(Renumbered, HasTheSameTriangles) {
  const BlankMesh mesh = mesh_of(MeshKind::free);
  BlankMesh other = renumbered(mesh);
  EXPECT_EQ(other.x, mesh.x);
  EXPECT_NE(other.triangles, mesh.triangles);
  std::vector<Triangle> a = mesh.triangles, b = other.triangles;
  std::sort(a.begin(), a.end()), std::sort(b.begin(), b.end());
  EXPECT_EQ(a, b);
}

} // namespace
} // namespace plyform::mesh_variants_test
