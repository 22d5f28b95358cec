// SPDX-License-Identifier: GPL-3.0-or-later
// Search for pairs of edges of two sheets that are close to each other.
#include "contact/forces/edge_edge.hpp"
#include "contact/search/edge_grid.hpp"

#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

namespace plyform {
namespace {

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

/// Candidates and their groups, as EdgeEdgeContact has them.
struct Listed {
  std::vector<EdgeCandidate> candidates;
  std::vector<EdgeGroup> groups;
};

/// Begins a group of these patches with the next candidate.
EdgeGroup& begin_group(Listed& to, const std::array<std::int32_t, 2>& patch) {
  EdgeGroup& group = to.groups.emplace_back();
  group.patch = patch;
  group.first = group.end = static_cast<std::int32_t>(to.candidates.size());
  group.free_until = std::numeric_limits<double>::infinity();
  return group;
}

void append(Listed& to, EdgeGroup& group, const EdgeCandidate& candidate) {
  to.candidates.push_back(candidate);
  ++group.end;
  group.free_until = std::min(group.free_until, double{candidate.free_until});
}

/// Appends the groups of one patch of a, from its pairs within reach.
void append_groups(Listed& to, std::int32_t patch_a, FoundByPatch& found) {
  found.visit([&](const std::vector<Found>& pairs) {
    EdgeGroup& group = begin_group(to, {patch_a, pairs.front().patch_b});
    for (const Found& f : pairs)
      append(to, group, {f.edge, rounded_down(f.gap)});
  });
}

/// Adds `more`, whose path lengths begin now, to the candidates of a contact, in their order. Those
/// that it has already stay as they are.
void merge(EdgeEdgeContact& contact, const Listed& more) {
  if (more.groups.empty()) return;
  Listed all;
  all.candidates.reserve(contact.candidates.size() + more.candidates.size());
  all.groups.reserve(contact.groups.size() + more.groups.size());
  // of the same patches, or without candidates where the one or the other has none
  const auto join = [&](const EdgeGroup& old, const EdgeGroup& next) {
    EdgeGroup& group = begin_group(all, old.first < old.end ? old.patch : next.patch);
    group.path_length = old.path_length, group.ahead = old.ahead;
    std::int32_t i = old.first;
    for (std::int32_t k = next.first; k < next.end; ++k) {
      EdgeCandidate candidate = more.candidates[at(k)];
      for (; i < old.end && contact.candidates[at(i)].edge < candidate.edge; ++i)
        append(all, group, contact.candidates[at(i)]);
      if (i < old.end && contact.candidates[at(i)].edge == candidate.edge) continue;
      candidate.free_until = rounded_down(group.path_length + double{candidate.free_until});
      append(all, group, candidate);
    }
    for (; i < old.end; ++i)
      append(all, group, contact.candidates[at(i)]);
  };
  auto old = contact.groups.begin();
  for (const EdgeGroup& next : more.groups) {
    for (; old != contact.groups.end() && old->patch < next.patch; ++old)
      join(*old, {});
    const bool known = old != contact.groups.end() && old->patch == next.patch;
    join(known ? *old++ : EdgeGroup{}, next);
  }
  for (; old != contact.groups.end(); ++old)
    join(*old, {});
  contact.candidates = std::move(all.candidates);
  contact.groups = std::move(all.groups);
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

/// Whether an edge of a and one of b may be ridges towards each other. Their normals are computed
/// when they are first asked for.
class Facing {
public:
  Facing(const EdgeSheet& a, const EdgeSheet& b) : a_(a), b_(b) {
    if (asked()) normals_b_.resize(b.edges.all.size(), Vec3::Zero());
  }
  bool asked() const { return !a_.ridge_sides.empty() && !b_.ridge_sides.empty(); }
  /// To be called before it is asked about pairs of this edge of a.
  void set_edge(std::int32_t e) {
    one_ = e;
    normal_a_ = Vec3::Zero();
  }
  bool operator()(std::int32_t other) {
    return !asked() || may_face(a_.ridge_sides[one_], normal_of(a_, one_, normal_a_),
                                b_.ridge_sides[other], normal_of(b_, other, normals_b_[at(other)]));
  }

private:
  /// `known`: zero before it is known.
  static const Vec3& normal_of(const EdgeSheet& sheet, std::int32_t e, Vec3& known) {
    if (known.isZero(0.0)) known = edge_normal(sheet.edges, sheet.edges.all[e], sheet.state.x);
    return known;
  }

  const EdgeSheet &a_, &b_;
  std::vector<Vec3> normals_b_; ///< of its ridges
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

/// Ascending numbers that are in both lists, which are ascending.
std::vector<std::int32_t> common(std::span<const std::int32_t> one,
                                 std::span<const std::int32_t> other) {
  std::vector<std::int32_t> both;
  std::set_intersection(one.begin(), one.end(), other.begin(), other.end(),
                        std::back_inserter(both));
  return both;
}

/// Lists the pairs of these edges of a and b, ascending, that are within contact.distance + skin
/// (mm) and may be ridges towards each other, and those that are closed.
Listed near_pairs(const EdgeEdgeContact& contact, const EdgeSheet& a,
                  std::span<const std::int32_t> of_a, const EdgeSheet& b,
                  std::span<const std::int32_t> of_b, double skin, const SelfEdges& self,
                  const ClosedPairs& closed) {
  Listed listed;
  const EdgeGrid grid(b.edges.all, b.state.x, of_b);
  Facing faces(a, b);
  std::vector<std::int32_t> all_a;
  std::set_union(of_a.begin(), of_a.end(), closed.of_a.begin(), closed.of_a.end(),
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
    append_groups(listed, patch, found);
  }
  return listed;
}

} // namespace

void find_edge_pairs(EdgeEdgeContact& contact, const EdgeSheet& a,
                     std::span<const std::int32_t> some_a, const EdgeSheet& b,
                     std::span<const std::int32_t> some_b, double skin, const SelfEdges& self) {
  const std::vector<EdgeNumbers> followed = followed_edges(contact);
  const ClosedPairs closed = closed_pairs(contact, b, followed);
  Listed listed =
      near_pairs(contact, a, ridges_of(a, some_a), b, ridges_of(b, some_b), skin, self, closed);
  listed.candidates.shrink_to_fit(); // the longest list of a scene
  contact.candidates = std::move(listed.candidates);
  contact.groups = std::move(listed.groups);
  renumber_pairs(contact, a, b, followed);
}

void add_edge_pairs(EdgeEdgeContact& contact, const EdgeSheet& a,
                    std::span<const std::int32_t> some_a, std::span<const std::int32_t> new_a,
                    const EdgeSheet& b, std::span<const std::int32_t> some_b,
                    std::span<const std::int32_t> new_b, double skin, const SelfEdges& self) {
  const std::vector<EdgeNumbers> followed = followed_edges(contact);
  const auto add = [&](std::span<const std::int32_t> of_a, std::span<const std::int32_t> of_b) {
    if (!of_a.empty() && !of_b.empty())
      merge(contact, near_pairs(contact, a, of_a, b, of_b, skin, self, {}));
  };
  add(common(some_a, new_a), ridges_of(b, some_b));
  add(ridges_of(a, some_a), common(some_b, new_b));
  renumber_pairs(contact, a, b, followed);
}

} // namespace plyform
