// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/results/mould_fill.hpp"

#include "base/node_normals.hpp"

#include <algorithm>

namespace plyform {
namespace {

constexpr double wider_than_the_stack = 0.05; // of the gap
constexpr double packed_from = 0.999;

Vec3 centre_of(const PlyFrame& ply, std::size_t triangle) {
  const auto [a, b, c] = ply.triangles[triangle];
  return (ply.x[at(a)] + ply.x[at(b)] + ply.x[at(c)]) / 3.0;
}

} // namespace

std::optional<FibreVolume> fibre_volume_of(const PlyFrame& ply) {
  const std::vector<double>& v = ply.fibre_volume;
  if (v.empty()) return std::nullopt;
  double fibres = 0.0, volume = 0.0;
  for (std::size_t e = 0; e < v.size(); ++e) {
    const double of_triangle = triangle_area(ply.x, ply.triangles[e]) * ply.thickness[e];
    fibres += v[e] * of_triangle, volume += of_triangle;
  }
  const auto [least, largest] = std::minmax_element(v.begin(), v.end());
  return FibreVolume{fibres / volume, *least, *largest,
                     centre_of(ply, static_cast<std::size_t>(least - v.begin())),
                     centre_of(ply, static_cast<std::size_t>(largest - v.begin()))};
}

std::optional<MouldFill> mould_fill_of(const PlyFrame& ply) {
  const GapFrame& mould = ply.mould;
  if (mould.gap.empty()) return std::nullopt;
  const std::vector<double> areas = areas_before(ply);
  MouldFill found;
  for (std::size_t e = 0; e < areas.size(); ++e) {
    if (!(mould.gap[e] > 0.0)) continue;
    const double gap = mould.gap[e];
    found.least_gap = found.area > 0.0 ? std::min(found.least_gap, gap) : gap;
    found.area += areas[e], found.mean_gap += areas[e] * gap;
    if (mould.left[e] > wider_than_the_stack * gap) found.wider += areas[e];
    if (mould.packing[e] >= packed_from) found.packed += areas[e];
    if (mould.left[e] > found.widest)
      found.widest = mould.left[e], found.widest_at = centre_of(ply, e);
  }
  if (found.area > 0.0) found.mean_gap /= found.area;
  return found;
}

} // namespace plyform
