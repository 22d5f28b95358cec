// SPDX-License-Identifier: GPL-3.0-or-later
// Search for pairs of edges of two sheets that are close to each other.
#include "contact/forces/edge_edge.hpp"

#include <cmath>
#include <numeric>

namespace plyform {
namespace {

const Vec3& at(std::span<const Vec3> x, int n) {
  return x[n];
}

Box3 edge_box(const SheetEdge& e, std::span<const Vec3> x, double inflate) {
  Box3 box(at(x, e.a).cwiseMin(at(x, e.b)), at(x, e.a).cwiseMax(at(x, e.b)));
  box.min().array() -= inflate;
  box.max().array() += inflate;
  return box;
}

/// The bounding boxes of some edges, sorted into the square cells of a grid in the plane of the two
/// axes of largest extent; each edge is in the cell of the lower corner of its box.
class EdgeGrid {
public:
  /// Of the edges with the numbers `some`.
  EdgeGrid(const EdgeSheet& sheet, std::span<const std::int32_t> some) {
    Box3 all;
    std::vector<Entry> unsorted;
    unsorted.reserve(some.size());
    for (const std::int32_t e : some) {
      unsorted.push_back({edge_box(sheet.edges.all[e], sheet.state.x, 0.0), e});
      all.extend(unsorted.back().box);
      widest_ = widest_.cwiseMax(unsorted.back().box.sizes());
    }
    if (unsorted.empty()) return;
    all.sizes().minCoeff(&flat_);
    low_ = all.min();
    constexpr double most_cells = 1000.0; // upper limit of the cells along an axis
    cell_ = std::max({widest_.maxCoeff(), all.sizes().maxCoeff() / most_cells, 1e-9});
    for (int axis = 0; axis < 3; ++axis)
      count_[axis] = axis == flat_ ? 1 : place(all.max()[axis], axis, 1 << 20) + 1;
    sort_into_cells(unsorted);
  }

  /// Calls found(edge) for each edge whose box intersects this one.
  template <class Found>
  void visit(const Box3& box, const Found& found) const {
    if (entries_.empty()) return;
    std::array<int, 3> from{}, to{};
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      from[a] = axis == flat_ ? 0 : place(box.min()[axis] - widest_[axis], axis, count_[a] - 1);
      to[a] = axis == flat_ ? 0 : place(box.max()[axis], axis, count_[a] - 1);
    }
    for (int i = from[0]; i <= to[0]; ++i)
      for (int j = from[1]; j <= to[1]; ++j)
        for (int k = from[2]; k <= to[2]; ++k) {
          const auto cell = static_cast<std::size_t>((i * count_[1] + j) * count_[2] + k);
          for (std::int32_t e = begin_[cell]; e < begin_[cell + 1]; ++e) {
            const Entry& entry = entries_[e];
            if (box.intersects(entry.box)) found(entry.edge);
          }
        }
  }

private:
  struct Entry {
    Box3 box;
    std::int32_t edge;
  };

  /// Entries of a cell stay in ascending order of their edges.
  void sort_into_cells(const std::vector<Entry>& unsorted) {
    std::vector<int> cell;
    cell.reserve(unsorted.size());
    begin_.assign(static_cast<std::size_t>(count_[0] * count_[1] * count_[2] + 1), 0);
    for (const Entry& e : unsorted) {
      cell.push_back(cell_of(e.box.min()));
      ++begin_[static_cast<std::size_t>(cell.back()) + 1];
    }
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    std::vector<std::int32_t> next(begin_.begin(), begin_.end() - 1);
    entries_.resize(unsorted.size());
    for (std::size_t i = 0; i < unsorted.size(); ++i)
      entries_[static_cast<std::size_t>(next[static_cast<std::size_t>(cell[i])]++)] = unsorted[i];
  }

  int place(double x, int axis, int last) const {
    return static_cast<int>(
        std::clamp(std::floor((x - low_[axis]) / cell_), 0.0, static_cast<double>(last)));
  }
  int cell_of(const Vec3& x) const {
    std::array<int, 3> i{};
    for (int axis = 0; axis < 3; ++axis)
      if (axis != flat_) i[axis] = place(x[axis], axis, count_[axis] - 1);
    return (i[0] * count_[1] + i[1]) * count_[2] + i[2];
  }

  std::vector<Entry> entries_;
  std::vector<std::int32_t> begin_;
  Vec3 low_ = Vec3::Zero(), widest_ = Vec3::Zero(); ///< mm
  double cell_ = 1.0;                               ///< mm
  int flat_ = 2;                                    ///< axis without cells
  std::array<int, 3> count_{1, 1, 1};
};

bool neighbours(const SheetEdge& e, const SheetEdge& g, const SelfEdges& self) {
  if (e.a == g.a || e.a == g.b || e.b == g.a || e.b == g.b) return true;
  return edge_distance({e.a, e.b}, self.x0, {g.a, g.b}, self.x0) < self.apart;
}

/// A pair of edges within reach, and its gap, mm.
struct Found {
  std::array<std::int32_t, 2> patch, edge;
  double gap;
};

/// Groups the pairs found, in ascending order of their edges, by patches. Groups keep the pairs
/// that they had before the search.
void renew_groups(EdgeEdgeContact& contact, std::vector<Found>& found) {
  std::stable_sort(found.begin(), found.end(),
                   [](const Found& f, const Found& g) { return f.patch < g.patch; });
  std::vector<EdgeGroup> old = std::move(contact.groups);
  contact.groups.clear();
  auto known = old.begin();
  for (const Found& f : found) {
    if (contact.groups.empty() || contact.groups.back().patch != f.patch) {
      contact.groups.emplace_back().patch = f.patch;
      while (known != old.end() && known->patch < f.patch)
        ++known;
      if (known != old.end() && known->patch == f.patch)
        contact.groups.back().pairs = std::move(known->pairs);
    }
    EdgeGroup& group = contact.groups.back();
    group.candidates.push_back(f.edge);
    group.list.free_until.push_back(f.gap);
  }
}

} // namespace

void find_edge_pairs(EdgeEdgeContact& contact, const EdgeSheet& a,
                     std::span<const std::int32_t> some_a, const EdgeSheet& b,
                     std::span<const std::int32_t> some_b, double skin, const SelfEdges& self) {
  const EdgeGrid grid(b, some_b);
  std::vector<std::int32_t> near;
  std::vector<Found> found;
  for (const std::int32_t e : some_a) {
    const SheetEdge& edge = a.edges.all[e];
    near.clear();
    grid.visit(edge_box(edge, a.state.x, contact.distance + skin),
               [&near](std::int32_t other) { near.push_back(other); });
    std::sort(near.begin(), near.end());
    for (const std::int32_t other : near) {
      const SheetEdge& of_b = b.edges.all[other];
      if (!self.x0.empty() && (other <= e || neighbours(edge, of_b, self))) continue;
      const double gap = edge_distance({edge.a, edge.b}, a.state.x, {of_b.a, of_b.b}, b.state.x) -
                         contact.distance;
      if (gap > skin) continue; // the boxes intersect, the edges are further apart
      found.push_back({{a.edges.patch[e], b.edges.patch[other]}, {e, other}, gap});
    }
  }
  renew_groups(contact, found);
}

} // namespace plyform
