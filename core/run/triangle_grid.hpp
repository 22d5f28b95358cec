// SPDX-License-Identifier: GPL-3.0-or-later
// Which straight ways cross a sheet: its triangles by the cells of a grid.
#pragma once

#include "base/geometry.hpp"

#include <span>
#include <vector>

namespace plyform {

class TriangleGrid {
public:
  /// x: mm, all finite; cell: mm, about a side; margin: mm, by which ways may miss the border. Both
  /// arrays must outlive the grid.
  TriangleGrid(std::span<const Vec3> x, std::span<const Triangle> triangles, double cell,
               double margin = 0.0);

  /// A triangle that the straight way from a to b (mm) crosses, one of the first on its way; -1:
  /// none.
  std::int32_t crossed(const Vec3& a, const Vec3& b) const;
  /// Whether that way crosses a triangle.
  bool crosses(const Vec3& a, const Vec3& b) const { return crossed(a, b) >= 0; }

private:
  struct Entry {
    std::uint64_t cell;
    std::int32_t triangle;
  };
  std::uint64_t number_of(const std::array<std::int64_t, 3>& cell) const;
  std::array<std::int64_t, 3> cell_of(const Vec3& x) const;

  std::span<const Vec3> x_;
  std::span<const Triangle> triangles_;
  double size_, margin_;
  Vec3 low_, high_;
  std::array<std::int64_t, 3> counts_{};
  std::vector<Entry> entries_; ///< ascending by cell
};

} // namespace plyform
