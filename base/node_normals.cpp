// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/node_normals.hpp"

namespace plyform {
namespace {

/// Per node, the sum of normal(2 A n) over its triangles, with their areas A and unit normals n.
template <class Normal>
std::vector<Vec3> sum_at_nodes(std::span<const Vec3> x, std::span<const Triangle> triangles,
                               const Normal& normal) {
  std::vector<Vec3> normals(x.size(), Vec3::Zero());
  for (const Triangle& t : triangles) {
    const Vec3& a = at(x, t[0]);
    const Vec3 n = normal((at(x, t[1]) - a).cross(at(x, t[2]) - a));
    for (const std::int32_t k : t)
      normals[at(k)] += n;
  }
  return normals;
}

} // namespace

std::vector<Vec3> area_normals(std::span<const Vec3> x, std::span<const Triangle> triangles) {
  return sum_at_nodes(x, triangles, [](const Vec3& n) { return n; });
}

std::vector<Vec3> mean_normals(std::span<const Vec3> x, std::span<const Triangle> triangles) {
  std::vector<Vec3> normals =
      sum_at_nodes(x, triangles, [](const Vec3& n) { return n.stableNormalized(); });
  for (Vec3& n : normals)
    n.stableNormalize();
  return normals;
}

} // namespace plyform
