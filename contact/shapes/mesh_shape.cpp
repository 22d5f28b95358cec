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
// bound it starts from. The search also finds the distance d' of the next triangle that shares no
// node with it: as long as the point is nearer than (d' - d) / 2 to where it was searched, the
// closest triangle is the one found then or one around it, and the tree is asked once in many
// steps.
//
// Nor need all those be measured at each step. Let p have its foot inside triangle G, a height s
// above its plane and e from its sides. A triangle whose image on that plane does not overlap G and
// which rises no more than r above it has a point q with |p - q|^2 >= e^2 + s^2 - 2 s r, so G is
// the closest if e^2 > 2 s r. With the least weight w of the foot and the least height H of G, e is
// at least w H:
//   w^2 > s c,  c = 2 r / H^2, of the triangles below the plane if p is (3)
#include "contact/shapes/mesh_shape.hpp"

#include "contact/point_triangle.hpp"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>
#include <algorithm>
#include <cmath>
#include <limits>
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
// mm: how much further than the closest triangle the next one is searched.
constexpr double widest = 2.0;

double distance2_to(const CGAL::Bbox_3& box, const Vec3& p) {
  const double x = std::max({box.xmin() - p.x(), p.x() - box.xmax(), 0.0});
  const double y = std::max({box.ymin() - p.y(), p.y() - box.ymax(), 0.0});
  const double z = std::max({box.zmin() - p.z(), p.z() - box.zmax(), 0.0});
  return x * x + y * y + z * z;
}

double distance2_to_box_of(const std::array<Vec3, 3>& triangle, const Vec3& p) {
  const auto& [a, b, c] = triangle;
  const Vec3 low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
  return (low - p).cwiseMax(p - high).cwiseMax(0.0).squaredNorm();
}

/// A visitor of AABB_tree's traversal that looks at triangles within a reach, nearest boxes first.
struct FaceVisitor {
  using Priority = double; // CGAL visits the child of the higher priority first

  Facets::const_iterator first;
  double reach2 = std::numeric_limits<double>::infinity(); ///< mm^2: what is further is skipped

  int number(const Primitive& primitive) const { return static_cast<int>(primitive.id() - first); }
  bool go_further() const { return true; }
  bool do_intersect(const Vec3& p, const Node& node) const {
    return distance2_to(node.bbox(), p) <= reach2;
  }
  std::pair<bool, Priority> do_intersect_with_priority(const Vec3& p, const Node& node) const {
    const double d2 = distance2_to(node.bbox(), p);
    return {d2 <= reach2, -d2};
  }
};

/// The triangle with the least (distance2, face) pair.
struct NearestFace : FaceVisitor {
  const std::vector<std::array<Vec3, 3>>& corners;
  double slack; ///< mm
  ClosestPoint closest{{1.0, 0.0, 0.0}, std::numeric_limits<double>::infinity(), 0};
  int face = -1;

  NearestFace(Facets::const_iterator first_face, const std::vector<std::array<Vec3, 3>>& of,
              double off)
      : FaceVisitor{first_face}, corners(of), slack(off) {}
  void test_face(const Vec3& p, int candidate) {
    if (distance2_to_box_of(corners[candidate], p) > reach2) return;
    const auto& [a, b, c] = corners[candidate];
    const ClosestPoint found = closest_point_on_triangle(p, a, b, c);
    if (found.distance2 > closest.distance2) return;
    if (found.distance2 == closest.distance2 && candidate >= face && face >= 0) return;
    closest = found;
    face = candidate;
    const double reach = std::sqrt(found.distance2) + slack;
    reach2 = reach * reach;
  }
  void intersection(const Vec3& p, const Primitive& primitive) { test_face(p, number(primitive)); }
};

/// The least distance of a triangle that shares no node with the closest one.
struct NextFace : FaceVisitor {
  const std::vector<std::array<Vec3, 3>>& corners;
  const std::vector<Triangle>& nodes;
  const Triangle& closest;

