// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solver/follow_folds.hpp"

#include "core/solver/contact_search.hpp"
#include "core/solver/edge_contact_search.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

/// Numbers of the edges that are ridges towards a side now, and were not before.
std::vector<std::int32_t> new_ridges(std::span<const char> before, std::span<const char> now) {
  std::vector<std::int32_t> grown;
  for (std::size_t i = 0; i < now.size(); ++i)
    if ((now[i] & ~before[i]) != 0) grown.push_back(static_cast<std::int32_t>(i));
  return grown;
}

/// Renews the fold bounds of a ply when one of its sides may have turned by half of fold_margin:
/// both nodes of a side are in one patch. element_size: mm.
void follow_fold_bounds(PlyBody& ply, double element_size) {
  double furthest = 0.0; // mm
  for (const Box3& patch : ply.patch_motion)
    furthest = std::max(furthest, patch.sizes().squaredNorm());
  ply.fold_motion += std::sqrt(furthest);
  if (ply.fold_motion > 0.5 * fold_margin * element_size) renew_fold_bounds(ply);
}

} // namespace

void follow_folds(Layup& layup, PlyContacts& contacts, ThreadPool& pool, bool searched) {
  if (contacts.ply_pairs.empty()) return;
  std::vector<std::vector<std::int32_t>> grown(layup.plies.size());
  pool.run(static_cast<int>(layup.plies.size()), [&](int p) {
    PlyBody& ply = layup.plies[p];
    patch_motions(ply.edges, ply.motion, ply.patch_motion);
    if (searched) return;
    const Stopwatch watch(ply.search_seconds);
    follow_fold_bounds(ply, layup.element_size);
    if (follow_ridges(ply.edges, ply.x, ply.patch_motion, ply.ridge_limit, ply.ridges)) return;
    const std::vector<char> before = ply.ridges.sides;
    find_ridges(ply.edges, ply.x, ply.ridge_limit, ply.ridges);
    grown[static_cast<std::size_t>(p)] = new_ridges(before, ply.ridges.sides);
  });
  std::vector<PlyEdgeContact*> due;
  each_edge_contact(contacts, [&](PlyEdgeContact& pair) {
    if (!grown[at(pair.a)].empty() || !grown[at(pair.b)].empty()) due.push_back(&pair);
  });
  pool.run(static_cast<int>(due.size()), [&](int i) {
    PlyEdgeContact& pair = *due[static_cast<std::size_t>(i)];
    search_new_ridges(layup, pair, grown[at(pair.a)], grown[at(pair.b)]);
  });
}

} // namespace plyform
