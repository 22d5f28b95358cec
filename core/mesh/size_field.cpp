// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/size_field.hpp"

#include "base/format.hpp"
#include "contact/shapes/fill_polygon.hpp"
#include "core/mesh/mesher_parts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace plyform {
namespace {

using Corners = std::array<Vec2, 3>;

/// What is smaller than this part of a triangle or zone is rounding: zones often end where
/// triangles do.
constexpr double rounding = 1e-9;

double twice_area_of(const Corners& t) {
  return cross(t[1] - t[0], t[2] - t[0]);
}

bool is_inside(const Corners& t, const Vec2& p) {
  for (std::size_t k = 0; k < 3; ++k)
    if (cross(t[(k + 1) % 3] - t[k], p - t[k]) < 0.0) return false;
  return true;
}

/// Distance (mm) of p from a triangle, 0 inside.
double distance_to(const Corners& t, const Vec2& p) {
  if (is_inside(t, p)) return 0.0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec2 side = t[(k + 1) % 3] - t[k];
    const double s = std::clamp(side.dot(p - t[k]) / side.squaredNorm(), 0.0, 1.0);
    least = std::min(least, (p - t[k] - s * side).squaredNorm());
  }
  return std::sqrt(least);
}

double twice_area_of(const std::vector<Vec2>& loop) {
  double twice = 0.0;
  for (std::size_t k = 2; k < loop.size(); ++k)
    twice += cross(loop[k - 1] - loop[0], loop[k] - loop[0]);
  return std::abs(twice);
}

/// The part of a polygon to the left of the line from a to b (Sutherland and Hodgman). Parts of one
/// that is not convex may stay joined by sides without area.
std::vector<Vec2> left_of(const std::vector<Vec2>& loop, const Vec2& a, const Vec2& b) {
  std::vector<Vec2> kept;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Vec2 &p = loop[k], &q = loop[(k + 1) % loop.size()];
    const double dp = cross(b - a, p - a), dq = cross(b - a, q - a);
    if (dp >= 0.0) kept.push_back(p);
    if ((dp < 0.0) != (dq < 0.0)) kept.push_back(p + (q - p) * (dp / (dp - dq)));
  }
  return kept;
}

bool overlaps_polygon(const std::vector<Vec2>& loop, const Corners& t) {
  std::vector<Vec2> part = loop;
  for (std::size_t k = 0; k < 3 && !part.empty(); ++k)
    part = left_of(part, t[k], t[(k + 1) % 3]);
  return twice_area_of(part) > rounding * std::min(twice_area_of(loop), twice_area_of(t));
}

bool overlaps_circle(const MeshZone& zone, const Corners& t) {
  if (!(distance_to(t, zone.centre) < zone.radius * (1.0 - rounding))) return false;
  return std::any_of(t.begin(), t.end(), [&](const Vec2& p) {
    return (p - zone.centre).norm() > zone.inner_radius * (1.0 + rounding);
  });
}

std::int64_t cell_of(double x, double side) {
  return static_cast<std::int64_t>(std::floor(x / side));
}

/// Whether hit(place) holds for a place in or beside the box.
template <class Hit>
bool any_place(const FieldZone& field, const Eigen::AlignedBox2d& box, const Hit& hit) {
  const double side = field.most_reach;
  const auto low = [&](int k) { return cell_of(box.min()[k], side) - 1; };
  const auto high = [&](int k) { return cell_of(box.max()[k], side) + 1; };
  for (std::int64_t i = low(0); i <= high(0); ++i)
    for (auto cell = field.cells.lower_bound({i, low(1)});
         cell != field.cells.end() && cell->first <= std::pair(i, high(1)); ++cell)
      for (const std::size_t place : cell->second)
        if (hit(field.zone.places[place])) return true;
  return false;
}

bool overlaps(const FieldZone& field, const Corners& t, const Eigen::AlignedBox2d& box) {
  if (!field.box.intersects(box)) return false;
  switch (field.zone.kind) {
  case ZoneKind::circle:
    return overlaps_circle(field.zone, t);
  case ZoneKind::polygon:
    return overlaps_polygon(field.zone.outline, t);
  case ZoneKind::tool:
    break;
  }
  const Eigen::AlignedBox2d common = field.box.intersection(box);
  return any_place(field, common,
                   [&](const ToolPlace& place) { return distance_to(t, place.at) < place.reach; });
}

bool holds(const FieldZone& field, const Vec2& p) {
  if (!field.box.contains(p)) return false;
  const MeshZone& zone = field.zone;
  if (zone.kind == ZoneKind::circle) {
    const double r = (p - zone.centre).norm();
    return r < zone.radius && r >= zone.inner_radius;
  }
  if (zone.kind == ZoneKind::tool)
    return any_place(field, {p, p},
                     [&](const ToolPlace& place) { return (p - place.at).norm() < place.reach; });
  bool odd = false; // sides to the right of p
  const std::vector<Vec2>& loop = zone.outline;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Vec2 a = loop[k] - p, b = loop[(k + 1) % loop.size()] - p;
    if ((a.y() > 0.0) != (b.y() > 0.0) && (cross(a, b) > 0.0) == (b.y() > a.y())) odd = !odd;
  }
  return odd;
}

FieldZone make_field_zone(const MeshZone& zone) {
  FieldZone field{zone, {}, 0.0, {}};
  if (zone.kind == ZoneKind::circle)
    for (const double sign : {-1.0, 1.0})
      field.box.extend(Vec2(zone.centre + Vec2::Constant(sign * zone.radius)));
  for (const Vec2& p : zone.outline)
    field.box.extend(p);
  for (const ToolPlace& place : zone.places)
    field.most_reach = std::max(field.most_reach, place.reach);
  for (std::size_t k = 0; k < zone.places.size(); ++k) {
    const ToolPlace& place = zone.places[k];
    for (const double sign : {-1.0, 1.0})
      field.box.extend(Vec2(place.at + Vec2::Constant(sign * place.reach)));
    field.cells[{cell_of(place.at.x(), field.most_reach), cell_of(place.at.y(), field.most_reach)}]
        .push_back(k);
  }
  return field;
}

