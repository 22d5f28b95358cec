// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solver/edge_contact_search.hpp"

#include "core/solver/occlusion.hpp"
#include "core/solver/pass_through.hpp"

#include <algorithm>

namespace plyform {
namespace {

/// Numbers of the edges of a ply that may touch the ply `other`: all but those with both nodes
/// occluded, as of occluded_nodes.
std::vector<std::int32_t> open_edges(const Layup& layup, int ply, int other, double reach) {
  const PlyBody& body = layup.plies[ply];
  const std::span<const char> occluded = occluded_nodes(layup, ply, other, reach);
  std::vector<std::int32_t> open;
  for (std::size_t i = 0; i < body.edges.all.size(); ++i) {
    const SheetEdge& e = body.edges.all[i];
    if (occluded.empty() || !occluded[e.a] || !occluded[e.b])
      open.push_back(static_cast<std::int32_t>(i));
  }
  return open;
}

/// What the search for edges of two plies asks for.
struct EdgeQuery {
  EdgeQuery(const Layup& layup, const PlyEdgeContact& pair)
      : a(layup.plies[pair.a]), b(layup.plies[pair.b]),
        skin(std::max(layup.skin,
                      step_displacement(layup, pair.a) + step_displacement(layup, pair.b))) {
    const double reach = pair.contact.distance + skin;
    if (may_meet(a.tree->bounds(), b.tree->bounds(), reach)) {
      open_a = open_edges(layup, pair.a, pair.b, reach);
      open_b = open_edges(layup, pair.b, pair.a, reach);
    }
    // the contact distance of edges is half that of nodes
    if (pair.a == pair.b) self = {a.x0, neighbourhood * 2.0 * pair.contact.distance};
  }
  const PlyBody &a, &b;
  double skin; ///< mm
  std::vector<std::int32_t> open_a, open_b;
  SelfEdges self;
};

} // namespace

void search_edges(const Layup& layup, PlyEdgeContact& pair) {
  const Stopwatch watch(pair.contact.time.search);
  const EdgeQuery q(layup, pair);
  find_edge_pairs(pair.contact, q.a.edge_sheet(), q.open_a, q.b.edge_sheet(), q.open_b, q.skin,
                  q.self);
}

void search_new_ridges(const Layup& layup, PlyEdgeContact& pair,
                       std::span<const std::int32_t> new_a, std::span<const std::int32_t> new_b) {
  const Stopwatch watch(pair.contact.time.search);
  const EdgeQuery q(layup, pair);
  // since the contact search
  const double moved = q.a.max_displacement + q.b.max_displacement;
  add_edge_pairs(pair.contact, q.a.edge_sheet(), q.open_a, new_a, q.b.edge_sheet(), q.open_b, new_b,
                 q.skin + moved, q.self);
}

} // namespace plyform
