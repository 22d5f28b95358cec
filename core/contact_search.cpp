// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contact_search.hpp"

#include "core/passing.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

void search_tool(Scene& s, ToolAndContacts& t) {
  for (std::size_t p = 0; p < s.plies.size(); ++p)
    find_tool_points(t.contacts[p], t.body, s.plies[p].state(),
                     std::max(s.data.contact.skin, step_way(s, static_cast<int>(p), t)));
  t.displacement_search = t.body.displacement;
}

void search_plies(Scene& s, PlyContact& pair) {
  const PlyBody& slave = s.plies[static_cast<std::size_t>(pair.slave)];
  const PlyBody& master = s.plies[static_cast<std::size_t>(pair.master)];
  std::vector<Candidate> candidates;
  // also what has come through within the step: find_passed looks at it
  const double reach = std::max(pair.contact.distance + s.data.contact.skin, step_way(s, pair));
  master.tree->candidates(slave.x, reach, candidates);
  find_sheet_points(pair.contact, candidates, slave.state(), master.state(),
                    master.membrane.triangles);
}

void search_edges(Scene& s, PlyEdgeContact& pair) {
  const PlyBody& a = s.plies[static_cast<std::size_t>(pair.a)];
  const PlyBody& b = s.plies[static_cast<std::size_t>(pair.b)];
  find_edge_pairs(pair.contact, a.state(), a.edges, a.folded, b.state(), b.edges, b.folded,
                  s.data.contact.skin);
}

/// Each ply's list of the force arrays that boundaries and contacts now write into, in fixed order.
void collect_forces(Scene& s) {
  const auto list = [&](int ply) -> auto& {
    return s.plies[static_cast<std::size_t>(ply)].nodal_forces;
  };
  for (PlyBody& ply : s.plies) {
    ply.nodal_forces.clear();
    if (!ply.reaction.empty()) ply.nodal_forces.push_back(&ply.reaction);
  }
  for (ToolAndContacts& t : s.tools)
    for (std::size_t p = 0; p < s.plies.size(); ++p)
      if (!t.contacts[p].points.empty()) list(static_cast<int>(p)).push_back(&t.contacts[p].force);
  for (PlyContact& pair : s.ply_contacts) {
    if (pair.contact.points.empty()) continue;
    list(pair.slave).push_back(&pair.contact.slave_force);
    list(pair.master).push_back(&pair.contact.master_force);
  }
  for (PlyEdgeContact& pair : s.edge_contacts) {
    if (pair.contact.pairs.empty()) continue;
    list(pair.a).push_back(&pair.contact.force_a);
    list(pair.b).push_back(&pair.contact.force_b);
  }
}

} // namespace

double way_since_search(const Scene& s) {
  double moved2 = 0.0;
  for (const NodeSums& n : s.node_sums)
    if (!(n.moved2 <= moved2) && !std::isnan(moved2)) moved2 = n.moved2; // NaN stays
  for (const ToolAndContacts& t : s.tools) {
    // A pushed tool still moves after this test, with the forces of the step.
    const double ahead = t.body.pushed ? t.body.speed_limit * s.dt : 0.0;
    const double tool = (t.body.displacement - t.displacement_search).norm() + ahead;
    const double tool2 = tool * tool;
    if (!(tool2 <= moved2) && !std::isnan(moved2)) moved2 = tool2;
  }
  return std::sqrt(moved2);
}

void search_contacts(Scene& s, ThreadTeam& team) {
  team.run(static_cast<int>(s.plies.size()), [&](int p) {
    PlyBody& ply = s.plies[static_cast<std::size_t>(p)];
    ply.tree->refit(ply.x);
    ply.x_search = ply.x;
    ply.folded = folded_edges(ply.edges, ply.membrane.triangles, ply.x, ply.thickness);
  });
  const int tools = static_cast<int>(s.tools.size());
  const int sheets = tools + static_cast<int>(s.ply_contacts.size());
  const int edges = sheets + static_cast<int>(s.edge_contacts.size());
  team.run(edges, [&](int i) {
    if (i < tools)
      search_tool(s, s.tools[static_cast<std::size_t>(i)]);
    else if (i < sheets)
      search_plies(s, s.ply_contacts[static_cast<std::size_t>(i - tools)]);
    else
      search_edges(s, s.edge_contacts[static_cast<std::size_t>(i - sheets)]);
  });
  collect_forces(s);
  for (NodeSums& n : s.node_sums)
    n.moved2 = 0.0;
  ++s.searches;
}

} // namespace plyform
