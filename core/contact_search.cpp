// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contact_search.hpp"

#include "contact/point_triangle.hpp"
#include "core/passing.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

/// Of a ply that touches itself, faces within this many thicknesses of a node along the unformed
/// ply are its neighbours, whatever shape it takes: the nose of a hairpin fold is pi / 2 long, and
/// shear by 60 degrees, which brings nodes together to 0.37, is no contact yet.
constexpr double neighbourhood = 3.0;

bool may_meet(Box3 a, const Box3& b, double reach) {
  a.min().array() -= reach;
  a.max().array() += reach;
  return a.intersects(b);
}

/// Drops the candidates that are neighbours of their own node: within `reach` (mm) of it along the
/// unformed ply x0.
void leave_out_neighbours(std::vector<Candidate>& candidates, std::span<const Vec3> x0,
                          std::span<const Triangle> triangles, double reach) {
  const auto neighbour = [&](const Candidate& c) {
    const Triangle& t = triangles[static_cast<std::size_t>(c.face)];
    if (std::find(t.begin(), t.end(), c.node) != t.end()) return true;
    const auto at = [&](std::int32_t n) -> const Vec3& { return x0[static_cast<std::size_t>(n)]; };
    return closest_point_on_triangle(at(c.node), at(t[0]), at(t[1]), at(t[2])).distance2 <
           reach * reach;
  };
  std::erase_if(candidates, neighbour);
}

void search_tool(Scene& s, ToolAndContacts& t) {
  for (std::size_t p = 0; p < s.plies.size(); ++p)
    find_tool_points(t.contacts[p], t.body, s.plies[p].state(),
                     std::max(s.data.contact.skin, step_way(s, static_cast<int>(p), t)));
  t.displacement_search = t.body.displacement;
}

void search_plies(Scene& s, PlyContact& pair) {
  const PlyBody& slave = s.plies[static_cast<std::size_t>(pair.slave)];
  const PlyBody& master = s.plies[static_cast<std::size_t>(pair.master)];
  const Stopwatch watch(pair.contact.time.search);
  // also what has come through within the step: find_passed looks at it
  const double reach = std::max(pair.contact.distance + s.data.contact.skin, step_way(s, pair));
  std::vector<Candidate> candidates;
  if (may_meet(slave.tree->bounds(), master.tree->bounds(), reach))
    master.tree->candidates(slave.x, reach, candidates);
  if (pair.slave == pair.master)
    leave_out_neighbours(candidates, slave.x0, slave.membrane.triangles,
                         neighbourhood * pair.contact.distance);
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

bool follow_ways(Scene& s) {
  // Ways only grow between searches: what has once been looked at is looked at again.
  const auto grow = [](double& way, double now) {
    if (!(now <= way) && !std::isnan(way)) way = now; // NaN stays
  };
  for (std::size_t i = 0; i < s.node_blocks.size(); ++i)
    grow(s.plies[static_cast<std::size_t>(s.node_blocks[i].ply)].way,
         std::sqrt(s.node_sums[i].moved2));
  for (ToolAndContacts& t : s.tools) {
    // A pushed tool still moves after this, with the forces of the step.
    const double ahead = t.body.pushed ? t.body.speed_limit * s.dt : 0.0;
    grow(t.way, (t.body.displacement - t.displacement_search).norm() + ahead);
  }
  return furthest_way(s) <= 0.5 * s.data.contact.skin;
}

double furthest_way(const Scene& s) {
  double furthest = 0.0;
  const auto grow = [&furthest](double way) {
    if (!(way <= furthest) && !std::isnan(furthest)) furthest = way; // NaN stays
  };
  for (const PlyBody& ply : s.plies)
    grow(ply.way);
  for (const ToolAndContacts& t : s.tools)
    grow(t.way);
  return furthest;
}

void search_contacts(Scene& s, ThreadTeam& team) {
  team.run(static_cast<int>(s.plies.size()), [&](int p) {
    PlyBody& ply = s.plies[static_cast<std::size_t>(p)];
    const Stopwatch watch(ply.search_seconds);
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
  for (PlyBody& ply : s.plies)
    ply.way = 0.0;
  for (ToolAndContacts& t : s.tools) // the way it may still go in this step
    t.way = t.body.pushed ? t.body.speed_limit * s.dt : 0.0;
  ++s.searches;
}

} // namespace plyform
