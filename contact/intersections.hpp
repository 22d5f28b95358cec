// SPDX-License-Identifier: GPL-3.0-or-later
// Exact check for intersecting triangles of sheets in a given state (CGAL, exact predicates).
#pragma once

#include "base/geometry.hpp"

#include <compare>
#include <functional>
#include <span>
#include <vector>

namespace plyform {

/// Triangle `a` of sheet `sheet_a` crosses triangle `b` of sheet `sheet_b` (sheet_a <= sheet_b, and
/// a < b within one sheet).
struct Intersection {
  int sheet_a, a, sheet_b, b;
  auto operator<=>(const Intersection&) const = default;
};

struct Intersections {
  std::vector<Intersection> between; ///< pairs of triangles of different sheets
  std::vector<Intersection> within;  ///< pairs of one sheet
};

struct MeshView {
  std::span<const Vec3> x; ///< mm
  std::span<const Triangle> triangles;
};

/// All intersecting triangle pairs of the given sheets, in ascending order, each once. Exact:
/// coordinates are taken as the doubles that they are. Triangles are closed: touching in a point
/// and overlapping in a plane both count. Neighbours of one sheet (by node number) count only when
/// they meet beyond the node or edge that they share. A degenerate triangle is the segment or point
/// that it is. Cost about n log n. Throws std::runtime_error naming sheet and node if a position
/// is not finite or a triangle names a node that does not exist.
Intersections find_intersections(std::span<const MeshView> sheets);

/// Calls task(0) .. task(count - 1), each once, in any order or at once, as ThreadPool::run.
using RunTasks = std::function<void(int count, const std::function<void(int)>& task)>;

/// The same, found by independent tasks.
Intersections find_intersections(std::span<const MeshView> sheets, const RunTasks& run);

} // namespace plyform
