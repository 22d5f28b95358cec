// SPDX-License-Identifier: GPL-3.0-or-later
// triangulate_faces of CGAL 5.5 goes down on outlines that cross themselves; here the same points
// that were found simple are triangulated, with exact predicates.
#include "contact/shapes/split_polygons.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_2_algorithms.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <utility>

namespace plyform {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_2;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::size_t, Kernel>;
using FaceBase = CGAL::Constrained_triangulation_face_base_2<
    Kernel, CGAL::Triangulation_face_base_with_info_2<bool, Kernel>>; // info: outside
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>>;
using Polygon = std::vector<std::size_t>;

/// Two of the three coordinates, so that they stay exact, anticlockwise; nothing if it has no area.
std::vector<Point> seen_along_normal(const std::vector<Vec3>& points, const Polygon& polygon) {
  Vec3 normal = Vec3::Zero(); // Newell's
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec3& from = points[polygon[0]];
    normal += (points[polygon[k]] - from).cross(points[polygon[(k + 1) % polygon.size()]] - from);
  }
  Eigen::Index axis = 0;
  if (normal.cwiseAbs().maxCoeff(&axis) == 0.0) return {};
  Eigen::Index u = (axis + 1) % 3, v = (axis + 2) % 3;
  if (normal[axis] < 0.0) std::swap(u, v);
  std::vector<Point> seen;
  for (const std::size_t corner : polygon)
    seen.emplace_back(points[corner][u], points[corner][v]);
  return seen;
}

void mark_outside(Triangulation& mesh) {
  for (const auto face : mesh.all_face_handles())
    face->info() = false;
  std::vector<Triangulation::Face_handle> next{mesh.infinite_face()};
  while (!next.empty()) {
    const auto face = next.back();
    next.pop_back();
    if (face->info()) continue;
    face->info() = true;
    for (int i = 0; i < 3; ++i)
      if (!face->is_constrained(i)) next.push_back(face->neighbor(i));
  }
}

bool split(const std::vector<Vec3>& points, const Polygon& polygon, std::vector<Polygon>& into) {
  const std::vector<Point> seen = seen_along_normal(points, polygon);
  if (seen.empty() || !CGAL::is_simple_2(seen.begin(), seen.end(), Kernel())) return false;
  Triangulation mesh;
  std::vector<Triangulation::Vertex_handle> corners;
  for (std::size_t k = 0; k < seen.size(); ++k) {
    corners.push_back(mesh.insert(seen[k]));
    corners.back()->info() = polygon[k];
  }
  for (std::size_t k = 0; k < corners.size(); ++k)
    mesh.insert_constraint(corners[k], corners[(k + 1) % corners.size()]);
  mark_outside(mesh);
  for (const auto face : mesh.finite_face_handles())
    if (!face->info())
      into.push_back({face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
  return true;
}

} // namespace

std::ptrdiff_t split_polygons(const std::vector<Vec3>& points,
                              std::vector<std::vector<std::size_t>>& polygons) {
  std::vector<Polygon> into;
  into.reserve(polygons.size());
  for (std::size_t i = 0; i < polygons.size(); ++i)
    if (polygons[i].size() <= 4)
      into.push_back(polygons[i]);
    else if (!split(points, polygons[i], into))
      return static_cast<std::ptrdiff_t>(i);
  polygons = std::move(into);
  return -1;
}

} // namespace plyform
