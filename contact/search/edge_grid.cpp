// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/search/edge_grid.hpp"

#include <numeric>

namespace plyform {

Box3 edge_box(const SheetEdge& e, std::span<const Vec3> x, double inflate) {
  Box3 box(at(x, e.a).cwiseMin(at(x, e.b)), at(x, e.a).cwiseMax(at(x, e.b)));
  box.min().array() -= inflate;
  box.max().array() += inflate;
  return box;
}

EdgeGrid::EdgeGrid(std::span<const SheetEdge> edges, std::span<const Vec3> x,
                   std::span<const std::int32_t> some) {
  Box3 all;
  std::vector<Entry> unsorted;
  unsorted.reserve(some.size());
  for (const std::int32_t e : some) {
    unsorted.push_back({edge_box(edges[at(e)], x, 0.0), e});
    all.extend(unsorted.back().box);
    widest_ = widest_.cwiseMax(unsorted.back().box.sizes());
  }
  if (unsorted.empty()) return;
  all.sizes().minCoeff(&flat_);
  low_ = all.min();
  // Small cells have fewer edges to look at in vain, large ones fewer rows; most_cells: along an
  // axis.
  constexpr double share = 0.4, most_cells = 1000.0;
  cell_ = std::max({share * widest_.maxCoeff(), all.sizes().maxCoeff() / most_cells, 1e-9});
  for (int axis = 0; axis < 3; ++axis)
    count_[static_cast<std::size_t>(axis)] =
        axis == flat_ ? 1 : place(all.max()[axis], axis, 1 << 20) + 1;
  sort_into_cells(unsorted);
}

void EdgeGrid::sort_into_cells(const std::vector<Entry>& unsorted) {
  std::vector<std::size_t> cell;
  cell.reserve(unsorted.size());
  begin_.assign(static_cast<std::size_t>(count_[0] * count_[1] * count_[2] + 1), 0);
  for (const Entry& e : unsorted) {
    cell.push_back(cell_of(e.box.min()));
    ++begin_[cell.back() + 1];
  }
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  std::vector<std::int32_t> next(begin_.begin(), begin_.end() - 1);
  boxes_.resize(unsorted.size());
  edges_.resize(unsorted.size());
  for (std::size_t i = 0; i < unsorted.size(); ++i) {
    const std::size_t to = at(next[cell[i]]++);
    boxes_[to] = FloatBox(unsorted[i].box.min(), unsorted[i].box.max());
    edges_[to] = unsorted[i].edge;
  }
}

std::size_t EdgeGrid::cell_of(const Vec3& x) const {
  std::array<int, 3> i{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    if (axis != flat_) i[a] = place(x[axis], axis, count_[a] - 1);
  }
  return number_of(i);
}

} // namespace plyform
