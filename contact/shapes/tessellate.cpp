// SPDX-License-Identifier: GPL-3.0-or-later
// Triangles of a tool, for pictures and the exact check of intersections. Nodes lie on the surface,
// so curved parts are inscribed: a chord of length l deviates from a circle of radius R by
// l^2/(8 R).
#include "base/format.hpp"
#include "contact/shapes/fill_polygon.hpp"
#include "contact/shapes/shape_distance.hpp"

#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace plyform {
namespace {

// rad: arcs are divided into pieces of at most 22.5 degrees, so that small fillets keep their shape
// however coarse the mesh is.
constexpr double largest_turn = std::numbers::pi / 8.0;

int pieces(double length, double size) {
  return std::max(1, static_cast<int>(std::ceil(length / size - 1e-9)));
}

/// The profile as points about `size` apart; a ring does not repeat its first point.
std::vector<Vec2> section_points(const Profile& profile, double size) {
  std::vector<Vec2> points;
  for (const ProfileSegment& s : profile) {
    if (s.kind == ProfileSegment::Kind::line) {
      const int n = pieces((s.b - s.a).norm(), size);
      for (int i = 0; i < n; ++i)
        points.push_back(s.a + (s.b - s.a) * (double(i) / n));
      continue;
    }
    const Vec2 ca = s.a - s.centre;
    const double angle = sweep(s);
    const int n = std::max(pieces(angle * ca.norm(), size), pieces(angle, largest_turn));
    points.push_back(s.a);
    for (int i = 1; i < n; ++i)
      points.push_back(s.centre + Eigen::Rotation2Dd(s.turn * angle * i / n) * ca);
  }
  if (!is_ring(profile)) points.push_back(profile.back().b);
  return points;
}

struct Ring {
  std::int32_t first;
  bool tip; ///< one node on the axis
};

/// Joins two neighbouring rings, `a` before `b` in walking direction, normals to the left of it.
void join(const Ring& a, const Ring& b, int sectors, std::vector<Triangle>& out) {
  for (int k = 0; k < sectors; ++k) {
    const int next = (k + 1) % sectors;
    const auto at = [](const Ring& ring, int i) { return ring.tip ? ring.first : ring.first + i; };
    const std::int32_t a0 = at(a, k), a1 = at(a, next), b0 = at(b, k), b1 = at(b, next);
    if (!b.tip) out.push_back({a0, b0, b1});
    if (!a.tip) out.push_back({a0, b1, a1});
  }
}

TriMesh triangles_of(const RevolvedProfile& profile, double size, double) {
  std::vector<Vec2> points = section_points(profile.segments, size);
  double widest = 0.0;
  for (Vec2& p : points) {
    p.x() = std::max(p.x(), 0.0); // rounding of arcs that touch the axis
    widest = std::max(widest, p.x());
  }
  const int sectors = std::max(16, pieces(2.0 * std::numbers::pi * widest, size));
  TriMesh surface;
  std::vector<Ring> rings;
  for (const Vec2& p : points) {
    const bool tip = p.x() == 0.0;
    rings.push_back({static_cast<std::int32_t>(surface.x.size()), tip});
    for (int k = 0; k < (tip ? 1 : sectors); ++k) {
      const double phi = 2.0 * std::numbers::pi * k / sectors;
      surface.x.emplace_back(p.x() * std::cos(phi), p.x() * std::sin(phi), p.y());
    }
  }
  for (std::size_t i = 0; i + 1 < rings.size(); ++i)
    join(rings[i], rings[i + 1], sectors, surface.triangles);
  if (is_ring(profile.segments)) join(rings.back(), rings.front(), sectors, surface.triangles);
  return surface;
}

using Kind = ProfileSegment::Kind;

TriMesh triangles_of(const Sphere& s, double size, double extent) {
  const double r = s.radius;
  return triangles_of(RevolvedProfile{{{Kind::arc, {0.0, r}, {0.0, -r}, {0.0, 0.0}, -1}}}, size,
                      extent);
}

TriMesh triangles_of(const Cylinder& c, double size, double extent) {
  const double r = c.radius, h = 0.5 * c.length, e = edge_of(c);
  return triangles_of(make_profile({{0.0, h, 0.0}, {r, h, e}, {r, -h, e}, {0.0, -h, 0.0}}), size,
                      extent);
}

TriMesh triangles_of(const Annulus& a, double size, double extent) {
  const double ri = a.inner_radius, ro = a.outer_radius, h = a.thickness;
  const double e = std::min({a.edge_radius, 0.5 * h, ri > 0.0 ? 0.5 * (ro - ri) : ro});
  if (ri <= 0.0)
    return triangles_of(make_profile({{0.0, h, 0.0}, {ro, h, e}, {ro, 0.0, e}, {0.0, 0.0, 0.0}}),
                        size, extent);
  const double middle = 0.5 * (ri + ro); // the ring's section starts and ends between two corners
  std::vector<std::array<double, 3>> ring{{middle, h, 0.0}, {ro, h, e}, {ro, 0.0, e},
                                          {ri, 0.0, e},     {ri, h, e}, {middle, h, 0.0}};
  return triangles_of(make_profile(ring), size, extent);
}

/// Nodes on the surface of a box, numbered as those of a grid of n[0] x n[1] x n[2] cells. The
/// first and last `rounded` cells along each axis lie on the rounded edge: on 45 degrees, from the
/// flat face to the middle of the rounding, in equal steps of the angle. A sharp box has none.
struct BoxGrid {
  Vec3 flat; ///< mm, edge lengths of the box that lies inside by the edge radius
  double edge;
  int rounded;
  std::array<int, 3> n;
  std::map<std::array<int, 3>, std::int32_t> nodes{};
  TriMesh surface{};

