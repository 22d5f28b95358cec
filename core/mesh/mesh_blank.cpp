// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/mesh_blank.hpp"

#include "core/mesh/mesher_parts.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <stdexcept>

namespace plyform {
CellDirections cell_directions(MeshKind mesh, double warp, double weft) {
  if (mesh != MeshKind::fibres) return {};
  Vec2 a(std::cos(warp), std::sin(warp)), b(std::cos(weft), std::sin(weft));
  if (cross(a, b) < 0) b = -b;
  if (a.dot(b) < 0) {
    const Vec2 turned = -a;
    a = b;
    b = turned;
  }
  // Degrees. The band is refined until its angles are at least 20 degrees; cells with an angle near
  // that would all be split and removed (measured: none is from 22 degrees on).
  constexpr double least = 25.0;
  const double angle = std::asin(std::min(1.0, cross(a, b))) * 180 / std::numbers::pi;
  if (!(angle >= least))
    throw std::runtime_error(fmt::format(
        "blank mesh \"fibres\": warp and weft are only {:.3g} degrees apart, at least {:.3g} are "
        "needed for cells with sides along both; choose mesh = \"free\"",
        angle, least));
  return {a, b};
}

BlankMesh free_blank(const BlankSpec& spec) {
  // The mesher bounds the longest edge; measured on squares, circles and pierced polygons, 1.42 h
  // gives a mean edge within 2 % of h.
  constexpr double longest = 1.42;
  constexpr double min_angle = 20.5; // degrees; up to 20.7 the termination of the mesher is proven
  return refine(sample_outline(spec.outline, spec.element_size), min_angle * std::numbers::pi / 180,
                longest * spec.element_size);
}

bool takes_elements(const BlankSpec& spec) {
  try {
    check_outline(spec.outline, spec.element_size);
    return true;
  } catch (const std::runtime_error&) {
    return false;
  }
}

BlankMesh mesh_blank(const BlankSpec& spec, double warp, double weft) {
  if (spec.mesh == MeshKind::file) return blank_from_file(spec.file);
  check_outline(spec.outline, spec.element_size);
  if (spec.mesh == MeshKind::free) return free_blank(spec);
  const CellDirections directions = cell_directions(spec.mesh, warp, weft);
  if (auto grid = structured_blank(spec, directions)) return *std::move(grid);
  return cut_blank(spec, directions);
}

} // namespace plyform
