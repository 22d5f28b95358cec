// SPDX-License-Identifier: GPL-3.0-or-later
// Signed distance to a triangle mesh: closest triangle by CGAL's AABB tree, sign by pseudo-normals.
//
// Symbols: p point, c closest point of the mesh, n unit normal of a triangle, alpha its angle
// at a vertex. Pseudo-normal m of the feature that contains c (Baerentzen and Aanaes, IEEE TVCG 11,
// 2005): of a face n, of an edge the sum of both faces' n, of a vertex the sum of alpha n.
//   face:          s = n . (p - a)                    gradient n                       (1)
//   edge, vertex:  s = sign(m . (p - c)) |p - c|      gradient (p - c)/s               (2)
//
// The result must not depend on the hint. Therefore CGAL's tree is traversed with a visitor of our
// own, which finds the triangle with the smallest pair (computed distance, number) whatever the
// bound it starts from.
#include "contact/shapes/mesh_shape.hpp"

#include "contact/point_triangle.hpp"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace plyform {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Facets = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Facets::const_iterator>;
using Traits = CGAL::AABB_traits<Kernel, Primitive>;
using CgalTree = CGAL::AABB_tree<Traits>;
using Node = CGAL::AABB_node<Traits>;

// A computed distance is wrong by a few ulp of the coordinates: boxes further than the smallest
// distance so far by no more than this (relative to the largest coordinate) are still searched.
constexpr double search_slack = 1e-13;
// Nearer to an edge or vertex than this (relative to the largest coordinate) the direction to it is
// mostly rounding, and the pseudo-normal serves as normal.
constexpr double feature_radius = 1e-11;

double distance2_to(const CGAL::Bbox_3& box, const Vec3& p) {
  const double x = std::max({box.xmin() - p.x(), p.x() - box.xmax(), 0.0});
  const double y = std::max({box.ymin() - p.y(), p.y() - box.ymax(), 0.0});
  const double z = std::max({box.zmin() - p.z(), p.z() - box.zmax(), 0.0});
  return x * x + y * y + z * z;
}

/// The triangle with the least (distance2, face) pair. A visitor of AABB_tree's traversal.
struct NearestFace {
  using Priority = double; // CGAL visits the child of the higher priority first

  const std::vector<std::array<Vec3, 3>>& corners;
  Facets::const_iterator first;
  double slack; ///< mm
  ClosestPoint closest{{1.0, 0.0, 0.0}, std::numeric_limits<double>::infinity(), 0};
  int face = -1;
  double reach2 = std::numeric_limits<double>::infinity(); ///< mm^2: what is further is skipped

  void test_face(const Vec3& p, int candidate) {
    const auto& [a, b, c] = corners[candidate];
    const Vec3 low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
    if ((low - p).cwiseMax(p - high).cwiseMax(0.0).squaredNorm() > reach2)
      return; // the box of the triangle already excludes it
    const ClosestPoint found = closest_point_on_triangle(p, a, b, c);
    if (found.distance2 > closest.distance2) return;
    if (found.distance2 == closest.distance2 && candidate >= face && face >= 0) return;
    closest = found;
    face = candidate;
    const double reach = std::sqrt(found.distance2) + slack;
    reach2 = reach * reach;
  }
  bool go_further() const { return true; }
  void intersection(const Vec3& p, const Primitive& primitive) {
    test_face(p, static_cast<int>(primitive.id() - first));
  }
  bool do_intersect(const Vec3& p, const Node& node) const {
    return distance2_to(node.bbox(), p) <= reach2;
  }
  std::pair<bool, Priority> do_intersect_with_priority(const Vec3& p, const Node& node) const {
    const double d2 = distance2_to(node.bbox(), p);
    return {d2 <= reach2, -d2};
  }
};

Vec3 unit_normal(const std::array<Vec3, 3>& t) {
  return (t[1] - t[0]).cross(t[2] - t[0]).normalized();
}

double angle_at(const std::array<Vec3, 3>& t, int corner) {
  const Vec3& v = t[corner];
  const Vec3 e = t[(corner + 1) % 3] - v;
  const Vec3 f = t[(corner + 2) % 3] - v;
  return std::atan2(e.cross(f).norm(), e.dot(f));
}