  NextFace(Facets::const_iterator first_face, const std::vector<std::array<Vec3, 3>>& of,
           const std::vector<Triangle>& nodes_of, int nearest, double reach)
      : FaceVisitor{first_face, reach * reach}, corners(of), nodes(nodes_of),
        closest(nodes[static_cast<std::size_t>(nearest)]) {}
  void intersection(const Vec3& p, const Primitive& primitive) {
    const auto f = static_cast<std::size_t>(number(primitive));
    if (distance2_to_box_of(corners[f], p) > reach2) return;
    const Triangle& t = nodes[f];
    if (std::find_first_of(t.begin(), t.end(), closest.begin(), closest.end()) != t.end()) return;
    const auto& [a, b, c] = corners[f];
    reach2 = std::min(reach2, closest_point_on_triangle(p, a, b, c).distance2);
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

using FacesOfNode = std::vector<std::vector<std::int32_t>>;

FacesOfNode incident_faces(const TriMesh& s) {
  FacesOfNode faces(s.x.size());
  for (std::size_t f = 0; f < s.triangles.size(); ++f)
    for (const std::int32_t n : s.triangles[f])
      faces[n].push_back(static_cast<std::int32_t>(f));
  return faces;
}

bool has_node(const Triangle& t, std::int32_t node) {
  return t[0] == node || t[1] == node || t[2] == node;
}

std::vector<std::array<Vec3, 7>> pseudo_normals(const TriMesh& s,
                                                const std::vector<std::array<Vec3, 3>>& corners,
                                                const FacesOfNode& faces_of_node) {
  std::vector<Vec3> vertex(s.x.size(), Vec3::Zero());
  std::vector<std::array<Vec3, 7>> normals(corners.size());
  for (std::size_t f = 0; f < corners.size(); ++f) {
    const Vec3& n = normals[f][0] = unit_normal(corners[f]);
    for (std::size_t k = 0; k < 3; ++k)
      vertex[s.triangles[f][k]] += angle_at(corners[f], static_cast<int>(k)) * n;
  }
  for (std::size_t f = 0; f < corners.size(); ++f) {
    const Triangle& t = s.triangles[f];
    // The normals of faces folded flat onto each other cancel: any of them will do.
    const auto unit = [&](const Vec3& m) {
      return m.norm() > 1e-12 ? m.normalized() : normals[f][0];
    };
    for (std::size_t k = 0; k < 3; ++k) {
      Vec3 edge = Vec3::Zero();
      for (const std::int32_t g : faces_of_node[t[k]]) // f, and at most one face on the other side
        if (has_node(s.triangles[g], t[(k + 1) % 3])) edge += normals[g][0];
      normals[f][1 + k] = unit(vertex[t[k]]);
      normals[f][4 + k] = unit(edge);
    }
  }
  return normals;
}

/// Whether a side of triangle s, counter-clockwise in the plane, has all of t outside or on it.
bool separates(const std::array<Vec2, 3>& s, const std::array<Vec2, 3>& t) {
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec2& from = s[k];
    const Vec2 side = s[(k + 1) % 3] - from;
    if (std::all_of(t.begin(), t.end(), [&](const Vec2& q) {
          return side.x() * (q - from).y() - side.y() * (q - from).x() <= 0.0;
        }))
      return true;
  }
  return false;
}

/// A triangle and its plane, for (3).
class Foot {
public:
  explicit Foot(const std::array<Vec3, 3>& corners) : origin_(corners[0]) {
    const Vec3 first = (corners[1] - corners[0]).normalized();
    axes_.row(2) = unit_normal(corners);
    axes_.row(0) = first;
    axes_.row(1) = axes_.row(2).transpose().cross(first);
    image_ = image_of(corners).first;
  }

  /// Raises `rise`, mm above and below the plane, to hold a neighbour; infinite if it overlaps.
  void raise(const std::array<Vec3, 3>& neighbour, std::array<double, 2>& rise) const {
    const auto [image, height] = image_of(neighbour);
    const Vec2 p = image[1] - image[0], q = image[2] - image[0];
    const bool upright = p.x() * q.y() - p.y() * q.x() > 0.0; // counter-clockwise in the plane
    const bool apart = separates(image_, image) || (upright && separates(image, image_));
    for (std::size_t side = 0; side < 2; ++side)
      for (const double h : height)
        rise[side] = std::max(rise[side], apart ? (side == 0 ? h : -h)
                                                : std::numeric_limits<double>::infinity());
  }

  double least_height() const {
    const auto& [a, b, c] = image_;
    const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    return std::abs((b - a).x() * (c - a).y() - (b - a).y() * (c - a).x()) / longest;
  }

private:
  std::pair<std::array<Vec2, 3>, std::array<double, 3>>
  image_of(const std::array<Vec3, 3>& corners) const {
    std::pair<std::array<Vec2, 3>, std::array<double, 3>> found;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 q = axes_ * (corners[k] - origin_);
      found.first[k] = q.head<2>();
      found.second[k] = q.z();
    }
    return found;
  }

  Vec3 origin_;
  Eigen::Matrix3d axes_;
  std::array<Vec2, 3> image_;
};

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
    largest_ = std::max(largest_, x.cwiseAbs().maxCoeff());
  corners_.reserve(surface_.triangles.size());
  for (const Triangle& t : surface_.triangles)
    corners_.push_back({surface_.x[t[0]], surface_.x[t[1]], surface_.x[t[2]]});
  faces_of_node_ = incident_faces(surface_);
  normals_ = pseudo_normals(surface_, corners_, faces_of_node_);
  tree_ = std::make_unique<const Tree>(corners_);
}

MeshShape::~MeshShape() = default;

const MeshCurvature& MeshShape::curvature() const {
  std::call_once(curvature_asked_, [this] { curvature_ = mesh_curvature(surface_); });
  return curvature_;
}

