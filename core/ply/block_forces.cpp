// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/ply/block_forces.hpp"

#include "core/mesh/incidence.hpp"

#include <algorithm>

namespace plyform {
namespace {

/// Morton code of (a, b): their bits interleaved. Points near in the plane mostly have near codes.
std::uint64_t interleaved(std::uint32_t a, std::uint32_t b) {
  const auto spread = [](std::uint64_t v) {
    v = (v | (v << 16)) & 0x0000FFFF0000FFFF;
    v = (v | (v << 8)) & 0x00FF00FF00FF00FF;
    v = (v | (v << 4)) & 0x0F0F0F0F0F0F0F0F;
    v = (v | (v << 2)) & 0x3333333333333333;
    return (v | (v << 1)) & 0x5555555555555555;
  };
  return spread(a) | (spread(b) << 1);
}

} // namespace

void find_node_forces(BlockForces& b, std::size_t count) {
  b.force.assign(b.nodes.size() + 1, SimdForce{});
  const Gather gather = make_gather(b.nodes, count);
  const auto zero = static_cast<std::int32_t>(b.nodes.size());
  b.force_of.reserve(count);
  for (std::size_t n = 0; n < count; ++n) {
    const std::int32_t* begin = gather.gather.data() + gather.begin[n];
    const std::int32_t entries = gather.begin[n + 1] - gather.begin[n];
    NodeForces of{entries > 0 ? begin[0] : zero, entries > 1 ? begin[1] : zero};
    if (entries > 2) {
      of.second = ~static_cast<std::int32_t>(b.more.size());
      b.more.push_back(entries - 1);
      b.more.insert(b.more.end(), begin + 1, begin + entries);
    }
    b.force_of.push_back(of);
  }
}

std::vector<int> morton_order(std::span<const Vec3> points, const Box3& box) {
  const double scale = 65535.0 / std::max(1e-300, box.sizes().head<2>().maxCoeff());
  std::vector<std::pair<std::uint64_t, int>> keys;
  for (const Vec3& p : points) {
    const Vec3 cell = scale * (p - box.min());
    keys.emplace_back(
        interleaved(static_cast<std::uint32_t>(cell.x()), static_cast<std::uint32_t>(cell.y())),
        static_cast<int>(keys.size()));
  }
  std::sort(keys.begin(), keys.end());
  std::vector<int> order;
  for (const auto& key : keys)
    order.push_back(key.second);
  return order;
}

} // namespace plyform
