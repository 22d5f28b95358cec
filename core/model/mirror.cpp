// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/model/mirror.hpp"

#include <cmath>

namespace plyform {

Vec3 normal_of(const SymmetryPlane& plane) {
  return {plane.normal.x(), plane.normal.y(), 0.0};
}

Vec3 mirrored(const SymmetryPlane& plane, const Vec3& x) {
  const Vec3 normal = normal_of(plane), point(plane.point.x(), plane.point.y(), 0.0);
  return x - 2.0 * (x - point).dot(normal) * normal;
}

Vec3 mirrored_direction(const SymmetryPlane& plane, const Vec3& v) {
  const Vec3 normal = normal_of(plane);
  return v - 2.0 * v.dot(normal) * normal;
}

std::vector<Mirror> images_at(const std::vector<SymmetryPlane>& planes) {
  std::vector<Mirror> images(1);
  for (std::size_t k = 0; k < planes.size(); ++k) {
    const Vec3 normal = normal_of(planes[k]);
    Mirror at;
    at.turn -= 2.0 * normal * normal.transpose();
    at.shift = mirrored(planes[k], Vec3::Zero());
    const std::size_t before = images.size();
    for (std::size_t i = 0; i < before; ++i)
      images.push_back({images[i].planes | 1U << k, at.turn * images[i].turn,
                        at.turn * images[i].shift + at.shift});
  }
  return images;
}

std::vector<SymmetryPlane> planes_of(const std::vector<Boundary>& boundaries, int ply) {
  constexpr double right = 1e-9; // cosine
  std::vector<SymmetryPlane> planes;
  for (const Boundary& b : boundaries) {
    if (!b.is<SymmetryPlane>() || (b.ply >= 0 && b.ply != ply)) continue;
    for (const SymmetryPlane& other : planes)
      if (std::abs(other.normal.dot(b.as<SymmetryPlane>().normal)) > right) return {};
    planes.push_back(b.as<SymmetryPlane>());
  }
  return planes;
}

bool lies_on(const SymmetryPlane& plane, const Vec2& x) {
  constexpr double rounding = 1e-4; // mm
  return std::abs((x - plane.point).dot(plane.normal)) <= rounding;
}

} // namespace plyform
