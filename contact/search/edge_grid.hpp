// SPDX-License-Identifier: GPL-3.0-or-later
// Which edges of a sheet are near a box: their bounding boxes, sorted into the cells of a grid.
#pragma once

#include "contact/search/float_box.hpp"
#include "contact/search/sheet_edges.hpp"

#include <algorithm>

namespace plyform {

/// The bounding box (mm) of an edge of nodes at x (mm), larger by `inflate` (mm) all round.
Box3 edge_box(const SheetEdge& edge, std::span<const Vec3> x, double inflate);

/// The bounding boxes of some edges, sorted into the square cells of a grid in the plane of the two
/// axes of largest extent; each edge is in the cell of the lower corner of its box.
class EdgeGrid {
public:
  /// Of those of `edges` with the numbers `some`, ascending. x: mm, positions of the nodes.
  EdgeGrid(std::span<const SheetEdge> edges, std::span<const Vec3> x,
           std::span<const std::int32_t> some);

  /// Calls found(number) for each edge whose box, rounded outwards, intersects this one (mm).
  template <class Found>
  void visit(const Box3& box, const Found& found) const {
    if (edges_.empty()) return;
    const FloatBox rounded(box.min(), box.max());
    std::array<int, 3> from{}, to{};
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      from[a] = axis == flat_ ? 0 : place(box.min()[axis] - widest_[axis], axis, count_[a] - 1);
      to[a] = axis == flat_ ? 0 : place(box.max()[axis], axis, count_[a] - 1);
    }
    const std::size_t row = flat_ == 0 ? 1 : 0, in_row = flat_ == 2 ? 1 : 2;
    for (int i = from[row]; i <= to[row]; ++i) { // the cells of a row follow each other
      std::array<int, 3> first{}, last{};
      first[row] = last[row] = i;
      first[in_row] = from[in_row];
      last[in_row] = to[in_row];
      const std::int32_t end = begin_[number_of(last) + 1];
      std::array<std::int32_t, 32> hits; // without a branch each, which would often be mispredicted
      for (std::int32_t e = begin_[number_of(first)]; e < end;) {
        const std::int32_t stop = std::min(end, e + static_cast<std::int32_t>(hits.size()));
        std::size_t count = 0;
        for (; e < stop; ++e) {
          hits[count] = edges_[at(e)];
          count += overlap(rounded, boxes_[at(e)]) ? 1 : 0;
        }
        for (std::size_t hit = 0; hit < count; ++hit)
          found(hits[hit]);
      }
    }
  }

private:
  struct Entry {
    Box3 box;
    std::int32_t edge;
  };

  void sort_into_cells(const std::vector<Entry>& unsorted);

  int place(double x, int axis, int last) const {
    return static_cast<int>(std::clamp((x - low_[axis]) / cell_, 0.0, static_cast<double>(last)));
  }
  std::size_t number_of(const std::array<int, 3>& cell) const {
    return static_cast<std::size_t>((cell[0] * count_[1] + cell[1]) * count_[2] + cell[2]);
  }
  std::size_t cell_of(const Vec3& x) const;

  std::vector<FloatBox> boxes_;                     ///< by cells, in each by ascending edges
  std::vector<std::int32_t> edges_;                 ///< of these boxes
  std::vector<std::int32_t> begin_;                 ///< of each cell
  Vec3 low_ = Vec3::Zero(), widest_ = Vec3::Zero(); ///< mm
  double cell_ = 1.0;                               ///< mm
  int flat_ = 2;                                    ///< axis without cells
  std::array<int, 3> count_{1, 1, 1};
};

} // namespace plyform
