// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/mesh_ply.hpp"

#include "core/mesh/tool_zone.hpp"

namespace plyform {

BlankMesh mesh_ply(const Case& data, const Ply& ply) {
  const double angle = ply.angle - ply.rotation; // as seen from the blank
  const MaterialAxes axes = material_axes(data.fabrics[ply.fabric]);
  BlankSpec blank = data.blanks[ply.blank];
  for (MeshZone& zone : blank.zones)
    zone = seen_from_blank(std::move(zone), ply);
  BlankMesh mesh = mesh_blank(blank, angle + axes.first, angle + axes.second);
  if (ply.rotation == 0.0 && ply.seed.isZero(0.0)) return mesh;
  const Eigen::Rotation2Dd turn(ply.rotation);
  for (Vec2& x : mesh.x)
    x = ply.seed + turn * x;
  return mesh;
}

} // namespace plyform
