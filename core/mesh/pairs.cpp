// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/pairs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace plyform {
namespace {

/// A side shared by two triangles.
struct SharedSide {
  double length2;
  std::int32_t a, b; ///< triangles, a < b
};

std::vector<SharedSide> shared_sides(const BlankMesh& mesh) {
  struct Side {
    std::int32_t low, high, triangle;
  };
  std::vector<Side> sides;
  for (std::size_t e = 0; e < mesh.triangles.size(); ++e)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t i = mesh.triangles[e][k], j = mesh.triangles[e][(k + 1) % 3];
      sides.push_back({std::min(i, j), std::max(i, j), static_cast<std::int32_t>(e)});
    }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::array{a.low, a.high, a.triangle} < std::array{b.low, b.high, b.triangle};
  });
  std::vector<SharedSide> shared;
  for (std::size_t i = 1; i < sides.size(); ++i) {
    if (sides[i].low != sides[i - 1].low || sides[i].high != sides[i - 1].high) continue;
    const Vec2 d = mesh.x[sides[i].high] - mesh.x[sides[i].low];
    shared.push_back({d.squaredNorm(), sides[i - 1].triangle, sides[i].triangle});
  }
  // Longest first. Lengths are compared as floats, so that those equal up to rounding keep the
  // order of the mesh; else a uniform mesh would be paired irregularly.
  std::stable_sort(shared.begin(), shared.end(), [](const SharedSide& s, const SharedSide& t) {
    return static_cast<float>(s.length2) > static_cast<float>(t.length2);
  });
  return shared;
}

/// The neighbours of each triangle across its sides, -1 if there is none.
using Neighbours = std::vector<std::array<std::int32_t, 3>>;

Neighbours neighbours_of(std::size_t triangles, const std::vector<SharedSide>& sides) {
  Neighbours beside(triangles, {-1, -1, -1});
  const auto add = [&beside](std::int32_t to, std::int32_t from) {
    auto& list = beside[from];
    *std::find(list.begin(), list.end() - 1, -1) = to;
  };
  for (const SharedSide& s : sides)
    add(s.a, s.b), add(s.b, s.a);
  return beside;
}

/// Pairs two single triangles by re-pairing the triangles on a chain between them: an augmenting
/// path of matching theory, by breadth-first search from `single`, in which a neighbour v of the
/// end of the chain is separated from its mate w, and w becomes the new end. Odd cycles of
/// triangles (blossoms) are not treated, so that very few possible pairs are missed.
class ChainSearch {
public:
  ChainSearch(const Neighbours& neighbours, std::vector<std::int32_t>& mates)
      : beside(neighbours), mate(mates), seen(mates.size(), -1), from(mates.size(), -1) {}

  void pair_up(std::int32_t single) {
    // triangles visited at most, to limit the time of a search without result
    constexpr std::size_t farthest = 2000;
    std::vector<std::int32_t> ends{single};
    seen[at(single)] = single;
    for (std::size_t i = 0; i < ends.size() && i < farthest; ++i)
      for (const std::int32_t v : beside[at(ends[i])]) {
        if (v < 0 || seen[at(v)] == single) continue;
        seen[at(v)] = single;
        from[at(v)] = ends[i];
        const std::int32_t w = mate[at(v)];
        if (w < 0) return shift(v, single);
        if (seen[at(w)] == single) continue;
        seen[at(w)] = single;
        ends.push_back(w);
      }
  }

private:
  static std::size_t at(std::int32_t e) { return static_cast<std::size_t>(e); }

  /// Re-pairs the chain: v with the end it was reached from, that end's former mate with the end
  /// before it, and so on to `single`.
  void shift(std::int32_t v, std::int32_t single) {
    for (;;) {
      const std::int32_t end = from[at(v)], next = mate[at(end)];
      mate[at(v)] = end;
      mate[at(end)] = v;
      if (end == single) return;
      v = next;
    }
  }

  const Neighbours& beside;
  std::vector<std::int32_t>& mate;
  std::vector<std::int32_t> seen, from; ///< per triangle: search that visited it last; end of the
                                        ///< chain that it was reached from
};

} // namespace

StrainGroups single_triangles(std::size_t triangles) {
  StrainGroups p;
  p.triangles.resize(triangles);
  std::iota(p.triangles.begin(), p.triangles.end(), 0);
  p.begin.resize(triangles + 1);
  std::iota(p.begin.begin(), p.begin.end(), 0);
  return p;
}

std::vector<char> along_fibres(const BlankMesh& mesh, std::span<const double> yarns) {
  constexpr double parallel = 1e-3; // rad
  const auto along = [&](const Triangle& t, double angle) {
    const Vec2 f(std::cos(angle), std::sin(angle));
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 side = mesh.x[t[(k + 1) % 3]] - mesh.x[t[k]];
      if (std::abs(side.x() * f.y() - side.y() * f.x()) <= parallel * side.norm()) return true;
    }
    return false;
  };
  std::vector<char> aligned;
  for (const Triangle& t : mesh.triangles)
    aligned.push_back(
        std::all_of(yarns.begin(), yarns.end(), [&](double angle) { return along(t, angle); }));
  std::vector<char> inside = aligned;
  for (const SharedSide& s : shared_sides(mesh)) {
    const auto a = static_cast<std::size_t>(s.a), b = static_cast<std::size_t>(s.b);
    if (!aligned[a]) inside[b] = 0;
    if (!aligned[b]) inside[a] = 0;
  }
  std::vector<char> near(mesh.x.size(), 0);
  for (std::size_t e = 0; e < inside.size(); ++e)
    for (const int n : mesh.triangles[e])
      if (inside[e]) near[n] = 1;
  for (std::size_t e = 0; e < inside.size(); ++e)
    for (const int n : mesh.triangles[e])
      if (near[n]) inside[e] = 1;
  return inside;
}

StrainGroups pair_triangles(const BlankMesh& mesh, const std::vector<char>& alone) {
  std::vector<SharedSide> sides = shared_sides(mesh);
  if (!alone.empty())
    std::erase_if(sides, [&alone](const SharedSide& s) { return alone[s.a] || alone[s.b]; });
  std::vector<std::int32_t> mate(mesh.triangles.size(), -1);
  for (const SharedSide& s : sides) {
    auto &a = mate[s.a], &b = mate[s.b];
    if (a < 0 && b < 0) a = s.b, b = s.a;
  }
  const Neighbours beside = neighbours_of(mate.size(), sides);
  ChainSearch search(beside, mate);
  for (std::size_t e = 0; e < mate.size(); ++e)
    if (mate[e] < 0) search.pair_up(static_cast<std::int32_t>(e));
  StrainGroups result;
  result.begin.push_back(0);
  for (std::size_t e = 0; e < mate.size(); ++e) {
    const auto own = static_cast<std::int32_t>(e);
    if (mate[e] >= 0 && mate[e] < own) continue;
    result.triangles.push_back(own);
    if (mate[e] >= 0) result.triangles.push_back(mate[e]);
    result.begin.push_back(static_cast<std::int32_t>(result.triangles.size()));
  }
  return result;
}

} // namespace plyform
