// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes whose elements are as small as zones and grid of their blank ask for.
//
// The size of a triangle of area A is that of the uniform mesh of its kind with such triangles:
// sqrt(2 A) where a square has two, sqrt(4 A) where it has four. A bisection divides it by
// 2^(1/2), so that it ends between 2^(-1/4) and 2^(1/4) times what is wanted.
#include "base/format.hpp"
#include "core/mesh/bisection.hpp"
#include "core/mesh/mesher_parts.hpp"
#include "core/mesh/size_field.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace plyform {
namespace {

/// 2^(1/4), and a little more, so that sizes equal to it up to rounding are not bisected.
const double most_over_wanted = std::sqrt(std::numbers::sqrt2) * (1.0 + 1e-6);
/// Bisections of a triangle at most: elements 4096 times as small as those around.
constexpr int most_generations = 24;

std::array<Vec2, 3> places_of(const BlankMesh& mesh, const Triangle& t) {
  return {mesh.x[at(t[0])], mesh.x[at(t[1])], mesh.x[at(t[2])]};
}

/// The sides of the rim that stand for pieces of arcs, with the centres of these. Pieces that the
/// mesher has split stay straight.
std::map<SideNodes, Vec2> arcs_on_rim(const BlankMesh& mesh, const BlankSpec& spec) {
  std::map<SideNodes, Vec2> centres;
  if (spec.mesh == MeshKind::file || spec.outline.arcs.empty()) return centres;
  std::map<std::pair<double, double>, std::int32_t> numbers;
  for (std::size_t n = 0; n < mesh.x.size(); ++n)
    numbers.emplace(std::pair(mesh.x[n].x(), mesh.x[n].y()), static_cast<std::int32_t>(n));
  for (int k = -1; k < static_cast<int>(spec.outline.holes.size()); ++k)
    for (SampledSide& side : sample_sides(spec.outline, k, spec.element_size, coarsest_turn)) {
      if (!side.arc) continue;
      side.points.push_back(side.end);
      for (std::size_t i = 0; i + 1 < side.points.size(); ++i) {
        const auto number = [&](std::size_t point) {
          return numbers.at({side.points[point].x(), side.points[point].y()});
        };
        centres.emplace(std::minmax(number(i), number(i + 1)), side.arc->centre);
      }
    }
  return centres;
}

[[noreturn]] void refuse(const BlankMesh& mesh, const Triangle& t, double wanted,
                         const std::string& rule) {
  const std::array<Vec2, 3> x = places_of(mesh, t);
  const Vec2 middle = (x[0] + x[1] + x[2]) / 3.0;
  throw std::runtime_error(
      fmt::format("zones of the mesh: elements of {:.4g} mm, as wanted near ({:.6g}, {:.6g}), "
                  "{}; give the zone larger elements, or make it smaller",
                  wanted, middle.x(), middle.y(), rule));
}

/// Marks the triangles of `todo` that are larger than wanted.
std::vector<char> too_large(const Bisection& b, const SizeField& field, double area_factor,
                            const std::vector<char>& todo) {
  std::vector<char> marked(todo.size(), 0);
  for (std::size_t e = 0; e < todo.size(); ++e) {
    if (!todo[e]) continue;
    const Triangle& t = b.mesh.triangles[e];
    const std::array<Vec2, 3> x = places_of(b.mesh, t);
    const double wanted = least_wanted(field, x);
    if (!(wanted < field.largest)) continue; // triangles of the uniform mesh differ
    const double area = 0.5 * cross(x[1] - x[0], x[2] - x[0]);
    if (!(std::sqrt(area_factor * area) > most_over_wanted * wanted)) continue;
    if (b.generation[e] >= most_generations)
      refuse(b.mesh, t, wanted,
             fmt::format("are more than {} times smaller than those around",
                         1 << (most_generations / 2)));
    if (static_cast<double>(b.mesh.triangles.size()) > most_triangles)
      refuse(b.mesh, t, wanted, fmt::format("make more than {:.0e} triangles", most_triangles));
    marked[e] = 1;
  }
  return marked;
}

/// How often a triangle of the uniform mesh is bisected to be as small as wanted.
int generations_for(double element_size, double wanted) {
  const double ratio = element_size / (most_over_wanted * wanted);
  return ratio > 1.0 ? static_cast<int>(std::ceil(2.0 * std::log2(ratio))) : 0;
}

/// Triangles per mm^2 where so much is wanted.
double density_of(const BlankSpec& spec, double wanted) {
  const double squares = 1.0 / (spec.element_size * spec.element_size);
  if (spec.mesh == MeshKind::free) return 2.0 / (wanted * wanted);
  return (spec.mesh == MeshKind::crossed ? 4.0 : 2.0) * squares *
         std::pow(2.0, generations_for(spec.element_size, wanted));
}

} // namespace

