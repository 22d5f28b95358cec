// SPDX-License-Identifier: GPL-3.0-or-later
// Search for pairs of edges of two sheets that are close to each other.
#include "contact/forces/edge_edge.hpp"

#include <cmath>
#include <numeric>
#include <tuple>

namespace plyform {
namespace {

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
    // Small cells have fewer edges to look at in vain, large ones fewer rows; most_cells: along an
    // axis.
    constexpr double share = 0.4, most_cells = 1000.0;
    cell_ = std::max({share * widest_.maxCoeff(), all.sizes().maxCoeff() / most_cells, 1e-9});
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
    const std::size_t row = flat_ == 0 ? 1 : 0, in_row = flat_ == 2 ? 1 : 2;
    for (int i = from[row]; i <= to[row]; ++i) { // the cells of a row follow each other
      std::array<int, 3> first{}, last{};
      first[row] = last[row] = i;
      first[in_row] = from[in_row];
      last[in_row] = to[in_row];
      const std::int32_t end = begin_[number_of(last) + 1];
      for (std::int32_t e = begin_[number_of(first)]; e < end; ++e)
        if (const auto& [other, edge] = entries_[e];
            overlap(box.min(), box.max(), other.min(), other.max()))
          found(edge);
    }
  }

private:
  struct Entry {
    Box3 box;
    std::int32_t edge;
  };

  /// Entries of a cell stay in ascending order of their edges.
  void sort_into_cells(const std::vector<Entry>& unsorted) {
    std::vector<std::size_t> cell;
    cell.reserve(unsorted.size());
    begin_.assign(static_cast<std::size_t>(count_[0] * count_[1] * count_[2] + 1), 0);
    for (const Entry& e : unsorted) {
      cell.push_back(cell_of(e.box.min()));
      ++begin_[cell.back() + 1];
    }
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    std::vector<std::int32_t> next(begin_.begin(), begin_.end() - 1);
    entries_.resize(unsorted.size());
    for (std::size_t i = 0; i < unsorted.size(); ++i)
      entries_[static_cast<std::size_t>(next[cell[i]]++)] = unsorted[i];
  }

  int place(double x, int axis, int last) const {
    return static_cast<int>(
        std::clamp(std::floor((x - low_[axis]) / cell_), 0.0, static_cast<double>(last)));
  }
  std::size_t number_of(const std::array<int, 3>& cell) const {
    return static_cast<std::size_t>((cell[0] * count_[1] + cell[1]) * count_[2] + cell[2]);
  }
  std::size_t cell_of(const Vec3& x) const {
    std::array<int, 3> i{};
    for (int axis = 0; axis < 3; ++axis)
      if (axis != flat_) i[axis] = place(x[axis], axis, count_[axis] - 1);
    return number_of(i);
  }

  std::vector<Entry> entries_;
  std::vector<std::int32_t> begin_;
  Vec3 low_ = Vec3::Zero(), widest_ = Vec3::Zero(); ///< mm
  double cell_ = 1.0;                               ///< mm
  int flat_ = 2;                                    ///< axis without cells
  std::array<int, 3> count_{1, 1, 1};
};

bool share_node(const SheetEdge& e, const SheetEdge& g) {
  return e.a == g.a || e.a == g.b || e.b == g.a || e.b == g.b;
}

/// Whether edges of one sheet that share no node are neighbours all the same.
bool neighbours(const SheetEdge& e, const SheetEdge& g, const SelfEdges& self) {
  return edge_distance({e.a, e.b}, self.x0, {g.a, g.b}, self.x0) < self.apart;
}

/// The edges with these numbers in ascending order of their patches, and of their numbers in each.
std::vector<std::int32_t> by_patch(const SheetEdges& edges, std::span<const std::int32_t> some) {
  std::vector<std::int32_t> next(edges.patch_nodes.size() + 1, 0);
  for (const std::int32_t e : some)
    ++next[edges.patch[e] + 1];
  std::partial_sum(next.begin(), next.end(), next.begin());
  std::vector<std::int32_t> sorted(some.size());
  for (const std::int32_t e : some)
    sorted[next[edges.patch[e]]++] = e;
  return sorted;
}

/// An edge of a and one of b within reach, and its gap, mm.
struct Found {
  std::int32_t patch_b;
  std::array<std::int32_t, 2> edge;
  double gap;
};

