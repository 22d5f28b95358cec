// SPDX-License-Identifier: GPL-3.0-or-later
// Exact grids on rectangles (and parallelograms) with sides parallel to those of the cells.
#include "core/mesh/mesher_parts.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace plyform {
namespace {

/// rad: tolerance of parallel sides, for coordinates given to nine digits.
constexpr double parallel = 1e-8;

bool along(const Vec2& side, const Vec2& direction) {
  return std::abs(cross(side, direction)) <= parallel * side.norm();
}

/// A corner and the sides `u` and `v` that start there; the anticlockwise angle from u to v is at
/// most 90 degrees.
struct Parallelogram {
  Vec2 corner, u, v;
};

/// The outline as a parallelogram along the cells, if it is one. Among the corners that qualify the
/// one whose u points most towards +x is taken, so that a rectangle has the same grid whichever of
/// its points comes first and whichever fibre family is the warp.
std::optional<Parallelogram> as_parallelogram(const Outline& outline,
                                              const CellDirections& directions) {
  const std::vector<Vec2>& p = outline.boundary;
  if (p.size() != 4 || !outline.holes.empty() || !outline.arcs.empty()) return std::nullopt;
  const bool clockwise = cross(p[1] - p[0], p[2] - p[1]) < 0;
  std::optional<Parallelogram> best;
  for (std::size_t k = 0; k < 4; ++k) {
    Parallelogram s{p[k], p[(k + 1) % 4] - p[k], p[(k + 3) % 4] - p[k]};
    if (clockwise) std::swap(s.u, s.v);
    const double size = s.u.norm() + s.v.norm();
    const bool closes = (s.corner + s.u + s.v - p[(k + 2) % 4]).norm() <= parallel * size;
    const bool sharp = s.u.normalized().dot(s.v.normalized()) >= -2 * parallel;
    const bool on_cells = (along(s.u, directions.a) && along(s.v, directions.b)) ||
                          (along(s.u, directions.b) && along(s.v, directions.a));
    if (closes && sharp && on_cells &&
        (!best || s.u.normalized().x() > best->u.normalized().x() + parallel))
      best = s;
  }
  return best;
}

int cells_along(double side, double element_size) {
  return std::max(1, static_cast<int>(std::lround(side / element_size)));
}

} // namespace

void append_cell(const std::array<std::int32_t, 4>& cell, std::int32_t centre, MeshKind mesh,
                 bool other_diagonal, std::vector<Triangle>& triangles) {
  const auto [p00, p10, p11, p01] = cell;
  if (mesh == MeshKind::crossed)
    for (std::size_t k = 0; k < 4; ++k)
      triangles.push_back({cell[k], cell[(k + 1) % 4], centre});
  else if (other_diagonal) {
    triangles.push_back({p00, p10, p01});
    triangles.push_back({p10, p11, p01});
  } else {
    triangles.push_back({p00, p10, p11});
    triangles.push_back({p00, p11, p01});
  }
}

std::optional<BlankMesh> structured_blank(const BlankSpec& spec, const CellDirections& directions) {
  const auto shape = as_parallelogram(spec.outline, directions);
  if (!shape) return std::nullopt;
  const int nu = cells_along(shape->u.norm(), spec.element_size);
  const int nv = cells_along(shape->v.norm(), spec.element_size);
  const bool skew = is_skew(directions);

  BlankMesh mesh;
  const auto place = [&](double i, double j) {
    return Vec2(shape->corner + shape->u * (i / nu) + shape->v * (j / nv));
  };
  for (int j = 0; j <= nv; ++j)
    for (int i = 0; i <= nu; ++i)
      mesh.x.push_back(place(i, j));
  for (int j = 0; j < nv; ++j)
    for (int i = 0; i < nu; ++i) {
      const int p00 = j * (nu + 1) + i, p01 = p00 + nu + 1;
      append_cell({p00, p00 + 1, p01 + 1, p01}, static_cast<std::int32_t>(mesh.x.size()), spec.mesh,
                  skew != (spec.mesh == MeshKind::alternating && (i + j) % 2 == 1), mesh.triangles);
      if (spec.mesh == MeshKind::crossed) mesh.x.push_back(place(i + 0.5, j + 0.5));
    }
  return mesh;
}

} // namespace plyform