  BoxGrid(const Box& box, double size);
  Vec3 point(const std::array<int, 3>& i) const;
  std::int32_t node(const std::array<int, 3>& i);
  void add_square(std::int32_t a, std::int32_t p, std::int32_t c, std::int32_t q);
};

BoxGrid::BoxGrid(const Box& box, double size)
    : flat(box.size - Vec3::Constant(2.0 * edge_of(box))), edge(edge_of(box)) {
  constexpr double half_quarter = std::numbers::pi / 4.0;
  rounded = edge > 0.0
                ? std::max(pieces(half_quarter * edge, size), pieces(half_quarter, largest_turn))
                : 0;
  for (std::size_t k = 0; k < 3; ++k)
    n[k] = pieces(flat[static_cast<Eigen::Index>(k)], size) + 2 * rounded;
}

Vec3 BoxGrid::point(const std::array<int, 3>& i) const {
  Vec3 share, way; // position in the flat part, from 0 to 1; direction from there to the surface
  for (std::size_t k = 0; k < 3; ++k) {
    const int cells = n[k] - 2 * rounded, at = std::clamp(i[k] - rounded, 0, cells);
    const auto axis = static_cast<Eigen::Index>(k);
    const int beyond = i[k] - rounded - at; // steps of the angle, negative at the low side
    share[axis] = double(at) / cells;
    way[axis] = beyond == 0 ? 0.0 : std::tan(std::numbers::pi / 4.0 * beyond / rounded);
  }
  const Vec3 inner = flat.cwiseProduct(share - Vec3::Constant(0.5));
  return rounded > 0 ? Vec3(inner + edge * way.normalized()) : inner;
}

std::int32_t BoxGrid::node(const std::array<int, 3>& i) {
  const auto [at, added] = nodes.try_emplace(i, static_cast<std::int32_t>(surface.x.size()));
  if (added) surface.x.push_back(point(i));
  return at->second;
}

/// Two triangles of the square a, p, c, q, whose sides are in this order. Squares on corners are
/// rhombs: halved along the shorter diagonal. Flat ones are halved from a to c, also where rounding
/// makes p q the shorter one.
void BoxGrid::add_square(std::int32_t a, std::int32_t p, std::int32_t c, std::int32_t q) {
  constexpr double clearly = 1.0 - 1e-9; // beyond rounding; the diagonals of a rhomb differ by more
  const auto length = [&](std::int32_t i, std::int32_t j) {
    return (surface.x[i] - surface.x[j]).norm();
  };
  if (length(p, q) < clearly * length(a, c)) {
    surface.triangles.push_back({a, p, q});
    surface.triangles.push_back({p, c, q});
    return;
  }
  surface.triangles.push_back({a, p, c});
  surface.triangles.push_back({a, c, q});
}

TriMesh triangles_of(const Box& b, double size, double) {
  BoxGrid grid(b, size);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (int side = 0; side < 2; ++side)
      for (int i = 0; i < grid.n[u]; ++i)
        for (int j = 0; j < grid.n[v]; ++j) {
          const auto at = [&](int di, int dj) {
            std::array<int, 3> k{};
            k[axis] = side * grid.n[axis];
            k[u] = i + di;
            k[v] = j + dj;
            return grid.node(k);
          };
          const std::int32_t a = at(0, 0), c = at(1, 1);
          // At the low side u and v are swapped, so that the normal points outwards.
          const std::int32_t p = side == 1 ? at(1, 0) : at(0, 1);
          const std::int32_t q = side == 1 ? at(0, 1) : at(1, 0);
          grid.add_square(a, p, c, q);
        }
  }
  return std::move(grid.surface);
}

