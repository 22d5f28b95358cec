// SPDX-License-Identifier: GPL-3.0-or-later
// Forces that kernels add up block by block, each at the block's own list of nodes, and where a
// node of the ply finds its own in them. A node on the border of blocks has a force from each; they
// are added in the order of the blocks, by whoever moves the node: the same bits for any number of
// threads.
#pragma once

#include "contact/geometry.hpp"
#include "core/ply/simd_kernel.hpp"

#include <span>
#include <vector>

namespace plyform {

/// Where a node's forces are in BlockForces::force. Most nodes belong to one block; then the second
/// is the zero at its end, so that reading it is a matter of no branch.
struct NodeForces {
  std::int32_t first = 0;
  std::int32_t second = 0; ///< below 0: there are more, from ~second in BlockForces::more
};

struct BlockForces {
  std::vector<std::int32_t> nodes;  ///< of the blocks, in the ply
  std::vector<SimdForce> force;     ///< one each of `nodes`, and a zero
  std::vector<NodeForces> force_of; ///< one a node of the ply, ascending
  std::vector<std::int32_t> more;   ///< how many, then these, of nodes with more than two
};

/// Fills the rest by `nodes`, whose blocks are complete; `count`: nodes of the ply.
void find_node_forces(BlockForces& b, std::size_t count);

/// N, on a node of the ply from all blocks.
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

/// Numbers of the points in an order in which neighbours in x and y are near each other (Morton's);
/// `box` holds the points.
std::vector<int> morton_order(std::span<const Vec3> points, const Box3& box);

} // namespace plyform
