// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solver/ply_body.hpp"

#include "base/node_normals.hpp"

namespace plyform {

std::vector<Vec3> normals_at_nodes(const PlyBody& ply) {
  std::vector<Vec3> normals = area_normals(ply.x, ply.membrane.triangles);
  for (const NodesOnPlane& plane : ply.on_planes)
    for (const std::int32_t n : plane.nodes)
      normals[at(n)] -= normals[at(n)].dot(plane.normal) * plane.normal;
  return normals;
}

} // namespace plyform