double smallest_wanted(const BlankSpec& spec) {
  double size = spec.element_size;
  for (const MeshZone& zone : spec.zones)
    size = std::min(size, zone.element_size);
  if (spec.sizes)
    for (const double wanted : spec.sizes->size)
      size = std::min(size, wanted);
  return size;
}

double expected_triangles(const BlankSpec& spec) {
  if (spec.mesh == MeshKind::file || !(spec.element_size > 0.0)) return 0.0;
  const double area = std::max(area_of(spec.outline), 0.0);
  const double own = density_of(spec, spec.element_size);
  if (!is_graded(spec)) return area * own;
  SizeField field = make_size_field(spec);
  double triangles = 0.0;
  for (const FieldZone& zone : field.zones) // those that overlap count twice
    triangles += std::min(area_of(zone), area) * density_of(spec, zone.zone.element_size);
  if (!field.grid) return triangles + area * own;
  field.zones.clear();
  Eigen::AlignedBox2d box;
  for (const Vec2& p : spec.outline.boundary)
    box.extend(p);
  constexpr int points = 100; // along each side of the box, for the mean of the grid
  double sum = 0.0;
  for (int j = 0; j < points; ++j)
    for (int i = 0; i < points; ++i) {
      const Vec2 share((i + 0.5) / points, (j + 0.5) / points);
      sum += density_of(spec, wanted_size(field, box.min() + box.sizes().cwiseProduct(share)));
    }
  return triangles + area * sum / (points * points);
}

void check_zones(const BlankSpec& spec) {
  if (!is_graded(spec) || spec.mesh == MeshKind::file) return;
  const double smallest = smallest_wanted(spec);
  if (generations_for(spec.element_size, smallest) > most_generations)
    throw std::runtime_error(fmt::format(
        "zones of the mesh: elements of {:.4g} mm are more than {} times smaller than element_size "
        "{:.4g} mm; give the zone larger elements, or the blank smaller ones",
        smallest, 1 << (most_generations / 2), spec.element_size));
  const double triangles = expected_triangles(spec);
  if (triangles > most_triangles)
    throw std::runtime_error(fmt::format(
        "zones of the mesh: elements down to {:.4g} mm would give {:.1e} triangles, more than "
        "{:.0e}; give the zones larger elements, or make them smaller",
        smallest, triangles, most_triangles));
}

BlankMesh graded(BlankMesh mesh, const BlankSpec& spec) {
  const SizeField field = make_size_field(spec);
  const double area_factor = spec.mesh == MeshKind::crossed ? 4.0 : 2.0;
  Bisection b = start_bisection(std::move(mesh));
  b.arc_centre = arcs_on_rim(b.mesh, spec);
  std::vector<char> todo(b.mesh.triangles.size(), 1);
  for (;;) {
    const std::vector<char> marked = too_large(b, field, area_factor, todo);
    if (std::none_of(marked.begin(), marked.end(), [](char m) { return m != 0; }))
      return std::move(b.mesh);
    todo = bisect(b, marked);
  }
}

} // namespace plyform
