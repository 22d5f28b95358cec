// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/bisection.hpp"

#include "core/mesh/mesher_parts.hpp"

#include <algorithm>
#include <tuple>

namespace plyform {
namespace {

/// The number (0 to 2) of the longest side, by length and node numbers.
std::size_t longest_of(const BlankMesh& mesh, const Triangle& t) {
  const auto key = [&](std::size_t k) {
    const SideNodes side = side_of(t, k);
    const double length2 = (mesh.x[at(side.second)] - mesh.x[at(side.first)]).squaredNorm();
    return std::tuple(-static_cast<float>(length2), side);
  };
  std::size_t longest = 0;
  for (const std::size_t k : {std::size_t{1}, std::size_t{2}})
    if (key(k) < key(longest)) longest = k;
  return longest;
}

/// Sides by number: those of each triangle, and the triangles beside each, -1 beyond the rim.
struct SideTable {
  std::vector<std::array<std::int32_t, 3>> of_triangle;
  std::vector<std::array<std::int32_t, 2>> beside;
};

SideTable number_sides(const std::vector<Triangle>& triangles) {
  struct Entry {
    SideNodes side;
    std::int32_t triangle, k;
  };
  std::vector<Entry> entries;
  entries.reserve(3 * triangles.size());
  for (std::size_t e = 0; e < triangles.size(); ++e)
    for (std::size_t k = 0; k < 3; ++k)
      entries.push_back(
          {side_of(triangles[e], k), static_cast<std::int32_t>(e), static_cast<std::int32_t>(k)});
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return std::tie(a.side, a.triangle) < std::tie(b.side, b.triangle);
  });
  SideTable table{std::vector<std::array<std::int32_t, 3>>(triangles.size()), {}};
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (i == 0 || entries[i].side != entries[i - 1].side)
      table.beside.push_back({entries[i].triangle, -1});
    else
      table.beside.back()[1] = entries[i].triangle;
    table.of_triangle[at(entries[i].triangle)][at(entries[i].k)] =
        static_cast<std::int32_t>(table.beside.size()) - 1;
  }
  return table;
}

/// The sides to cut, by a mark each: those of the marked triangles, and then, until there are none,
/// those of triangles with a marked side and another one at which they are cut first.
std::vector<char> sides_to_cut(const Bisection& b, const SideTable& sides,
                               const std::vector<char>& marked) {
  std::vector<char> cut(sides.beside.size(), 0);
  std::vector<std::int32_t> todo;
  for (std::size_t e = 0; e < marked.size(); ++e)
    if (marked[e]) todo.push_back(static_cast<std::int32_t>(e));
  while (!todo.empty()) {
    const std::size_t e = at(todo.back());
    todo.pop_back();
    const std::size_t side = at(sides.of_triangle[e][b.cut_side[e]]);
    if (cut[side]) continue;
    cut[side] = 1;
    for (const std::int32_t beside : sides.beside[side])
      if (beside >= 0) todo.push_back(beside);
  }
  return cut;
}

/// The middle of a side, mm; on the arc, if it stands for a piece of one. Its halves then do too.
Vec2 middle_of(Bisection& b, const SideNodes& side, std::int32_t number) {
  const Vec2 &p = b.mesh.x[at(side.first)], &q = b.mesh.x[at(side.second)];
  const auto arc = b.arc_centre.find(side);
  if (arc == b.arc_centre.end()) return 0.5 * (p + q);
  const Vec2 centre = arc->second;
  b.arc_centre.erase(arc);
  b.arc_centre.emplace(SideNodes(side.first, number), centre); // numbers of new nodes are higher
  b.arc_centre.emplace(SideNodes(side.second, number), centre);
  return middle_on_arc(p, q, centre);
}

/// Triangles of the next mesh, with all that is known of each.
struct Cutter {
  const std::map<SideNodes, std::int32_t>& middles;
  Bisection& out;
  std::vector<char>& fresh;

  /// Appends the triangle, or its halves where its side k has a node in the middle; halves are cut
  /// likewise at their sides of the old mesh.
  void append(const Triangle& t, std::size_t k, std::size_t generation, bool half) {
    const auto middle = middles.find(side_of(t, k));
    if (middle == middles.end()) {
      out.mesh.triangles.push_back(t);
      out.cut_side.push_back(static_cast<std::uint8_t>(k));
      out.generation.push_back(static_cast<std::uint8_t>(generation));
      fresh.push_back(half);
      return;
    }
    const std::int32_t a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3], m = middle->second;
    append({c, a, m}, 0, generation + 1, true); // side c a
    append({b, c, m}, 0, generation + 1, true);
  }
};

} // namespace

Bisection start_bisection(BlankMesh mesh) {
  Bisection b{std::move(mesh), {}, {}, {}};
  for (const Triangle& t : b.mesh.triangles)
    b.cut_side.push_back(static_cast<std::uint8_t>(longest_of(b.mesh, t)));
  b.generation.assign(b.mesh.triangles.size(), 0);
  return b;
}

std::vector<char> bisect(Bisection& b, const std::vector<char>& marked) {
  const SideTable sides = number_sides(b.mesh.triangles);
  const std::vector<char> cut = sides_to_cut(b, sides, marked);
  std::map<SideNodes, std::int32_t> middles;
  for (std::size_t e = 0; e < b.mesh.triangles.size(); ++e) {
    if (!cut[at(sides.of_triangle[e][b.cut_side[e]])]) continue;
    const SideNodes side = side_of(b.mesh.triangles[e], b.cut_side[e]);
    const auto number = static_cast<std::int32_t>(b.mesh.x.size());
    if (!middles.emplace(side, number).second) continue;
    b.mesh.x.push_back(middle_of(b, side, number));
  }
  const Bisection before{
      {{}, std::move(b.mesh.triangles)}, std::move(b.cut_side), std::move(b.generation), {}};
  b.mesh.triangles.clear(), b.cut_side.clear(), b.generation.clear();
  std::vector<char> fresh;
  Cutter cutter{middles, b, fresh};
  for (std::size_t e = 0; e < before.mesh.triangles.size(); ++e)
    cutter.append(before.mesh.triangles[e], before.cut_side[e], before.generation[e], false);
  return fresh;
}

} // namespace plyform
