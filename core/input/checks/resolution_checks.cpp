// SPDX-License-Identifier: GPL-3.0-or-later
// Warnings of meshes that are too coarse for the lengths of bending_resolution.hpp.
#include "base/format.hpp"
#include "core/input/checks/scene_checks.hpp"
#include "core/model/bending_resolution.hpp"
#include "core/model/fabric_estimates.hpp"
#include "core/model/reach_ahead.hpp"

#include <cmath>
#include <set>
#include <stdexcept>
#include <utility>

namespace plyform {
namespace {

/// What a mesh of element size h (mm) does not resolve, and the size that would; empty if nothing.
std::string too_coarse(const Fabric& f, bool stack, double h) {
  const BendingLengths lengths = bending_lengths(f, 0.0);
  if (lengths.sideways == 0.0) {
    if (!stack) return ""; // hardly compressed, and no mesh would be fine enough
    return fmt::format(
        "yarns of {} bear compression but do not resist bending in their plane: where they are "
        "pressed they give way sideways at the size of the mesh, whatever it is; give warp and "
        "weft "
        "an in_plane_bending_stiffness, {:.2g} N mm or so",
        f.name, usual_in_plane_bending(f));
  }
  std::string what;
  if (lengths.layer && *lengths.layer < elements_in_layer * h)
    what = fmt::format("shear changes over {:.3g} mm, {:.2g} elements, and needs {:g}",
                       *lengths.layer, *lengths.layer / h, elements_in_layer);
  if (lengths.sideways && *lengths.sideways < elements_in_wave * h)
    what += fmt::format("{}pressed yarns give way sideways in waves of {:.3g} mm, {:.2g} elements, "
                        "and need {:g}",
                        what.empty() ? "" : "; ", *lengths.sideways, *lengths.sideways / h,
                        elements_in_wave);
  if (what.empty()) return "";
  return fmt::format("is too coarse for how yarns of {} bend in their plane: {}: two runs that "
                     "differ by nothing to speak of may then differ by degrees of shear; elements "
                     "of {:.2g} mm would do, or a larger in_plane_bending_stiffness",
                     f.name, what, std::floor(10.0 * element_size_needed(lengths)) / 10.0);
}

/// Mean element size (mm): side of a square of two triangles.
double size_of(const BlankMesh& mesh) {
  double twice_area = 0.0;
  for (const Triangle& t : mesh.triangles) {
    const Vec2 a = mesh.x[t[0]];
    const Vec2 u = mesh.x[t[1]] - a, v = mesh.x[t[2]] - a;
    twice_area += std::abs(u.x() * v.y() - u.y() * v.x());
  }
  return std::sqrt(twice_area / static_cast<double>(mesh.triangles.size()));
}

} // namespace

void check_resolution(const Case& scene, const CaseParts& parts,
                      const std::vector<BlankMesh>& meshes, Diagnostics& diagnostics) {
  const ReachAhead ahead = reach_ahead(scene);
  std::set<std::pair<int, int>> seen;
  for (std::size_t p = 0; p < scene.plies.size(); ++p) {
    const Ply& ply = scene.plies[p];
    if (!seen.emplace(ply.fabric, ply.blank).second) continue;
    const Fabric& fabric = scene.fabrics[ply.fabric];
    const auto number = static_cast<std::size_t>(ply.blank);
    const BlankSpec& spec = scene.blanks[number];
    if (!spec.mesh_from.empty()) continue; // small where shear bends sharply, once it is there
    const double h = spec.mesh == MeshKind::file ? size_of(meshes[p]) : spec.element_size;
    const std::string text = too_coarse(fabric, ahead.plies_in_stack(p) > 1, h);
    if (text.empty()) continue;
    const SourceLocation& blank = parts.blanks[number];
    diagnostics.warning(blank.at,
                        fmt::format("{}, elements of {:.3g} mm: {}", blank.item, h, text));
  }
}

} // namespace plyform