/// Pairs of edges of one patch of a, by patches of b: there are few, and found again and again.
class FoundByPatch {
public:
  void clear() { used_ = 0; }
  void add(const Found& f) {
    std::size_t i = last_;
    if (i >= used_ || patches_[i].patch_b != f.patch_b) {
      i = 0;
      while (i < used_ && patches_[i].patch_b != f.patch_b)
        ++i;
    }
    last_ = i;
    if (i == used_) start(f.patch_b);
    patches_[i].pairs.push_back(f);
  }
  /// Calls visit(pairs) for each patch of b in ascending order; pairs: ascending by their edges,
  /// each once.
  template <class Visit>
  void visit(const Visit& visit) {
    const auto end = patches_.begin() + static_cast<std::ptrdiff_t>(used_);
    std::sort(patches_.begin(), end,
              [](const Patch& p, const Patch& q) { return p.patch_b < q.patch_b; });
    for (auto patch = patches_.begin(); patch != end; ++patch) {
      sort_unique(patch->pairs);
      visit(patch->pairs);
    }
  }

private:
  struct Patch {
    std::int32_t patch_b;
    std::vector<Found> pairs;
  };

  void start(std::int32_t patch_b) {
    if (used_ == patches_.size()) patches_.emplace_back();
    patches_[used_].patch_b = patch_b;
    patches_[used_++].pairs.clear();
  }

  /// By insertion, as pairs come nearly in order: by edges of a, few of each.
  static void sort_unique(std::vector<Found>& pairs) {
    for (std::size_t i = 1; i < pairs.size(); ++i) {
      const Found f = pairs[i];
      std::size_t to = i;
      for (; to > 0 && f.edge < pairs[to - 1].edge; --to)
        pairs[to] = pairs[to - 1];
      pairs[to] = f;
    }
    const auto same = [](const Found& f, const Found& g) { return f.edge == g.edge; };
    pairs.erase(std::unique(pairs.begin(), pairs.end(), same), pairs.end());
  }

  std::vector<Patch> patches_;
  std::size_t used_ = 0, last_ = 0;
};

/// Appends the groups of one patch of a, from its pairs within reach.
void append_groups(EdgeEdgeContact& contact, std::int32_t patch_a, FoundByPatch& found) {
  found.visit([&](const std::vector<Found>& pairs) {
    EdgeGroup group;
    group.patch = {patch_a, pairs.front().patch_b};
    group.first = static_cast<std::int32_t>(contact.candidates.size());
    group.free_until = pairs.front().gap;
    for (const Found& f : pairs) {
      contact.candidates.push_back({f.edge, rounded_down(f.gap)});
      group.free_until = std::min(group.free_until, double{contact.candidates.back().free_until});
    }
    group.end = static_cast<std::int32_t>(contact.candidates.size());
    contact.groups.push_back(group);
  });
}

using EdgeNumbers = std::array<std::int32_t, 2>;

/// Those of these edges that are ridges.
std::vector<std::int32_t> ridges_of(const EdgeSheet& sheet, std::span<const std::int32_t> some) {
  std::vector<std::int32_t> ridges;
  ridges.reserve(some.size());
  for (const std::int32_t e : some)
    if (sheet.ridge_sides.empty() || sheet.ridge_sides[e] != no_ridge) ridges.push_back(e);
  return ridges;
}

/// Whether two edges may be ridges towards each other.
class Facing {
public:
  Facing(const EdgeSheet& a, const EdgeSheet& b, std::span<const std::int32_t> ridges_b)
      : a_(a), b_(b) {
    if (!asked()) return;
    normal_b_.resize(b.edges.all.size());
    for (const std::int32_t e : ridges_b)
      normal_b_[e] = edge_normal(b.edges.all[e], b.state.x);
  }
  bool asked() const { return !a_.ridge_sides.empty() && !b_.ridge_sides.empty(); }
  /// To be called before it is asked about pairs of this edge of a.
  void set_edge(std::int32_t e) {
    one_ = e;
    if (asked()) normal_a_ = edge_normal(a_.edges.all[e], a_.state.x);
  }
  bool operator()(std::int32_t other) const {
    return !asked() ||
           may_face(a_.ridge_sides[one_], normal_a_, b_.ridge_sides[other], normal_b_[other]);
  }

private:
  const EdgeSheet &a_, &b_;
  std::vector<Vec3> normal_b_; ///< of its ridges
  Vec3 normal_a_ = Vec3::Zero();
  std::int32_t one_ = 0;
};

/// The edges of the pairs that are followed, in their order.
std::vector<EdgeNumbers> followed_edges(const EdgeEdgeContact& contact) {
  std::vector<EdgeNumbers> edges;
  for (const EdgePair& pair : contact.pairs)
    edges.push_back(contact.candidates[pair.candidate].edge);
  return edges;
}

/// A pair that is closed stays a candidate until it opens, whether its edges are ridges or not.
struct ClosedPairs {
  std::vector<Found> pairs;       ///< in the order of the pairs followed
  std::vector<std::int32_t> of_a; ///< their edges of a, ascending
};

