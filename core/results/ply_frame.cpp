// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/results/ply_frame.hpp"

#include <cmath>

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

double area_share_above(const std::vector<double>& values, double limit,
                        const std::vector<double>& areas) {
  double above = 0.0, all = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isnan(values[i])) return values[i];
    all += areas[i];
    if (values[i] > limit) above += areas[i];
  }
  return all > 0.0 ? above / all : 0.0;
}

} // namespace plyform