std::pair<std::int32_t, std::int32_t> edge_of(const Triangle& t, std::size_t side) {
  return std::minmax(t[side], t[(side + 1) % 3]);
}

std::vector<std::array<Vec3, 7>> pseudo_normals(const TriMesh& s,
                                                const std::vector<std::array<Vec3, 3>>& corners) {
  std::vector<Vec3> vertex(s.x.size(), Vec3::Zero());
  std::map<std::pair<std::int32_t, std::int32_t>, Vec3> edge;
  for (std::size_t f = 0; f < corners.size(); ++f) {
    const Vec3 n = unit_normal(corners[f]);
    for (std::size_t k = 0; k < 3; ++k) {
      vertex[s.triangles[f][k]] += angle_at(corners[f], static_cast<int>(k)) * n;
      edge.try_emplace(edge_of(s.triangles[f], k), Vec3::Zero()).first->second += n;
    }
  }
  std::vector<std::array<Vec3, 7>> normals(corners.size());
  for (std::size_t f = 0; f < corners.size(); ++f) {
    const Vec3 n = unit_normal(corners[f]);
    // The normals of faces folded flat onto each other cancel: any of them will do.
    const auto unit = [&](const Vec3& m) { return m.norm() > 1e-12 ? m.normalized() : n; };
    normals[f][0] = n;
    for (std::size_t k = 0; k < 3; ++k) {
      normals[f][1 + k] = unit(vertex[s.triangles[f][k]]);
      normals[f][4 + k] = unit(edge.at(edge_of(s.triangles[f], k)));
    }
  }
  return normals;
}

} // namespace

struct MeshShape::Tree {
  Facets facets;
  CgalTree search;

  explicit Tree(const std::vector<std::array<Vec3, 3>>& corners) {
    facets.reserve(corners.size());
    const auto to_cgal = [](const Vec3& x) { return Kernel::Point_3(x.x(), x.y(), x.z()); };
    for (const auto& [a, b, c] : corners)
      facets.emplace_back(to_cgal(a), to_cgal(b), to_cgal(c));
    search.insert(facets.cbegin(), facets.cend());
    search.build(); // CGAL would else build at the first query: a race between threads
  }
};

MeshShape::MeshShape(TriMesh surface) : surface_(std::move(surface)) {
  for (const Vec3& x : surface_.x)
    bounds_.extend(x);
  corners_.reserve(surface_.triangles.size());
  for (const Triangle& t : surface_.triangles)
    corners_.push_back({surface_.x[t[0]], surface_.x[t[1]], surface_.x[t[2]]});
  normals_ = pseudo_normals(surface_, corners_);
  tree_ = std::make_unique<const Tree>(corners_);
}

MeshShape::~MeshShape() = default;

SurfacePoint MeshShape::signed_distance(const Vec3& p, int& hint) const {
  const double scale = std::max({bounds_.min().cwiseAbs().maxCoeff(),
                                 bounds_.max().cwiseAbs().maxCoeff(), p.cwiseAbs().maxCoeff()});
  NearestFace nearest{corners_, tree_->facets.cbegin(), search_slack * scale};
  if (hint >= 0 && hint < static_cast<int>(corners_.size())) nearest.test_face(p, hint);
  tree_->search.traversal_with_priority(p, nearest);
  if (nearest.face < 0)
    return {std::numeric_limits<double>::quiet_NaN(), Vec3::UnitZ()}; // p is NaN
  hint = nearest.face;

  const auto f = static_cast<std::size_t>(nearest.face);
  const auto& [a, b, c] = corners_[f];
  const Vec3& m = normals_[f][nearest.closest.feature];
  if (nearest.closest.feature == 0) return {m.dot(p - a), m}; // (1)
  const auto& w = nearest.closest.w;
  const Vec3 d = p - (w[0] * a + w[1] * b + w[2] * c);
  const double length = d.norm(), sign = m.dot(d) < 0.0 ? -1.0 : 1.0; // (2)
  if (length <= feature_radius * scale) return {sign * length, m};
  return {sign * length, d * (sign / length)};
}

} // namespace plyform
