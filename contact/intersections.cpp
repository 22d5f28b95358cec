// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/intersections.hpp"

#include "base/format.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/intersections.h>
#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>
#include <variant>

namespace plyform {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Segment = Kernel::Segment_3;
/// A possibly degenerate triangle as point, segment or triangle: CGAL's triangle predicates need
/// three corners that are not collinear.
using Shape = std::variant<Point, Segment, Kernel::Triangle_3>;

struct Face {
  int sheet, index;
  Triangle node;
  std::array<Point, 3> x;
  Shape shape;
};
using FaceBox = CGAL::Box_intersection_d::Box_with_handle_d<double, 3, const Face*>;

bool meet(const Shape& a, const Shape& b) {
  return std::visit([](const auto& s, const auto& t) { return bool(CGAL::do_intersect(s, t)); }, a,
                    b);
}

Shape make_shape(const Point& a, const Point& b) {
  if (a == b) return a;
  return Segment(a, b);
}

Shape make_shape(const std::array<Point, 3>& x) {
  if (!CGAL::collinear(x[0], x[1], x[2])) return Kernel::Triangle_3(x[0], x[1], x[2]);
  // Collinear points are ordered along their line as by their coordinates.
  const auto [low, high] = std::minmax_element(x.begin(), x.end());
  return make_shape(*low, *high);
}

/// A piece of a face that is star-shaped about its corner k, and the side of the piece opposite to
/// that corner. A triangle is one such piece; a segment that has the corner in its interior gives
/// two; a point gives none.
struct Piece {
  Shape fan, opposite;
};
std::vector<Piece> fans(const Face& face, int k) {
  const Point &v = face.x[k], &a = face.x[(k + 1) % 3], &b = face.x[(k + 2) % 3];
  if (face.shape.index() == 2) return {{face.shape, Segment(a, b)}};
  std::vector<Piece> pieces;
  for (const Point& end : {a, b})
    if (end != v) pieces.push_back({Segment(v, end), end});
  return pieces;
}

/// Whether two faces that share one node, at corners k and l, meet beyond it. A ray from the node
/// through a common point leaves one of the two pieces first, through its opposite side and still
/// inside the other: so it is enough to test opposite sides against pieces.
bool meet_beyond_corner(const Face& f, int k, const Face& g, int l) {
  if (f.shape.index() == 2 && g.shape.index() == 2) { // the usual case, without allocation
    return meet(Segment(f.x[(k + 1) % 3], f.x[(k + 2) % 3]), g.shape) ||
           meet(f.shape, Segment(g.x[(l + 1) % 3], g.x[(l + 2) % 3]));
  }
  for (const Piece& p : fans(f, k))
    for (const Piece& q : fans(g, l))
      if (meet(p.opposite, q.fan) || meet(p.fan, q.opposite)) return true;
  return false;
}

/// Whether faces p q r and p q s, which share the edge p q, meet beyond it: only if they are folded
/// flat onto each other, or, if degenerate, if both extend beyond the same end of p q.
bool meet_beyond_edge(const Face& f, const Face& g, const Point& p, const Point& q, const Point& r,
                      const Point& s) {
  const bool f_flat = f.shape.index() != 2, g_flat = g.shape.index() != 2;
  if (!f_flat && !g_flat)
    return CGAL::coplanar(p, q, r, s) && CGAL::coplanar_orientation(p, q, r, s) == CGAL::POSITIVE;
  if (!f_flat || !g_flat) return false; // the degenerate one lies along p q, where they may touch
  if (p == q)
    return p != r && p != s && CGAL::collinear(p, r, s) &&
           !CGAL::collinear_are_ordered_along_line(r, p, s);
  const auto outside = [](const Point& from, const Point& end, const Point& x) {
    return CGAL::collinear_are_strictly_ordered_along_line(from, end, x);
  };
  return (outside(p, q, r) && outside(p, q, s)) || (outside(q, p, r) && outside(q, p, s));
}

/// The corner of `face` at `node`, or none.
std::optional<int> corner_at(const Face& face, std::int32_t node) {
  for (int k = 0; k < 3; ++k)
    if (face.node[k] == node) return k;
  return std::nullopt;
}

/// The first corner of `face` at a node that `other` does not have.
std::optional<int> corner_not_in(const Face& face, const Face& other) {
  for (int k = 0; k < 3; ++k)
    if (!corner_at(other, face.node[k])) return k;
  return std::nullopt;
}

bool intersect(const Face& f, const Face& g) {
  if (f.sheet != g.sheet) return meet(f.shape, g.shape);
  std::array<int, 3> shared{}; // corners of f at different nodes that g has too
  int count = 0;
  for (int k = 0; k < 3; ++k)
    if (corner_at(f, f.node[k]) == k && corner_at(g, f.node[k])) shared[count++] = k;
  if (count == 0) return meet(f.shape, g.shape);
  if (count == 1) return meet_beyond_corner(f, shared[0], g, *corner_at(g, f.node[shared[0]]));
  if (count == 3) return true; // the same triangle twice
  const auto r = corner_not_in(f, g), s = corner_not_in(g, f);
  if (!r || !s) return false; // one face names a node twice and so is the shared edge itself
  return meet_beyond_edge(f, g, f.x[shared[0]], f.x[shared[1]], f.x[*r], g.x[*s]);
}

std::vector<Point> checked_points(const MeshView& sheet, int sheet_number) {
  std::vector<Point> points;
  points.reserve(sheet.x.size());
  for (const Vec3& x : sheet.x) {
    if (!x.allFinite())
      throw std::runtime_error(fmt::format(
          "audit: node {} of sheet {} is not finite ({}, {}, {}); intersections are only defined "
          "for finite positions: look for the step where it was lost",
          points.size(), sheet_number, x.x(), x.y(), x.z()));
    points.emplace_back(x.x(), x.y(), x.z());
  }
  return points;
}

std::vector<Face> collect_faces(const MeshView& sheet, int number) {
  std::vector<Face> faces;
  faces.reserve(sheet.triangles.size());
  const std::vector<Point> points = checked_points(sheet, number);
  for (int t = 0; t < int(sheet.triangles.size()); ++t) {
    const Triangle& node = sheet.triangles[t];
    for (const std::int32_t n : node)
      if (n < 0 || std::size_t(n) >= points.size())
        throw std::runtime_error(fmt::format("audit: triangle {} of sheet {} names node {} of {}",
                                             t, number, n, points.size()));
    const std::array<Point, 3> x{points[node[0]], points[node[1]], points[node[2]]};
    faces.push_back({number, t, node, x, make_shape(x)});
  }
  return faces;
}

std::vector<FaceBox> boxes_of(const std::vector<Face>& faces) {
  std::vector<FaceBox> boxes;
  boxes.reserve(faces.size());
  for (const Face& face : faces)
    boxes.emplace_back(face.x[0].bbox() + face.x[1].bbox() + face.x[2].bbox(), &face);
  return boxes;
}

/// The intersections of the faces of two sheets, or of one if both are the same.
std::vector<Intersection> intersections_of(const std::vector<Face>& a, const std::vector<Face>& b) {
  std::vector<Intersection> found;
  const auto compare = [&found](const FaceBox& left, const FaceBox& right) {
    const Face *f = left.handle(), *g = right.handle();
    if (std::pair(g->sheet, g->index) < std::pair(f->sheet, f->index)) std::swap(f, g);
    if (intersect(*f, *g)) found.push_back({f->sheet, f->index, g->sheet, g->index});
  };
  std::vector<FaceBox> of_a = boxes_of(a); // CGAL sorts them
  if (&a == &b) {
    CGAL::box_self_intersection_d(of_a.begin(), of_a.end(), compare);
  } else {
    std::vector<FaceBox> of_b = boxes_of(b);
    CGAL::box_intersection_d(of_a.begin(), of_a.end(), of_b.begin(), of_b.end(), compare);
  }
  return found;
}

} // namespace

