// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/ply/mirrored_sheet.hpp"

#include <algorithm>
#include <map>

namespace plyform {
namespace {

constexpr int layers = 3;

/// Of each node how many sides it is away from a plane, `layers` at most.
std::vector<int> sides_from(const SymmetryPlane& plane, std::span<const Vec2> x,
                            const std::vector<Triangle>& triangles) {
  std::vector<int> away(x.size(), layers);
  for (std::size_t n = 0; n < x.size(); ++n)
    if (lies_on(plane, x[n])) away[n] = 0;
  for (int layer = 1; layer < layers; ++layer) {
    const std::vector<int> before = away;
    for (const Triangle& t : triangles) {
      const int least = std::min({before[at(t[0])], before[at(t[1])], before[at(t[2])]});
      for (const std::int32_t n : t)
        if (least == layer - 1) away[at(n)] = std::min(away[at(n)], layer);
    }
  }
  return away;
}

} // namespace

MirroredSheet mirrored_sheet(std::span<const Vec2> x, const std::vector<Triangle>& triangles,
                             const std::vector<SymmetryPlane>& planes) {
  MirroredSheet sheet{{x.begin(), x.end()}, triangles, {}, {}};
  if (planes.empty()) return sheet;
  sheet.mirrors = images_at(planes);
  std::vector<std::vector<int>> away;
  for (const SymmetryPlane& plane : planes)
    away.push_back(sides_from(plane, x, triangles));
  std::map<std::pair<std::int32_t, unsigned>, std::int32_t> numbers;
  /// The number of the image of a node; a node on a plane is its own image there.
  const auto image_of = [&](std::int32_t node, unsigned bits) {
    for (std::size_t k = 0; k < planes.size(); ++k)
      if (away[k][at(node)] == 0) bits &= ~(1U << k);
    if (bits == 0) return node;
    const auto [found, is_new] =
        numbers.try_emplace({node, bits}, static_cast<std::int32_t>(sheet.x.size()));
    if (!is_new) return found->second;
    const Vec2& p = x[at(node)];
    sheet.x.emplace_back(sheet.mirrors[bits].place({p.x(), p.y(), 0.0}).head<2>());
    sheet.images.push_back({node, static_cast<std::int32_t>(bits)});
    return found->second;
  };
  for (unsigned bits = 1; bits < sheet.mirrors.size(); ++bits)
    for (const Triangle& t : triangles) {
      const auto is_near = [&](std::size_t k) {
        return !(bits >> k & 1U) ||
               std::min({away[k][at(t[0])], away[k][at(t[1])], away[k][at(t[2])]}) < layers;
      };
      if (!is_near(0) || (planes.size() > 1 && !is_near(1))) continue;
      Triangle& image = sheet.triangles.emplace_back();
      for (std::size_t k = 0; k < 3; ++k)
        image[k] = image_of(t[k], bits);
      if (sheet.mirrors[bits].turns_round()) std::swap(image[1], image[2]);
    }
  return sheet;
}

} // namespace plyform
