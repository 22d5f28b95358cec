// SPDX-License-Identifier: GPL-3.0-or-later
// Distance and normal of mesh tools against CGAL's own search (AABB_tree) and side
// (Side_of_triangle_mesh), which contact/shapes/mesh_shape.cpp does not use for the answer: 1e5
// points at random and on nodes, edges, faces and next to them.
#include "contact/shapes/mesh_shape.hpp"
#include "support/shape_checks.hpp"

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <gtest/gtest.h>

namespace plyform::mesh_oracle_test {
namespace {

using testing::ask;
using testing::RandomPoints;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Tree =
    CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_face_graph_triangle_primitive<Mesh>>>;

Kernel::Point_3 to_cgal(const Vec3& x) {
  return {x.x(), x.y(), x.z()};
}

/// A ball whose nodes are pushed in and out: ridges, valleys, saddles and spikes.
TriMesh urchin(unsigned seed) {
  TriMesh s = tessellate(Sphere{1.0}, 0.5, 0.0);
  RandomPoints random(seed);
  for (Vec3& x : s.x)
    x *= random.in(6.0, 18.0);
  return s;
}

struct Oracle {
  Mesh mesh;
  Tree tree;
  std::unique_ptr<CGAL::Side_of_triangle_mesh<Mesh, Kernel>> side;

  explicit Oracle(const TriMesh& s) {
    std::vector<Mesh::Vertex_index> nodes;
    for (const Vec3& x : s.x)
      nodes.push_back(mesh.add_vertex(to_cgal(x)));
    for (const Triangle& t : s.triangles)
      mesh.add_face(nodes[std::size_t(t[0])], nodes[std::size_t(t[1])], nodes[std::size_t(t[2])]);
    tree.insert(faces(mesh).first, faces(mesh).second, mesh);
    tree.build();
    side = std::make_unique<CGAL::Side_of_triangle_mesh<Mesh, Kernel>>(tree);
  }
};

/// Returns whether the normal is known (away from the surface) and was compared.
bool expect_right(const ToolShape& shape, const Oracle& oracle, const Vec3& p) {
  const SurfacePoint mine = ask(shape, p);
  const Kernel::Point_3 foot = oracle.tree.closest_point(to_cgal(p));
  const Vec3 way = p - Vec3(foot.x(), foot.y(), foot.z());
  const double distance = way.norm();
  // 1e-11 mm: CGAL's foot is rounded to some ulp of the 30 mm of its plane's equation
  EXPECT_NEAR(std::abs(mine.distance), distance, 1e-11) << p.transpose();
  EXPECT_NEAR(mine.normal.norm(), 1.0, 1e-13) << p.transpose();
  if (distance > 1e-11) {
    const bool inside = (*oracle.side)(to_cgal(p)) == CGAL::ON_BOUNDED_SIDE;
    EXPECT_EQ(mine.distance < 0.0, inside) << p.transpose() << " s = " << mine.distance;
  }
  const Vec3 mine_foot = p - mine.distance * mine.normal;
  EXPECT_LE(std::sqrt(oracle.tree.squared_distance(to_cgal(mine_foot))), 1e-9) << p.transpose();
  if (distance < 1e-4) return false; // the way's direction is mostly rounding
  const Vec3 expected = mine.distance < 0.0 ? Vec3(-way / distance) : Vec3(way / distance);
  return (mine.normal - expected).norm() < 1e-7; // another one where two feet are as near
}

TEST(MeshOracle, DistanceSideAndNormalAgreeWithCgal) {
  int points = 0, compared = 0, far = 0;
  for (const TriMesh& s : {tessellate(Box{Vec3(20, 14, 10)}, 5.0, 0.0), urchin(1), urchin(2),
                           tessellate(Annulus{8, 20, 6, 2}, 3.0, 0.0)}) {
    const ToolShape shape = make_mesh_shape(s, nullptr);
    const Oracle oracle(s);
    RandomPoints random(3);
    const auto ask_at = [&](const Vec3& p) {
      compared += expect_right(shape, oracle, p);
      far += std::abs(ask(shape, p).distance) > 1e-4;
      ++points;
    };
    for (int i = 0; i < 8500 && !::testing::Test::HasFailure(); ++i) {
      ask_at(random.in(Box3(Vec3(-25, -25, -25), Vec3(25, 25, 25))));
      const Triangle& t = s.triangles[random.engine() % s.triangles.size()];
      const Vec3 &a = s.x[std::size_t(t[0])], &b = s.x[std::size_t(t[1])],
                 &c = s.x[std::size_t(t[2])];
      double u = random.in(0, 1), v = random.in(0, 1);
      if (i % 3 == 0) u = 0.0;                // an edge
      if (i % 6 == 0) v = i % 12 ? 0.0 : 0.5; // a node; the middle of an edge
      if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
      const Vec3 on = a + u * (b - a) + v * (c - a);
      ask_at(on);
      ask_at(on + std::pow(10.0, random.in(-9, 0)) * random.in(Box3(-Vec3::Ones(), Vec3::Ones())));
    }
    for (const Vec3& x : s.x)
      ask_at(x);
  }
  EXPECT_GT(points, 100000);
  EXPECT_GT(compared, far - far / 100); // but next to a medial axis
  EXPECT_GT(far, points / 3);
}

} // namespace
} // namespace plyform::mesh_oracle_test
