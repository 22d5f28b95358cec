// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/mesh_blank.hpp"

#include "base/format.hpp"
#include "core/mesh/mesher_parts.hpp"
#include "core/mesh/size_field.hpp"

#include <algorithm>
#include <cmath>
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
  const double angle = std::asin(std::min(1.0, cross(a, b))) / degree;
  if (!(angle >= least))
    throw std::runtime_error(fmt::format(
        "blank mesh \"fibres\": warp and weft are only {:.3g} degrees apart, at least {:.3g} are "
        "needed for cells with sides along both; choose mesh = \"free\"",
        angle, least));
  return {a, b};
}

namespace {

BlankMesh uniform_blank(const BlankSpec& spec, double warp, double weft) {
  if (spec.mesh == MeshKind::file) return blank_from_file(spec.file);
  const CellDirections directions = cell_directions(spec.mesh, warp, weft);
  if (auto grid = structured_blank(spec, directions)) return *std::move(grid);
  return cut_blank(spec, directions);
}

} // namespace

bool takes_elements(const BlankSpec& spec) {
  try {
    check_outline(spec.outline, spec.element_size);
    return true;
  } catch (const std::runtime_error&) {
    return false;
  }
}

BlankMesh mesh_blank(const BlankSpec& spec, double warp, double weft) {
  if (spec.mesh != MeshKind::file) check_outline(spec.outline, spec.element_size);
  check_zones(spec);
  if (spec.mesh == MeshKind::free) return free_blank(spec);
  BlankMesh mesh = uniform_blank(spec, warp, weft);
  return is_graded(spec) ? graded(std::move(mesh), spec) : mesh;
}

} // namespace plyform