void check_grid(const SizeGrid& grid) {
  if (grid.columns < 1 || grid.rows < 1 || !(grid.spacing > 0.0) ||
      grid.size.size() != at(grid.columns) * at(grid.rows))
    throw std::invalid_argument(
        fmt::format("grid of element sizes: {} x {} points {:g} mm apart with {} sizes",
                    grid.columns, grid.rows, grid.spacing, grid.size.size()));
  for (const double size : grid.size)
    if (!(size > 0.0 && std::isfinite(size)))
      throw std::invalid_argument(
          fmt::format("grid of element sizes: {:g} mm must be above 0", size));
}

/// A point in columns and rows of the grid, moved onto its rim from beyond.
Vec2 on_grid(const SizeGrid& grid, const Vec2& p) {
  return ((p - grid.origin) / grid.spacing)
      .cwiseMax(Vec2::Zero())
      .cwiseMin(Vec2(grid.columns - 1, grid.rows - 1));
}

double grid_point(const SizeGrid& grid, int column, int row) {
  return grid.size[grid.index(column, row)];
}

double grid_size(const SizeGrid& grid, const Vec2& p) {
  const Vec2 uv = on_grid(grid, p);
  const int i = std::min(static_cast<int>(uv.x()), std::max(grid.columns - 2, 0)),
            j = std::min(static_cast<int>(uv.y()), std::max(grid.rows - 2, 0));
  const int right = std::min(i + 1, grid.columns - 1), above = std::min(j + 1, grid.rows - 1);
  const double u = uv.x() - i, v = uv.y() - j;
  return (1.0 - v) * ((1.0 - u) * grid_point(grid, i, j) + u * grid_point(grid, right, j)) +
         v * ((1.0 - u) * grid_point(grid, i, above) + u * grid_point(grid, right, above));
}

double least_of_grid(const SizeGrid& grid, const Corners& t, const Eigen::AlignedBox2d& box) {
  double least = grid_size(grid, (t[0] + t[1] + t[2]) / 3.0);
  for (std::size_t k = 0; k < 3; ++k)
    least =
        std::min({least, grid_size(grid, t[k]), grid_size(grid, 0.5 * (t[k] + t[(k + 1) % 3]))});
  const Vec2 low = on_grid(grid, box.min()), high = on_grid(grid, box.max());
  for (int j = static_cast<int>(std::ceil(low.y())); j <= high.y(); ++j)
    for (int i = static_cast<int>(std::ceil(low.x())); i <= high.x(); ++i)
      if (is_inside(t, grid.origin + grid.spacing * Vec2(i, j)))
        least = std::min(least, grid_point(grid, i, j));
  return least;
}

} // namespace

SizeField make_size_field(const BlankSpec& spec) {
  SizeField field;
  field.largest =
      spec.element_size > 0.0 ? spec.element_size : std::numeric_limits<double>::infinity();
  for (const MeshZone& zone : spec.zones)
    field.zones.push_back(make_field_zone(zone));
  std::stable_sort(field.zones.begin(), field.zones.end(),
                   [](const FieldZone& a, const FieldZone& b) {
                     return a.zone.element_size < b.zone.element_size;
                   });
  if (spec.sizes) check_grid(*spec.sizes);
  field.grid = spec.sizes;
  return field;
}

double wanted_size(const SizeField& field, const Vec2& p) {
  double size = field.grid ? std::min(field.largest, grid_size(*field.grid, p)) : field.largest;
  for (const FieldZone& zone : field.zones) {
    if (zone.zone.element_size >= size) break;
    if (holds(zone, p)) return zone.zone.element_size;
  }
  return size;
}

double least_wanted(const SizeField& field, const std::array<Vec2, 3>& triangle) {
  Eigen::AlignedBox2d box;
  for (const Vec2& p : triangle)
    box.extend(p);
  const double size = field.grid
                          ? std::min(field.largest, least_of_grid(*field.grid, triangle, box))
                          : field.largest;
  for (const FieldZone& zone : field.zones) {
    if (zone.zone.element_size >= size) break;
    if (overlaps(zone, triangle, box)) return zone.zone.element_size;
  }
  return size;
}

bool lies_on(const MeshZone& zone, const Outline& outline) {
  const FieldZone field = make_field_zone(zone);
  const std::vector<Vec2> corners = points_of(outline, coarsest_turn);
  const std::vector<Triangle> triangles = fill_polygon(corners);
  return std::any_of(triangles.begin(), triangles.end(), [&](const Triangle& t) {
    const Corners x{corners[at(t[0])], corners[at(t[1])], corners[at(t[2])]};
    Eigen::AlignedBox2d box;
    for (const Vec2& p : x)
      box.extend(p);
    return overlaps(field, x, box);
  });
}

double area_of(const FieldZone& field) {
  const MeshZone& zone = field.zone;
  if (zone.kind == ZoneKind::circle)
    return std::numbers::pi * (zone.radius * zone.radius - zone.inner_radius * zone.inner_radius);
  if (zone.kind == ZoneKind::polygon) return 0.5 * twice_area_of(zone.outline);
  // cells reach into their neighbours, but are often not full
  return 2.0 * static_cast<double>(field.cells.size()) * field.most_reach * field.most_reach;
}

} // namespace plyform