TriMesh triangles_of(const Plane&, double size, double extent) {
  const int n = pieces(2.0 * extent, size);
  const auto at = [n](int i, int j) { return static_cast<std::int32_t>(j * (n + 1) + i); };
  TriMesh surface;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      surface.x.emplace_back(extent * (2.0 * i / n - 1.0), extent * (2.0 * j / n - 1.0), 0.0);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      surface.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      surface.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return surface;
}

/// Rows of points along y; a solid has ends.
TriMesh triangles_of(const ExtrudedProfile& profile, double size, double) {
  const std::vector<Vec2> points = section_points(profile.segments, size);
  const bool ring = is_ring(profile.segments);
  const int n = pieces(profile.length, size), count = static_cast<int>(points.size());
  TriMesh surface;
  for (int j = 0; j <= n; ++j)
    for (const Vec2& p : points)
      surface.x.emplace_back(p.x(), profile.length * (double(j) / n - 0.5), p.y());
  for (int j = 0; j < n; ++j)
    for (int i = 0; i + (ring ? 0 : 1) < count; ++i) {
      const std::int32_t a = j * count + i, b = j * count + (i + 1) % count;
      surface.triangles.push_back({a, b, b + count});
      surface.triangles.push_back({a, b + count, a + count});
    }
  if (!ring || area_of(points) > 0.0) return surface;  // no solid, or one all round it
  for (const auto& [a, b, c] : fill_polygon(points)) { // anticlockwise: towards -y
    surface.triangles.push_back({a, b, c});
    surface.triangles.push_back({a + n * count, c + n * count, b + n * count});
  }
  return surface;
}

TriMesh triangles_of(const MeshShapePtr& mesh, double, double) {
  return mesh->surface();
}

} // namespace

TriMesh tessellate(const ToolShape& shape, double size, double extent) {
  if (!(size > 0.0))
    throw std::invalid_argument(
        fmt::format("the triangle size of a tool must be above 0 mm, got {:g}", size));
  return std::visit([&](const auto& s) { return triangles_of(s, size, extent); }, shape);
}

Box3 box_of(const ToolShape& shape, double extent) {
  const auto around = [](const TriMesh& surface) {
    Box3 box;
    for (const Vec3& x : surface.x)
      box.extend(x);
    return box;
  };
  if (const auto* mesh = std::get_if<MeshShapePtr>(&shape)) return around((*mesh)->surface());
  return around(tessellate(shape, std::numeric_limits<double>::infinity(), extent));
}

double diagonal_of(const ToolShape& shape, double extent) {
  const Box3 box = box_of(shape, extent);
  return box.isEmpty() ? 0.0 : box.diagonal().norm();
}

} // namespace plyform
