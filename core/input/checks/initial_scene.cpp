// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/input/checks/initial_scene.hpp"

#include <algorithm>
#include <map>
#include <tuple>

namespace plyform {

FlatPly make_flat_ply(BlankMesh mesh, double z, double thickness) {
  FlatPly ply{std::move(mesh), {}, {}, z, 0.5 * thickness};
  std::map<std::pair<int, int>, int> uses;
  for (const Triangle& t : ply.mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i)
      ++uses[std::minmax(t[i], t[(i + 1) % 3])];
  for (const auto& [edge, count] : uses)
    if (count == 1) ply.border.emplace_back(ply.mesh.x[edge.first], ply.mesh.x[edge.second]);
  for (const Vec2& x : ply.mesh.x)
    ply.bounds.extend(x);
  return ply;
}

bool covers(const FlatPly& ply, const Vec2& p) {
  if (!ply.bounds.contains(p)) return false;
  bool inside = false;
  for (const auto& [a, b] : ply.border) {
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    const double x = a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
    if (x > p.x()) inside = !inside;
  }
  return inside;
}

bool bounded_tool(const Tool& tool) {
  return !std::holds_alternative<Plane>(tool.shape);
}

double touch_depth(std::span<const FlatPly> plies) {
  constexpr double share = 1e-3; // of a thickness
  double least = std::numeric_limits<double>::infinity();
  for (const FlatPly& ply : plies)
    least = std::min(least, 2.0 * share * ply.half);
  return least;
}

double tool_distance(const Tool& tool, const Vec3& shift, const Vec3& p, SurfaceHint& hint) {
  const Vec3 local = tool.rotation.transpose() * (p - shift - tool.position);
  return signed_distance(tool.shape, local, hint).distance;
}

TriMesh tool_surface(const Tool& tool, double size, double extent) {
  const double diagonal = diagonal_of(tool.shape, extent);
  if (!(diagonal > 0.0)) return {};
  const double side = std::clamp(size, diagonal / 300.0, diagonal / 60.0);
  TriMesh surface = tessellate(tool.shape, side, extent);
  if (std::holds_alternative<MeshShapePtr>(tool.shape)) divide_sides(surface, side);
  for (Vec3& x : surface.x)
    x = tool.position + tool.rotation * x;
  return surface;
}

std::vector<FaceSide> sides_by_edge(const std::vector<Triangle>& faces) {
  std::vector<FaceSide> sides;
  sides.reserve(3 * faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [first, second] = std::minmax(faces[f][k], faces[f][(k + 1) % 3]);
      sides.push_back({first, second, f});
    }
  std::sort(sides.begin(), sides.end(), [](const FaceSide& a, const FaceSide& b) {
    return std::tie(a.first, a.second, a.face) < std::tie(b.first, b.second, b.face);
  });
  return sides;
}

void visit_slab(const TriMesh& surface, double low, double high,
                const std::function<void(const Vec3&)>& visit) {
  for (const Triangle& t : surface.triangles) {
    std::array<Vec3, 3> x;
    for (std::size_t i = 0; i < 3; ++i)
      x[i] = surface.x[t[i]];
    const auto [least, most] = std::minmax({x[0].z(), x[1].z(), x[2].z()});
    if (most < low || least > high) continue;
    const Vec3 middle = (x[0] + x[1] + x[2]) / 3.0;
    if (middle.z() >= low && middle.z() <= high) visit(middle);
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 &a = x[i], d = x[(i + 1) % 3] - a;
      double from = 0.0, to = 1.0;
      if (d.z() != 0.0) {
        const double s = (low - a.z()) / d.z(), e = (high - a.z()) / d.z();
        from = std::max(from, std::min(s, e));
        to = std::min(to, std::max(s, e));
      } else if (a.z() < low || a.z() > high) {
        continue;
      }
      if (from > to) continue;
      for (const double s : {from, 0.5 * (from + to), to})
        visit(a + s * d);
    }
  }
}

std::vector<std::pair<double, double>> occupied(const Tool& tool, const Vec2& xy, double low,
                                                double high) {
  constexpr double shortest_step = 1e-3; // mm; thinner parts of a tool may be missed
  SurfaceHint hint;
  const auto distance = [&](double z) {
    return tool_distance(tool, Vec3::Zero(), Vec3(xy.x(), xy.y(), z), hint);
  };
  // Bisection for the change of sign between a and b, to 2^-30 of their distance.
  const auto crossing = [&](double a, double b, bool inside_at_a) {
    for (int i = 0; i < 30; ++i) {
      const double middle = 0.5 * (a + b);
      ((distance(middle) <= 0.0) == inside_at_a ? a : b) = middle;
    }
    return 0.5 * (a + b);
  };
  std::vector<std::pair<double, double>> parts;
  double z = low, d = distance(z), start = low;
  bool inside = d <= 0.0;
  while (z < high) { // sphere tracing: the surface is at least |d| away
    const double next = std::min(high, z + std::max(std::abs(d), shortest_step));
    d = distance(next);
    if ((d <= 0.0) != inside) {
      const double z0 = crossing(z, next, inside);
      if (inside) parts.emplace_back(start, z0);
      start = z0;
      inside = !inside;
    }
    z = next;
  }
  if (inside) parts.emplace_back(start, high);
  return parts;
}

} // namespace plyform
