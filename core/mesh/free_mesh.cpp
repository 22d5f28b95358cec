// SPDX-License-Identifier: GPL-3.0-or-later
// Delaunay refinement by CGAL Mesh_2, which only this file includes.
#include "core/mesh/mesher_parts.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Delaunay_mesh_size_criteria_2.h>
#include <CGAL/Delaunay_mesh_vertex_base_2.h>
#include <CGAL/Delaunay_mesher_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <cmath>
#include <map>
#include <queue>

namespace plyform {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// Node number; -1 for points that the mesher added.
struct Number {
  std::int32_t value = -1;
};

using VertexBase =
    CGAL::Triangulation_vertex_base_with_info_2<Number, Kernel,
                                                CGAL::Delaunay_mesh_vertex_base_2<Kernel>>;
using FaceBase = CGAL::Delaunay_mesh_face_base_2<Kernel>;
using Storage = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<Kernel, Storage>;
using Criteria = CGAL::Delaunay_mesh_size_criteria_2<Triangulation>;
using Face = Triangulation::Face_handle;

/// The criteria of CGAL with a bound of the edges that differs from face to face.
class LocalCriteria : public Criteria {
public:
  LocalCriteria(double aspect_bound, const LongestSide& longest_side)
      : Criteria(aspect_bound), longest(longest_side) {}

  class Is_bad : public Criteria::Is_bad {
  public:
    Is_bad(const LocalCriteria& criteria)
        : Criteria::Is_bad(criteria.bound(), 0.0, criteria.traits), all(criteria) {}

    using Criteria::Is_bad::operator();
    CGAL::Mesh_2::Face_badness operator()(const Face& f, Quality& quality) const {
      std::array<Vec2, 3> corners;
      for (int k = 0; k < 3; ++k)
        corners[at(k)] = Vec2(f->vertex(k)->point().x(), f->vertex(k)->point().y());
      return Criteria::Is_bad(all.bound(), all.longest(corners), all.traits)(f, quality);
    }

  private:
    const LocalCriteria& all;
  };

  Is_bad is_bad_object() const { return Is_bad(*this); }

private:
  const LongestSide& longest;
};

Triangulation triangulate(const Region& region) {
  Triangulation t;
  std::vector<Triangulation::Vertex_handle> v;
  v.reserve(region.x.size());
  Face near;
  for (const Vec2& x : region.x) {
    v.push_back(t.insert(Kernel::Point_2(x.x(), x.y()), near));
    v.back()->info().value = static_cast<std::int32_t>(v.size()) - 1;
    near = v.back()->face();
  }
  for (const Edge& e : region.edges)
    t.insert_constraint(v[e[0]], v[e[1]]);
  return t;
}

/// Marks the faces inside the region: those separated from infinity by an odd number of
/// constraints.
void mark_region(Triangulation& t) {
  std::map<Face, bool> inside{{t.infinite_face(), false}};
  std::queue<Face> todo;
  todo.push(t.infinite_face());
  for (; !todo.empty(); todo.pop()) {
    const Face f = todo.front();
    const bool f_inside = inside.at(f);
    f->set_in_domain(f_inside);
    for (int i = 0; i < 3; ++i)
      if (inside.emplace(f->neighbor(i), f_inside != f->is_constrained(i)).second)
        todo.push(f->neighbor(i));
  }
}

/// The triangles inside the region. Nodes of the region keep their numbers.
BlankMesh mesh_of(const Region& region, Triangulation& t) {
  BlankMesh mesh{region.x, {}};
  for (const auto v : t.finite_vertex_handles())
    if (v->info().value < 0) {
      v->info().value = static_cast<std::int32_t>(mesh.x.size());
      mesh.x.emplace_back(v->point().x(), v->point().y());
    }
  for (const auto f : t.finite_face_handles())
    if (f->is_in_domain())
      mesh.triangles.push_back(
          {f->vertex(0)->info().value, f->vertex(1)->info().value, f->vertex(2)->info().value});
  return mesh;
}

} // namespace

BlankMesh refine(const Region& region, double min_angle, double max_edge) {
  Triangulation t = triangulate(region);
  mark_region(t);
  const double sine = std::sin(min_angle);
  CGAL::refine_Delaunay_mesh_2(t, Criteria(sine * sine, max_edge), true);
  return mesh_of(region, t);
}

BlankMesh refine(const Region& region, double min_angle, const LongestSide& longest_side) {
  Triangulation t = triangulate(region);
  mark_region(t);
  const double sine = std::sin(min_angle);
  CGAL::refine_Delaunay_mesh_2(t, LocalCriteria(sine * sine, longest_side), true);
  return mesh_of(region, t);
}

} // namespace plyform