ClosedPairs closed_pairs(const EdgeEdgeContact& contact, const EdgeSheet& b,
                         std::span<const EdgeNumbers> edges) {
  ClosedPairs closed;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const double gap = contact.pairs[i].distance - contact.distance;
    if (gap >= 0.0) continue;
    closed.pairs.push_back({b.edges.patch[edges[i][1]], edges[i], gap});
    closed.of_a.push_back(edges[i][0]);
  }
  std::sort(closed.of_a.begin(), closed.of_a.end());
  return closed;
}

/// Gives the pairs of before the search the numbers of their candidates, and drops those without.
/// edges: theirs, in the order of the pairs.
void renumber_pairs(EdgeEdgeContact& contact, const EdgeSheet& a, const EdgeSheet& b,
                    std::span<const std::array<std::int32_t, 2>> edges) {
  const auto key = [&](const std::array<std::int32_t, 2>& edge) {
    return std::tuple(a.edges.patch[edge[0]], b.edges.patch[edge[1]], edge);
  };
  auto next = contact.candidates.begin();
  std::size_t kept = 0;
  for (std::size_t i = 0; i < edges.size(); ++i) { // both are in ascending order of their keys
    next = std::lower_bound(
        next, contact.candidates.end(), key(edges[i]),
        [&key](const EdgeCandidate& c, const auto& wanted) { return key(c.edge) < wanted; });
    if (next == contact.candidates.end() || next->edge != edges[i]) continue;
    contact.pairs[kept] = contact.pairs[i];
    contact.pairs[kept++].candidate = static_cast<std::int32_t>(next - contact.candidates.begin());
  }
  contact.pairs.resize(kept);
}

} // namespace

void find_edge_pairs(EdgeEdgeContact& contact, const EdgeSheet& a,
                     std::span<const std::int32_t> some_a, const EdgeSheet& b,
                     std::span<const std::int32_t> some_b, double skin, const SelfEdges& self) {
  const std::vector<EdgeNumbers> followed = followed_edges(contact);
  const ClosedPairs closed = closed_pairs(contact, b, followed);
  contact.candidates.clear();
  contact.groups.clear();
  const std::vector<std::int32_t> ridges_a = ridges_of(a, some_a), ridges_b = ridges_of(b, some_b);
  const EdgeGrid grid(b, ridges_b);
  Facing faces(a, b, ridges_b);
  std::vector<std::int32_t> all_a;
  std::set_union(ridges_a.begin(), ridges_a.end(), closed.of_a.begin(), closed.of_a.end(),
                 std::back_inserter(all_a));
  all_a.erase(std::unique(all_a.begin(), all_a.end()), all_a.end());
  const std::vector<std::int32_t> sorted = by_patch(a.edges, all_a);
  const bool one_sheet = !self.x0.empty();
  std::vector<EdgeNumbers> near;
  std::vector<std::array<std::int32_t, 4>> nodes;
  std::vector<EdgeEdgeDistance> distances;
  FoundByPatch found;
  for (auto e = sorted.begin(); e != sorted.end();) { // a patch at a time
    const std::int32_t patch = a.edges.patch[*e];
    near.clear();
    nodes.clear();
    found.clear();
    for (; e != sorted.end() && a.edges.patch[*e] == patch; ++e) {
      const SheetEdge& edge = a.edges.all[*e];
      faces.set_edge(*e);
      grid.visit(edge_box(edge, a.state.x, contact.distance + skin), [&](std::int32_t other) {
        if (one_sheet && (other <= *e || share_node(edge, b.edges.all[other]))) return;
        if (!faces(other)) return;
        near.push_back({*e, other});
        nodes.push_back({edge.a, edge.b, b.edges.all[other].a, b.edges.all[other].b});
      });
    }
    measure_edges(nodes, a.state.x, b.state.x, distances);
    for (std::size_t i = 0; i < near.size(); ++i) {
      const double gap = distances[i].distance - contact.distance;
      if (gap > skin) continue; // the boxes intersect, the edges are further apart
      const auto [one, other] = near[i];
      if (one_sheet && neighbours(a.edges.all[one], b.edges.all[other], self)) continue;
      found.add({b.edges.patch[other], near[i], gap});
    }
    for (const Found& f : closed.pairs)
      if (a.edges.patch[f.edge[0]] == patch) found.add(f);
    append_groups(contact, patch, found);
  }
  contact.candidates.shrink_to_fit(); // the longest list of a scene
  renumber_pairs(contact, a, b, followed);
}

} // namespace plyform
