// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/results/ply_frame.hpp"

namespace plyform {

std::vector<double> areas_before(const PlyFrame& ply) {
  std::vector<double> areas;
  areas.reserve(ply.triangles.size());
  for (const Triangle& t : ply.triangles) {
    const Vec3& a = ply.x0[t[0]];
    const Vec3& b = ply.x0[t[1]];
    const Vec3& c = ply.x0[t[2]];
    areas.push_back((b - a).cross(c - a).norm() / 2);
  }
  return areas;
}

} // namespace plyform
