// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solver/edge_contact_search.hpp"

#include "core/solver/occlusion.hpp"
#include "core/solver/pass_through.hpp"

#include <algorithm>

namespace plyform {
namespace {

/// Numbers of the edges of a ply that may touch the ply `other`: all but those with both nodes
/// occluded, as of occluded_nodes.
std::vector<std::int32_t> open_edges(const Scene& s, int ply, int other, double reach) {
  const PlyState& body = s.plies[ply];
  const std::span<const char> occluded = occluded_nodes(s, ply, other, reach);
  std::vector<std::int32_t> open;
  for (std::size_t i = 0; i < body.edges.all.size(); ++i) {
    const SheetEdge& e = body.edges.all[i];
    if (occluded.empty() || !occluded[e.a] || !occluded[e.b])
      open.push_back(static_cast<std::int32_t>(i));
  }
  return open;
}

} // namespace

void search_edges(Scene& s, PlyEdgeContact& pair, double moved) {
  const PlyState& a = s.plies[pair.a];
  const PlyState& b = s.plies[pair.b];
  const Stopwatch watch(pair.contact.time.search);
  const double skin = std::max(s.skin, step_displacement(s, pair.a) + step_displacement(s, pair.b));
  const double reach = pair.contact.distance + skin;
  std::vector<std::int32_t> open_a, open_b;
  if (may_meet(a.tree->bounds(), b.tree->bounds(), reach)) {
    open_a = open_edges(s, pair.a, pair.b, reach);
    open_b = open_edges(s, pair.b, pair.a, reach);
  }
  SelfEdges self; // the contact distance of edges is half that of nodes
  if (pair.a == pair.b) self = {a.x0, neighbourhood * 2.0 * pair.contact.distance};
  find_edge_pairs(pair.contact, a.edge_sheet(), open_a, b.edge_sheet(), open_b, skin + moved, self);
}

void follow_edges(Scene& s, ThreadPool& pool, bool searched) {
  if (s.edge_contacts.empty()) return;
  std::vector<char> grown(s.plies.size(), 0);
  pool.run(static_cast<int>(s.plies.size()), [&](int p) {
    PlyState& ply = s.plies[p];
    patch_motions(ply.edges, ply.motion, ply.patch_motion);
    if (searched || follow_ridges(ply.edges, ply.x, ply.patch_motion, ply.ridge_limit, ply.ridges))
      return;
    find_ridges(ply.edges, ply.x, ply.ridge_limit, ply.ridges);
    grown[static_cast<std::size_t>(p)] = 1;
  });
  std::vector<PlyEdgeContact*> due;
  for (PlyEdgeContact& pair : s.edge_contacts)
    if (grown[static_cast<std::size_t>(pair.a)] || grown[static_cast<std::size_t>(pair.b)])
      due.push_back(&pair);
  pool.run(static_cast<int>(due.size()), [&](int i) {
    PlyEdgeContact& pair = *due[static_cast<std::size_t>(i)];
    search_edges(s, pair, s.plies[pair.a].max_displacement + s.plies[pair.b].max_displacement);
  });
}

} // namespace plyform
