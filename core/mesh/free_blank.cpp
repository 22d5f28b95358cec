// SPDX-License-Identifier: GPL-3.0-or-later
// Free meshes of whole outlines, with elements of one size or of that which zones and grid ask for.
#include "core/mesh/mesher_parts.hpp"
#include "core/mesh/size_field.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>

namespace plyform {
namespace {

/// The mesher bounds the longest edge; measured on squares, circles and pierced polygons, 1.42 h
/// gives a mean edge within 2 % of h.
constexpr double longest_over_mean = 1.42;
/// rad; up to 20.7 degrees the termination of the mesher is proven.
constexpr double free_angle = 20.5 * degree;

/// A piece of the rim from x to the next piece's, on an arc about `centre` or straight.
struct RimPiece {
  Vec2 x;
  std::optional<Vec2> centre;
};

/// The pieces of one loop, end to end.
using Rim = std::vector<RimPiece>;

Rim rim_of(const BlankSpec& spec, int hole) {
  Rim rim;
  for (const SampledSide& side : sample_sides(spec.outline, hole, spec.element_size, coarsest_turn))
    for (const Vec2& x : side.points)
      rim.push_back({x, side.arc ? std::optional(side.arc->centre) : std::nullopt});
  return rim;
}

Vec2 middle_of_piece(const RimPiece& piece, const Vec2& end) {
  return piece.centre ? middle_on_arc(piece.x, end, *piece.centre) : Vec2(0.5 * (piece.x + end));
}

/// Halves the pieces for which too_long(first, middle, end) holds, until there are none.
template <class TooLong>
Rim halved(const Rim& rim, const TooLong& too_long) {
  Rim finer;
  bool any = false;
  for (std::size_t k = 0; k < rim.size(); ++k) {
    const Vec2& end = rim[(k + 1) % rim.size()].x;
    const Vec2 middle = middle_of_piece(rim[k], end);
    finer.push_back(rim[k]);
    if (!too_long(rim[k], middle, end)) continue;
    finer.push_back({middle, rim[k].centre});
    any = true;
  }
  return any ? halved(finer, too_long) : finer;
}

Region region_of(const std::vector<Rim>& loops) {
  Region region;
  for (const Rim& rim : loops) {
    const auto first = static_cast<std::int32_t>(region.x.size());
    for (const RimPiece& piece : rim)
      region.x.push_back(piece.x);
    const auto last = static_cast<std::int32_t>(region.x.size());
    for (std::int32_t n = first; n < last; ++n)
      region.edges.push_back({n, n + 1 < last ? n + 1 : first});
  }
  return region;
}

/// Halves pieces of arcs that the mesher has split, at the middle of their chord; false if there
/// are none.
bool halve_split_arcs(std::vector<Rim>& loops, const BlankMesh& mesh) {
  std::set<Edge> sides; // of the mesh, both ways
  for (const Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      sides.insert({t[k], t[(k + 1) % 3]}), sides.insert({t[(k + 1) % 3], t[k]});
  bool any = false;
  std::int32_t number = 0; // of a piece's first node in the region
  for (Rim& rim : loops) {
    const std::int32_t first = number;
    Rim finer;
    for (std::size_t k = 0; k < rim.size(); ++k, ++number) {
      finer.push_back(rim[k]);
      const std::int32_t end = k + 1 < rim.size() ? number + 1 : first;
      if (!rim[k].centre || sides.contains({number, end})) continue;
      finer.push_back({middle_of_piece(rim[k], rim[(k + 1) % rim.size()].x), rim[k].centre});
      any = true;
    }
    rim = std::move(finer);
  }
  return any;
}

BlankMesh graded_free_blank(const BlankSpec& spec) {
  const SizeField field = make_size_field(spec);
  std::vector<Rim> loops;
  for (int k = -1; k < static_cast<int>(spec.outline.holes.size()); ++k)
    loops.push_back(halved(rim_of(spec, k), [&](const RimPiece& p, const Vec2& m, const Vec2& q) {
      const double wanted = least_wanted(field, {p.x, m, q});
      return wanted < field.largest && (q - p.x).norm() > std::numbers::sqrt2 * wanted;
    }));
  const auto longest_side = [&](const std::array<Vec2, 3>& triangle) {
    return longest_over_mean * least_wanted(field, triangle);
  };
  for (int round = 0;; ++round) {
    constexpr int most_rounds = 8; // what is split then still stays on its chord
    BlankMesh mesh = refine(region_of(loops), free_angle, longest_side);
    if (round == most_rounds || !halve_split_arcs(loops, mesh)) return mesh;
  }
}

} // namespace

BlankMesh free_blank(const BlankSpec& spec) {
  if (is_graded(spec)) return graded_free_blank(spec);
  return refine(sample_outline(spec.outline, spec.element_size), free_angle,
                longest_over_mean * spec.element_size);
}

} // namespace plyform
