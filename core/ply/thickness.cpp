// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/ply/thickness.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {

ThicknessLaw thickness_law(const Fabric& fabric) {
  if (!fabric.has_yarns()) return {};
  if (yarn_directions(fabric) == 1) return {{true, false}, 1.0};
  return {{true, true}, thinnest_ratio};
}

namespace {

/// The images of both axes in a triangle with edges B and C from its first corner.
struct Images {
  Vec3 first, second, across; ///< k_1, k_2, k_1 x k_2
  Images(const AxesGradients& g, const Vec3& b, const Vec3& c)
      : first(g.c11 * b + g.c12 * c), second(g.c21 * b + g.c22 * c), across(first.cross(second)) {}
};

double ratio_of(const ThicknessLaw& law, double sin_omega0, const Images& k) {
  double ratio2 = sin_omega0 * sin_omega0 / k.across.squaredNorm();
  if (law.yarns[0]) ratio2 *= k.first.squaredNorm();
  if (law.yarns[1]) ratio2 *= k.second.squaredNorm();
  return std::sqrt(ratio2);
}

} // namespace

ElementThickness element_thickness(const ThicknessLaw& law, const Membrane& m,
                                   std::span<const Vec3> x, std::size_t triangle) {
  const Triangle& t = m.triangles[triangle];
  const AxesGradients& g = m.c[triangle];
  const Images k(g, x[at(t[1])] - x[at(t[0])], x[at(t[2])] - x[at(t[0])]);
  const double ratio = ratio_of(law, std::sin(m.omega0), k), area = k.across.norm();
  const Vec3 n = k.across / area;
  Vec3 by_first = n.cross(k.second) / area, by_second = k.first.cross(n) / area; // -dlog|k1 x k2|
  if (law.yarns[0]) by_first += k.first / k.first.squaredNorm();
  if (law.yarns[1]) by_second += k.second / k.second.squaredNorm();
  return {ratio, ratio * (g.c11 * by_first + g.c21 * by_second),
          ratio * (g.c12 * by_first + g.c22 * by_second)};
}

void thickness_ratios(const ThicknessLaw& law, const Membrane& m, std::span<const Vec3> x,
                      std::vector<double>& ratio) {
  ratio.assign(x.size(), 0.0);
  const double sin_omega0 = std::sin(m.omega0);
  for (std::size_t e = 0; e < m.triangles.size(); ++e) {
    const Triangle& t = m.triangles[e];
    const Images k(m.c[e], x[at(t[1])] - x[at(t[0])], x[at(t[2])] - x[at(t[0])]);
    const double part = m.area[e] / 3.0 * ratio_of(law, sin_omega0, k);
    for (const int n : t)
      ratio[at(n)] += part;
  }
  for (std::size_t n = 0; n < x.size(); ++n)
    ratio[n] = std::clamp(ratio[n] / m.node_area[n], law.least, thickest_ratio);
}

} // namespace plyform
