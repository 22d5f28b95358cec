// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/search/sheet_ridges.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plyform {
namespace {

constexpr double listed_share = 0.1, sharp_share = 0.25;

/// f and 2 (1/h_c + 1/h_d) of (G).
struct EdgeFold {
  double fold, per_mm;
};

EdgeFold fold_of(const SheetEdges& edges, const SheetEdge& e, std::span<const Vec3> x) {
  const Vec3 &a = x[e.a], along = x[e.b] - a;
  const bool inside = e.c >= 0 && e.d >= 0; // nearly all
  const auto [c, d] = inside ? std::array<Vec3, 2>{x[e.c], x[e.d]} : edges.third_nodes(e, x);
  const Vec3 one = along.cross(c - a), other = (d - a).cross(along);
  const double length = along.norm(), area1 = one.norm(), area2 = other.norm(); // twice the areas
  const double sine = one.cross(other).dot(along) / (area1 * area2 * length);
  const double fold = one.dot(other) < 0.0 ? std::copysign(1.0, sine) : sine;
  return {fold, 2.0 * length * (1.0 / area1 + 1.0 / area2)};
}

/// Sides towards which a fold exceeds a limit; of one that is not a number both.
char sides_beyond(double fold, double limit) {
  return static_cast<char>((fold <= limit ? no_ridge : ridge_up) |
                           (-fold <= limit ? no_ridge : ridge_down));
}

/// mm, the D that takes the fold to `limit` towards a side that is not among `sides`.
double room_of(const EdgeFold& f, char sides, double limit) {
  double least = std::numeric_limits<double>::max();
  if (!(sides & ridge_up)) least = limit - f.fold;
  if (!(sides & ridge_down)) least = std::min(least, limit + f.fold);
  return least / f.per_mm;
}

/// Sets `room` of a patch from the edges that are not ridges towards both sides; returns false if
/// one of them has grown beyond limit. fold(i): of edge i.
template <class Fold>
bool update_room(const SheetEdges& edges, std::size_t patch, const Fold& fold, double limit,
                 SheetRidges& ridges) {
  double room = std::numeric_limits<float>::max();
  for (const std::int32_t i : edges.patch_edges[patch])
    if (ridges.sides[i] != ridge_both)
      room = std::min(room, room_of(fold(i), ridges.sides[i], limit));
  ridges.room[patch] = rounded_down(room);
  return room > 0.0;
}

} // namespace

Vec3 edge_normal(const SheetEdges& edges, const SheetEdge& e, std::span<const Vec3> x) {
  const Vec3 &a = x[e.a], along = x[e.b] - a;
  const auto [c, d] = edges.third_nodes(e, x);
  Vec3 sum = Vec3::Zero();
  if (e.c != no_face) sum += along.cross(c - a).normalized();
  if (e.d != no_face) sum += (d - a).cross(along).normalized();
  return sum.normalized();
}

void find_ridges(const SheetEdges& edges, std::span<const Vec3> x, double limit,
                 SheetRidges& ridges) {
  ridges.sides.resize(edges.all.size());
  std::vector<EdgeFold> folds(edges.all.size()); // those of free edges stay 0
  std::vector<char> at_node(x.size(), no_ridge); // sides of the sharp ridges there
  for (std::size_t i = 0; i < edges.all.size(); ++i) {
    const SheetEdge& e = edges.all[i];
    if (!e.is_free()) folds[i] = fold_of(edges, e, x);
    const double fold = folds[i].fold;
    ridges.sides[i] = e.is_free() ? char{ridge_both} : sides_beyond(fold, listed_share * limit);
    const char sharp = sides_beyond(fold, sharp_share * limit);
    for (const std::int32_t n : {e.a, e.b})
      at_node[n] = static_cast<char>(at_node[n] | sharp);
  }
  for (std::size_t i = 0; i < edges.all.size(); ++i)
    ridges.sides[i] =
        static_cast<char>(ridges.sides[i] | at_node[edges.all[i].a] | at_node[edges.all[i].b]);
  ridges.room.resize(edges.patch_edges.size());
  for (std::size_t patch = 0; patch < ridges.room.size(); ++patch)
    update_room(
        edges, patch, [&](std::int32_t i) { return folds[i]; }, limit, ridges);
}

bool follow_ridges(const SheetEdges& edges, std::span<const Vec3> x,
                   std::span<const Box3> patch_motion, double limit, SheetRidges& ridges) {
  bool hold = true;
  const auto fold = [&](std::int32_t i) { return fold_of(edges, edges.all[i], x); };
  for (std::size_t patch = 0; patch < ridges.room.size(); ++patch) {
    float& room = ridges.room[patch];
    room = rounded_down(room - patch_motion[patch].diagonal().norm());
    if (!(room > 0.0F)) hold = update_room(edges, patch, fold, limit, ridges) && hold;
  }
  return hold;
}

bool may_face(char sides_a, const Vec3& n_a, char sides_b, const Vec3& n_b) {
  const double dot = n_a.dot(n_b);
  if (!(std::abs(dot) > 0.5)) return true; // at more than 60 degrees either side may be meant
  const auto swapped = static_cast<char>((sides_b & ridge_up ? ridge_down : no_ridge) |
                                         (sides_b & ridge_down ? ridge_up : no_ridge));
  return (sides_a & (dot > 0.0 ? swapped : sides_b)) != 0;
}

} // namespace plyform