Intersections find_intersections(std::span<const MeshView> sheets, const RunTasks& run) {
  const int n = static_cast<int>(sheets.size());
  std::vector<std::vector<Face>> faces(sheets.size());
  run(n, [&](int s) { faces[at(s)] = collect_faces(sheets[at(s)], s); });
  std::vector<std::array<std::size_t, 2>> pairs;
  for (std::size_t a = 0; a < faces.size(); ++a)
    for (std::size_t b = a; b < faces.size(); ++b)
      pairs.push_back({a, b});
  std::vector<std::vector<Intersection>> found(pairs.size());
  run(static_cast<int>(pairs.size()), [&](int i) {
    const auto [a, b] = pairs[at(i)];
    found[at(i)] = intersections_of(faces[a], faces[b]);
  });
  Intersections result;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    auto& list = pairs[i][0] == pairs[i][1] ? result.within : result.between;
    list.insert(list.end(), found[i].begin(), found[i].end());
  }
  for (auto* list : {&result.between, &result.within}) {
    std::sort(list->begin(), list->end());
    list->erase(std::unique(list->begin(), list->end()), list->end());
  }
  return result;
}

Intersections find_intersections(std::span<const MeshView> sheets) {
  return find_intersections(sheets, [](int count, const std::function<void(int)>& task) {
    for (int i = 0; i < count; ++i)
      task(i);
  });
}

} // namespace plyform