template <class Visit>
void MeshShape::visit_around(int face, const Visit& visit) const {
  visit(face);
  const auto& [a, b, c] = surface_.triangles[face];
  for (const std::int32_t f : faces_of_node_[a])
    if (f != face) visit(f);
  for (const std::int32_t f : faces_of_node_[b])
    if (!has_node(surface_.triangles[f], a)) visit(f);
  for (const std::int32_t f : faces_of_node_[c])
    if (!has_node(surface_.triangles[f], a) && !has_node(surface_.triangles[f], b)) visit(f);
}

float MeshShape::clear_way(const Vec3& p, int face, double distance, double off) const {
  NextFace next(tree_->facets.cbegin(), corners_, surface_.triangles, face, distance + widest);
  tree_->search.traversal_with_priority(p, next);
  constexpr double below = 1.0 - 1e-6; // rounding of distances must not increase it
  return rounded_down(std::max(0.5 * (below * std::sqrt(next.reach2) - distance) - off, 0.0));
}

void MeshShape::remember(const Vec3& p, int face, double distance, bool slides,
                         SurfaceHint& hint) const {
  const Eigen::Vector3f at = p.cast<float>();
  const double off = (at.cast<double>() - p).norm();
  Eigen::Map<Eigen::Vector3f>(hint.at) = at;
  hint.distance = rounded_down(distance - off);
  hint.clear = slides ? clear_way(p, face, std::abs(distance), off) : 0.0F;
  hint.facet = face;
  hint.nearest = -1;
}

SurfacePoint MeshShape::at_closest(const Vec3& p, int face, const ClosestPoint& closest,
                                   double on_surface) const {
  const auto f = static_cast<std::size_t>(face);
  const auto& [a, b, c] = corners_[f];
  const Vec3& m = normals_[f][closest.feature];
  if (closest.feature == 0) return {m.dot(p - a), m}; // (1)
  const auto& w = closest.w;
  const Vec3 d = p - (w[0] * a + w[1] * b + w[2] * c);
  const double length = d.norm(), sign = m.dot(d) < 0.0 ? -1.0 : 1.0; // (2)
  if (length <= on_surface) return {sign * length, m};
  return {sign * length, d * (sign / length)};
}

void MeshShape::compare_with_neighbours(int face, SurfaceHint& hint) const {
  const Foot foot(corners_[static_cast<std::size_t>(face)]);
  std::array<double, 2> rise{};
  visit_around(hint.facet, [&](int f) {
    if (f != face) foot.raise(corners_[f], rise);
  });
  const double height = foot.least_height();
  constexpr double rounding = 1e-12, above = 1.0 + 1e-6; // of the largest coordinate; to float
  for (std::size_t side = 0; side < 2; ++side)
    hint.concavity[side] =
        static_cast<float>(above * 2.0 * (rise[side] + rounding * largest_) / (height * height));
  hint.nearest = face;
}

bool MeshShape::found_at_once(const Vec3& p, const SurfaceHint& hint, SurfacePoint& found) const {
  const auto f = static_cast<std::size_t>(hint.nearest);
  const auto& [a, b, c] = corners_[f];
  const ClosestPoint foot = closest_point_on_triangle(p, a, b, c);
  if (foot.feature != 0) return false;
  const Vec3& n = normals_[f][0];
  const double s = n.dot(p - a), w = std::min({foot.w[0], foot.w[1], foot.w[2]});
  constexpr double rounding = 1e-6;
  if (!(w * w > std::abs(s) * double{hint.concavity[s < 0.0 ? 1 : 0]} + rounding)) return false;
  found = {s, n}; // (1)
  return true;
}

SurfacePoint MeshShape::signed_distance(const Vec3& p, SurfaceHint& hint) const {
  const bool asked = hint.facet >= 0 && hint.facet < static_cast<int>(corners_.size());
  const double moved = (p - Vec3(hint.at[0], hint.at[1], hint.at[2])).norm();
  const bool around = asked && moved < double{hint.clear};
  if (SurfacePoint found; around && hint.nearest >= 0 && found_at_once(p, hint, found))
    return found;
  const double scale = std::max(largest_, p.cwiseAbs().maxCoeff());
  NearestFace nearest(tree_->facets.cbegin(), corners_, search_slack * scale);
  if (asked) visit_around(hint.facet, [&](int f) { nearest.test_face(p, f); });
  const bool search = nearest.face < 0 || !around;
  if (search) tree_->search.traversal_with_priority(p, nearest);
  if (nearest.face < 0)
    return {std::numeric_limits<double>::quiet_NaN(), Vec3::UnitZ()}; // p is NaN
  const SurfacePoint found = at_closest(p, nearest.face, nearest.closest, feature_radius * scale);
  if (search) remember(p, nearest.face, found.distance, asked && moved < 0.5 * widest, hint);
  if (nearest.closest.feature == 0 && hint.clear > 0.0F && hint.nearest != nearest.face)
    compare_with_neighbours(nearest.face, hint);
  return found;
}

} // namespace plyform
