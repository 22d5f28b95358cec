// SPDX-License-Identifier: GPL-3.0-or-later
// Triangles of a tool, for pictures and the exact audit. Nodes lie on the surface, so curved parts
// are inscribed: a chord of length l on a circle of radius R misses it by l^2/(8 R).
#include "contact/mesh_shape.hpp"
#include "contact/profile.hpp"

#include <cmath>
#include <fmt/format.h>
#include <map>
#include <numbers>
#include <stdexcept>

namespace plyform {
namespace {

// Small fillets keep their shape however coarse the rest is: 22.5 degrees a piece at most.
constexpr double largest_turn = std::numbers::pi / 8.0;

int pieces(double length, double size) {
  return std::max(1, static_cast<int>(std::ceil(length / size - 1e-9)));
}

/// The profile as points (r, z) about `size` apart; a ring does not repeat its first point.
std::vector<Vec2> section_points(const RevolvedProfile& profile, double size) {
  std::vector<Vec2> points;
  for (const ProfileSegment& s : profile.segments) {
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
  if (!is_ring(profile)) points.push_back(profile.segments.back().b);
  for (Vec2& p : points)
    p.x() = std::max(p.x(), 0.0); // rounding of arcs that touch the axis
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

Surface triangles_of(const RevolvedProfile& profile, double size, double) {
  const std::vector<Vec2> points = section_points(profile, size);
  double widest = 0.0;
  for (const Vec2& p : points)
    widest = std::max(widest, p.x());
  const int sectors = std::max(16, pieces(2.0 * std::numbers::pi * widest, size));
  Surface surface;
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
  if (is_ring(profile)) join(rings.back(), rings.front(), sectors, surface.triangles);
  return surface;
}

using Kind = ProfileSegment::Kind;

Surface triangles_of(const Sphere& s, double size, double extent) {
  const double r = s.radius;
  return triangles_of(RevolvedProfile{{{Kind::arc, {0.0, r}, {0.0, -r}, {0.0, 0.0}, -1}}}, size,
                      extent);
}

Surface triangles_of(const Cylinder& c, double size, double extent) {
  const double r = c.radius, h = 0.5 * c.length;
  return triangles_of(make_profile({{0.0, h, 0.0}, {r, h, 0.0}, {r, -h, 0.0}, {0.0, -h, 0.0}}),
                      size, extent);
}

Surface triangles_of(const Annulus& a, double size, double extent) {
  const double ri = a.inner_radius, ro = a.outer_radius, h = a.thickness;
  const double e = std::min({a.edge_radius, 0.5 * h, ri > 0.0 ? 0.5 * (ro - ri) : ro});
  if (ri <= 0.0)
    return triangles_of(make_profile({{0.0, h, 0.0}, {ro, h, e}, {ro, 0.0, e}, {0.0, 0.0, 0.0}}),
                        size, extent);
  const double middle = 0.5 * (ri + ro); // the ring starts and ends between two corners
  std::vector<std::array<double, 3>> ring{{middle, h, 0.0}, {ro, h, e}, {ro, 0.0, e},
                                          {ri, 0.0, e},     {ri, h, e}, {middle, h, 0.0}};
  return triangles_of(make_profile(ring), size, extent);
}

/// Grid of n[0] x n[1] x n[2] cells on the surface of a box, each square halved.
Surface triangles_of(const Box& b, double size, double) {
  const std::array<int, 3> n{pieces(b.size.x(), size), pieces(b.size.y(), size),
                             pieces(b.size.z(), size)};
  Surface surface;
  std::map<std::array<int, 3>, std::int32_t> nodes;
  const auto node = [&](const std::array<int, 3>& i) {
    const auto [at, added] = nodes.try_emplace(i, static_cast<std::int32_t>(surface.x.size()));
    if (added)
      surface.x.push_back(
          b.size.cwiseProduct(Vec3(double(i[0]) / n[0], double(i[1]) / n[1], double(i[2]) / n[2]) -
                              Vec3::Constant(0.5)));
    return at->second;
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (int side = 0; side < 2; ++side)
      for (int i = 0; i < n[u]; ++i)
        for (int j = 0; j < n[v]; ++j) {
          const auto at = [&](int di, int dj) {
            std::array<int, 3> k{};
            k[axis] = side * n[axis];
            k[u] = i + di;
            k[v] = j + dj;
            return node(k);
          };
          const std::int32_t a = at(0, 0), c = at(1, 1);
          // At the low side u and v change places, so that the normal points outwards.
          const std::int32_t p = side == 1 ? at(1, 0) : at(0, 1);
          const std::int32_t q = side == 1 ? at(0, 1) : at(1, 0);
          surface.triangles.push_back({a, p, c});
          surface.triangles.push_back({a, c, q});
        }
  }
  return surface;
}

Surface triangles_of(const Plane&, double size, double extent) {
  const int n = pieces(2.0 * extent, size);
  const auto at = [n](int i, int j) { return static_cast<std::int32_t>(j * (n + 1) + i); };
  Surface surface;
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

Surface triangles_of(const MeshShapePtr& mesh, double, double) {
  return mesh->surface();
}

} // namespace

Surface tessellate(const ToolShape& shape, double size, double extent) {
  if (!(size > 0.0))
    throw std::invalid_argument(
        fmt::format("the triangle size of a tool must be above 0 mm, got {:g}", size));
  return std::visit([&](const auto& s) { return triangles_of(s, size, extent); }, shape);
}

} // namespace plyform
