// SPDX-License-Identifier: GPL-3.0-or-later
// Makes a clean tool mesh from the polygons of a file: merged, manifold, oriented; closed meshes
// outward and free of self-intersections. Signs by pseudo-normals are only right on such meshes.
#include "contact/shapes/tool_mesh.hpp"

#include "base/format.hpp"
#include "contact/shapes/mesh_shape.hpp"
#include "contact/shapes/split_polygons.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_degeneracies.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/assertions_behaviour.h>
#include <algorithm>
#include <mutex>
#include <stdexcept>
#include <utility>

namespace plyform {
namespace {

namespace PMP = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel; // exact predicates: self-touch
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Polygons = std::vector<std::vector<std::size_t>>;
using Edge = std::pair<std::size_t, std::size_t>;
/// Edges and how many faces each has, in order.
using EdgeCount = std::vector<std::pair<Edge, int>>;

[[noreturn]] void fail(const std::string& name, const std::string& text) {
  throw std::runtime_error(name + ": " + text);
}

std::string text_of(const Point& p) {
  return fmt::format("({:g}, {:g}, {:g})", p.x(), p.y(), p.z());
}

void check(const PolygonSoup& soup, const std::string& name) {
  for (std::size_t i = 0; i < soup.points.size(); ++i)
    if (!soup.points[i].allFinite())
      fail(name, fmt::format("a coordinate of point {} is not a finite number; export "
                             "the mesh again",
                             i));
  constexpr double most = 1e5; // mm, as lengths in a case
  for (const Vec3& p : soup.points)
    if (p.cwiseAbs().maxCoeff() > most)
      fail(name, fmt::format("a point lies at ({:g}, {:g}, {:g}) mm, more than 100 m away; "
                             "check the file's unit and scale",
                             p.x(), p.y(), p.z()));
  if (soup.polygons.empty())
    fail(name, "it holds no faces; it may be truncated, or hold points or curves only: export the "
               "surface as triangles");
  for (std::size_t f = 0; f < soup.polygons.size(); ++f)
    for (const std::size_t i : soup.polygons[f])
      if (i >= soup.points.size())
        fail(name, fmt::format("face {} names point {}, but there are only {}; export the mesh "
                               "again",
                               f, i, soup.points.size()));
}

/// Keeps CGAL from printing what it finds wrong; it throws all the same. Its handlers are one for
/// all threads: the first to come sets them, the last to go puts them back.
class QuietCgal {
public:
  QuietCgal() {
    const std::lock_guard lock(one_);
    if (present_++ > 0) return;
    errors_ = CGAL::set_error_handler(&quiet);
    warnings_ = CGAL::set_warning_handler(&quiet);
  }
  ~QuietCgal() {
    const std::lock_guard lock(one_);
    if (--present_ > 0) return;
    CGAL::set_error_handler(errors_);
    CGAL::set_warning_handler(warnings_);
  }
  QuietCgal(const QuietCgal&) = delete;
  QuietCgal& operator=(const QuietCgal&) = delete;

private:
  static void quiet(const char*, const char*, const char*, int, const char*) {}
  static inline std::mutex one_;
  static inline int present_ = 0;
  static inline CGAL::Failure_function errors_ = nullptr, warnings_ = nullptr;
};

/// Removes faces that name a corner twice or have fewer than three corners; returns their number.
std::size_t drop_collapsed(Polygons& polygons) {
  return std::erase_if(polygons, [](const std::vector<std::size_t>& polygon) {
    std::vector<std::size_t> corners = polygon;
    std::sort(corners.begin(), corners.end());
    return corners.size() < 3 ||
           std::adjacent_find(corners.begin(), corners.end()) != corners.end();
  });
}

EdgeCount count_edges(const Polygons& polygons) {
  std::vector<Edge> edges;
  for (const auto& polygon : polygons)
    for (std::size_t k = 0; k < polygon.size(); ++k)
      edges.emplace_back(std::minmax(polygon[k], polygon[(k + 1) % polygon.size()]));
  std::sort(edges.begin(), edges.end());
  EdgeCount count;
  for (const Edge& edge : edges)
    if (!count.empty() && count.back().first == edge)
      ++count.back().second;
    else
      count.emplace_back(edge, 1);
  return count;
}

std::size_t count_borders(const EdgeCount& edges) {
  return static_cast<std::size_t>(
      std::count_if(edges.begin(), edges.end(), [](const auto& e) { return e.second == 1; }));
}

/// Orients neighbouring faces consistently. Throws std::runtime_error if that is impossible.
void orient(std::vector<Point>& points, Polygons& polygons, const std::string& name) {
  const EdgeCount edges = count_edges(polygons);
  for (const auto& [edge, faces] : edges)
    if (faces > 2)
      fail(name, fmt::format("not orientable: {} faces share the edge from {} to {}, so it has no "
                             "two sides there; remove walls inside the part",
                             faces, text_of(points[edge.first]), text_of(points[edge.second])));
  PMP::orient_polygon_soup(points, polygons);
  // CGAL cuts a one-sided surface open along edges: then there are more borders than before.
  const std::size_t before = count_borders(edges), after = count_borders(count_edges(polygons));
  if (after != before)
    fail(name, fmt::format("not orientable: it is a one-sided surface like a Moebius strip ({} "
                           "edges join faces whose sides cannot agree); make it two-sided",
                           (after - before) / 2));
}

void split_large_faces(const std::vector<Point>& points, Polygons& polygons,
                       const std::string& name) {
  std::vector<Vec3> corners; // merging has renumbered them
  corners.reserve(points.size());
  for (const Point& p : points)
    corners.emplace_back(p.x(), p.y(), p.z());
  const std::ptrdiff_t bad = split_polygons(corners, polygons);
  if (bad < 0) return;
  const auto& polygon = polygons[static_cast<std::size_t>(bad)];
  fail(name, fmt::format("a face of {} corners near {} crosses or touches itself, seen along its "
                         "normal, and cannot be split into triangles; export triangles",
                         polygon.size(), text_of(points[polygon.front()])));
}

std::size_t remove_flat_faces(Mesh& mesh, const std::string& name) {
  std::vector<Mesh::Face_index> flat;
  PMP::degenerate_faces(mesh, std::back_inserter(flat));
  if (flat.empty()) return 0;
  if (flat.size() == mesh.number_of_faces())
    fail(name, "none of its faces has an area; check the units and the export");
  if (!PMP::remove_degenerate_faces(mesh))
    fail(name, fmt::format("{} faces without area cannot be taken out without tearing it; repair "
                           "the mesh",
                           flat.size()));
  mesh.collect_garbage();
  return flat.size();
}

/// Orients a closed mesh outward (inner shells inward); returns whether that changed anything.
bool turn_outward(Mesh& mesh, const std::string& name) {
  std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> crossing;
  PMP::self_intersections(mesh, std::back_inserter(crossing));
  if (!crossing.empty()) {
    const Mesh::Halfedge_index h = mesh.halfedge(crossing.front().first);
    fail(name, fmt::format("the closed mesh crosses or touches itself at {} pairs of faces, first "
                           "near {}; inside and outside are not clear there: repair it or unite "
                           "its parts",
                           crossing.size(), text_of(mesh.point(mesh.target(h)))));
  }
  const double before = PMP::volume(mesh);
  PMP::orient_to_bound_a_volume(mesh);
  const double after = PMP::volume(mesh);
  return std::abs(after - before) > 1e-9 * after;
}

TriMesh surface_of(const Mesh& mesh) {
  TriMesh surface;
  std::vector<std::int32_t> number(mesh.num_vertices(), -1);
  for (const Mesh::Face_index f : mesh.faces()) {
    Triangle triangle{};
    std::size_t k = 0;
    for (const Mesh::Vertex_index v : vertices_around_face(mesh.halfedge(f), mesh)) {
      std::int32_t& n = number[v.idx()];
      if (n < 0) {
        n = static_cast<std::int32_t>(surface.x.size());
        const Point& p = mesh.point(v);
        surface.x.emplace_back(p.x(), p.y(), p.z());
      }
      triangle[k++] = n;
    }
    surface.triangles.push_back(triangle);
  }
  return surface;
}

TriMesh clean_surface(PolygonSoup soup, const std::string& name, MeshReport& done) {
  std::vector<Point> points;
  points.reserve(soup.points.size());
  for (const Vec3& p : soup.points)
    points.emplace_back(p.x(), p.y(), p.z());
  PMP::merge_duplicate_points_in_polygon_soup(points, soup.polygons);
  done.removed_degenerate = drop_collapsed(soup.polygons);
  PMP::merge_duplicate_polygons_in_polygon_soup(points, soup.polygons,
                                                CGAL::parameters::erase_all_duplicates(false));
  if (soup.polygons.empty())
    fail(name, "none of its faces has an area; check the units and the export");
  orient(points, soup.polygons, name);
  split_large_faces(points, soup.polygons, name);

  Mesh mesh;
  PMP::polygon_soup_to_polygon_mesh(points, soup.polygons, mesh);
  if (!PMP::triangulate_faces(mesh) || !CGAL::is_triangle_mesh(mesh)) // says true of some it leaves
    fail(name,
         "a face of more than three corners cannot be split into triangles; export triangles");
  done.removed_degenerate += remove_flat_faces(mesh, name);
  done.closed = CGAL::is_closed(mesh);
  if (done.closed) done.flipped = turn_outward(mesh, name);
  return surface_of(mesh);
}

} // namespace

MeshShapePtr make_mesh_shape(PolygonSoup soup, const std::string& name, MeshReport* report) {
  check(soup, name);
  MeshReport done;
  TriMesh surface;
  try {
    const QuietCgal quiet;
    surface = clean_surface(std::move(soup), name, done);
  } catch (const CGAL::Failure_exception& failed) { // of a face that folds onto itself, say
    fail(name, fmt::format("it cannot be made a clean surface (CGAL misses {}); repair the mesh",
                           failed.expression()));
  }
  done.vertices = surface.x.size();
  done.faces = surface.triangles.size();
  if (report) *report = done;
  return std::make_shared<const MeshShape>(std::move(surface));
}

MeshShapePtr make_mesh_shape(const TriMesh& surface, MeshReport* report) {
  PolygonSoup soup{surface.x, {}};
  soup.polygons.reserve(surface.triangles.size());
  for (const auto& [a, b, c] : surface.triangles)
    soup.polygons.push_back({static_cast<std::size_t>(a), static_cast<std::size_t>(b),
                             static_cast<std::size_t>(c)}); // a negative number is out of range
  return make_mesh_shape(std::move(soup), "tool mesh", report);
}

} // namespace plyform
