// SPDX-License-Identifier: GPL-3.0-or-later
// Forces that kernels sum block by block, each in the block's own list of nodes, and the map from a
// node of the ply to its entries there. A node on the border of blocks has an entry in each; they
// are added in the order of the blocks when the node is moved, so results are the same bits for any
// number of threads.
#pragma once

#include "base/geometry.hpp"
#include "core/ply/simd_kernel.hpp"

#include <span>
#include <vector>

namespace plyform {

/// Indices of a node's forces in BlockForces::force. Most nodes belong to one block; `second` is
/// then that of the zero at its end, so that summing two forces needs no branch.
struct NodeForces {
  std::int32_t first = 0;
  std::int32_t second = 0; ///< below 0: the further ones are listed from BlockForces::more[~second]
};

struct BlockForces {
  std::vector<std::int32_t> nodes;  ///< node lists of all blocks, numbers in the ply
  std::vector<SimdForce> force;     ///< N, one per entry of `nodes`, and a zero at the end
  std::vector<NodeForces> force_of; ///< one per node of the ply
  std::vector<std::int32_t> more;   ///< for nodes in more than two blocks: count, then indices
};

/// Fills force (zero), force_of and more from b.nodes, which must be complete; `count`: number of
/// nodes of the ply.
void find_node_forces(BlockForces& b, std::size_t count);

/// Sum of the forces of all blocks on a node of the ply, N.
inline Vec3 simd_force(const BlockForces& b, std::size_t node) {
  const auto force = [&b](std::int32_t i) {
    const SimdForce& f = b.force[i];
    return Vec3(f.x, f.y, f.z);
  };
  const NodeForces of = b.force_of[node];
  if (of.second >= 0) [[likely]]
    return force(of.first) + force(of.second);
  Vec3 sum = force(of.first);
  const std::int32_t* more = &b.more[~of.second];
  for (std::int32_t i = 1; i <= more[0]; ++i)
    sum += force(more[i]);
  return sum;
}

/// Numbers of the points in Morton order (Z-curve) of their x and y, in which neighbours are near
/// each other. `box` must contain all points.
std::vector<int> morton_order(std::span<const Vec3> points, const Box3& box);

} // namespace plyform
