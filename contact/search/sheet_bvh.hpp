// SPDX-License-Identifier: GPL-3.0-or-later
// Broad phase between two sheets: which nodes of one may touch which triangles of the other.
#pragma once

#include "base/geometry.hpp"

#include <memory>
#include <span>
#include <vector>

namespace plyform {

/// Node `node` of the slave sheet is within the search distance of triangle `face` of the master.
struct Candidate {
  std::int32_t node, face;
  double distance2 = 0.0;    ///< mm^2
  std::array<double, 3> w{}; ///< weights of the closest point
  bool operator==(const Candidate& other) const { return node == other.node && face == other.face; }
};

/// One sheet's AABB tree (FCL), refitted to new positions without being rebuilt.
class SheetTree {
public:
  /// x: positions (mm), one per node; triangles: constant for the life of the tree. Throws
  /// std::invalid_argument if there is no triangle, one names a node that does not exist, or a
  /// position is not finite.
  SheetTree(std::span<const Vec3> x, std::span<const Triangle> triangles);
  ~SheetTree();
  SheetTree(SheetTree&&) noexcept;
  SheetTree& operator=(SheetTree&&) noexcept;

  /// Replaces all positions and refits bottom-up. Throws std::invalid_argument, and keeps the old
  /// positions, if x.size() is not that of the constructor or a position is not finite.
  void refit(std::span<const Vec3> x);

  /// The box around all of the sheet at the last refit.
  Box3 bounds() const;

  /// Appends every (node, face) with distance(nodes[i], face) <= reach (mm), sorted by node and
  /// then by face, and no other pair. `nodes` (mm) are positions of another sheet, or of this one:
  /// then the node's own triangles are listed too, and the caller must remove them. The distance is
  /// that of closest_point_on_triangle, compared as distance2 <= reach * reach, so the list is, bit
  /// for bit, that of a test of all pairs. Const calls from several threads are safe while no
  /// thread refits. Nodes i with skip[i] != 0 are left out (an empty `skip` skips none). Throws
  /// std::invalid_argument if reach is negative or it or a node is not finite.
  void candidates(std::span<const Vec3> nodes, double reach, std::vector<Candidate>& out,
                  std::span<const char> skip = {}) const;

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace plyform
