// SPDX-License-Identifier: GPL-3.0-or-later
// Constrained Delaunay triangulation by CGAL.
#include "contact/shapes/fill_polygon.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_face_base_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <map>
#include <queue>

namespace plyform {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// Number of a corner; -1 for points where sides cross.
struct Number {
  std::int32_t value = -1;
};

using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<Number, Kernel>;
using FaceBase = CGAL::Constrained_triangulation_face_base_2<Kernel>;
using Storage = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, Storage, CGAL::Exact_predicates_tag>;
using Face = Triangulation::Face_handle;

} // namespace

double area_of(const std::vector<Vec2>& polygon) {
  double twice = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}

std::vector<Triangle> fill_polygon(const std::vector<Vec2>& polygon) {
  Triangulation t;
  std::vector<Triangulation::Vertex_handle> v;
  for (const Vec2& p : polygon) {
    v.push_back(t.insert(Kernel::Point_2(p.x(), p.y())));
    v.back()->info().value = static_cast<std::int32_t>(v.size()) - 1;
  }
  for (std::size_t i = 0; i < v.size(); ++i)
    t.insert_constraint(v[i], v[(i + 1) % v.size()]);
  std::vector<Triangle> triangles;
  std::map<Face, bool> inside{{t.infinite_face(), false}};
  std::queue<Face> todo;
  for (todo.push(t.infinite_face()); !todo.empty(); todo.pop()) {
    const Face f = todo.front();
    const bool f_inside = inside.at(f);
    const Triangle corners{f->vertex(0)->info().value, f->vertex(1)->info().value,
                           f->vertex(2)->info().value};
    if (f_inside && *std::min_element(corners.begin(), corners.end()) >= 0)
      triangles.push_back(corners);
    for (int i = 0; i < 3; ++i)
      if (inside.emplace(f->neighbor(i), f_inside != f->is_constrained(i)).second)
        todo.push(f->neighbor(i));
  }
  return triangles;
}

} // namespace plyform
