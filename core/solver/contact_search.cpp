// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solver/contact_search.hpp"

#include "contact/point_triangle.hpp"
#include "contact/search/unfolded.hpp"
#include "core/solver/displacements.hpp"
#include "core/solver/edge_contact_search.hpp"
#include "core/solver/fibre_directions.hpp"
#include "core/solver/follow_thickness.hpp"
#include "core/solver/occlusion.hpp"
#include "core/solver/pass_through.hpp"
#include "core/solver/resting.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace plyform {
namespace {

/// Removes candidates whose face is a neighbour of their node: contains it, or is within `reach`
/// (mm) of it in the undeformed ply x0.
void remove_neighbours(std::vector<Candidate>& candidates, std::span<const Vec3> x0,
                       std::span<const Triangle> triangles, double reach) {
  const auto neighbour = [&](const Candidate& c) {
    const Triangle& t = triangles[c.face];
    if (std::find(t.begin(), t.end(), c.node) != t.end()) return true;
    const auto at = [&](std::int32_t n) -> const Vec3& { return x0[n]; };
    return closest_point_on_triangle(at(c.node), at(t[0]), at(t[1]), at(t[2])).distance2 <
           reach * reach;
  };
  std::erase_if(candidates, neighbour);
}

void search_tool(Layup& layup, ToolState& t) {
  for (std::size_t p = 0; p < layup.plies.size(); ++p)
    find_tool_ply_points(t.contacts[p], t.body, layup.plies[p].state(),
                         std::max(layup.skin, step_displacement(layup, static_cast<int>(p), t)),
                         path_length_ahead(t, layup.dt) + layup.plies[p].path_length);
  t.displacement_search = t.body.displacement;
}

void search_plies(Layup& layup, PlyContact& pair) {
  const PlyBody& slave = layup.plies[pair.slave];
  const PlyBody& master = layup.plies[pair.master];
  const Stopwatch watch(pair.contact.time.search);
  // also nodes that have passed through within the step, which find_pass_through then detects
  const double reach =
      std::max(reach_of(layup, pair.contact.distance), step_displacement(layup, pair));
  std::vector<Candidate> candidates;
  if (may_meet(slave.tree->bounds(), master.tree->bounds(), reach))
    master.tree->candidates(slave.x, reach, candidates,
                            occluded_nodes(layup, pair.slave, pair.master, reach));
  if (pair.slave == pair.master)
    remove_neighbours(candidates, slave.x0, slave.membrane.triangles,
                      neighbourhood * pair.contact.distance);
  find_ply_ply_points(pair.contact, candidates, slave.state(), master.state(),
                      master.membrane.triangles, slave.path_length + master.path_length);
  if (neighbours(pair)) mark_occluded(layup, layup.plies[pair.slave], pair, master);
}

/// Allocates the force arrays of two plies as soon as anything of them may touch: most pairs of a
/// stack never do.
void allocate_forces(const Layup& layup, PlyPair& pair) {
  const auto may_touch = [](const PlyContact& pass) { return !pass.contact.points.empty(); };
  if (!pair.force_a.empty() || (std::none_of(pair.passes.begin(), pair.passes.end(), may_touch) &&
                                pair.edges.contact.groups.empty()))
    return;
  pair.force_a.assign(layup.plies[pair.a].x.size(), Vec3::Zero());
  pair.force_b.assign(layup.plies[pair.b].x.size(), Vec3::Zero());
}

void find_ply_unfolded(const Layup& layup, PlyBody& ply) {
  if (ply.self_contact)
    find_unfolded({ply.x0, ply.membrane.triangles, ply.convex}, ply.edges, ply.x,
                  ply.thickness * std::max(layup.thickest, 1.0), layup.skin, ply.unfolded);
}

void find_ply_ridges(const Layup& layup, PlyBody& ply) {
  if (layup.plies_meet) find_ridges(ply.edges, ply.x, ply.ridge_limit, ply.ridges);
}

void refit_tree(const Layup&, PlyBody& ply) {
  ply.tree->refit(ply.x);
  ply.x_search = ply.x;
}

void find_fold_bounds(const Layup& layup, PlyBody& ply) {
  if (layup.plies_meet) renew_fold_bounds(ply); // only contacts between plies use them
}

/// What of a ply is found anew at a search, the longest first. None depends on another: a task
/// each, as few plies are shared out badly.
constexpr std::array search_parts{&find_ply_unfolded, &find_ply_ridges, &refit_tree,
                                  &find_fold_bounds};

} // namespace

void renew_fold_bounds(PlyBody& ply) {
  fold_bounds(ply.x, ply.membrane.triangles, ply.fold_bound);
  ply.fold_motion = 0.0;
}

void search_contacts(Scene& s, ThreadPool& pool) {
  const int plies = static_cast<int>(s.plies.size());
  std::vector<double> seconds(search_parts.size() * s.plies.size(), 0.0); // parts at the same time
  note_thickness(s);
  note_fibres(s, pool);
  pool.run(static_cast<int>(seconds.size()), [&](int i) {
    const Stopwatch watch(seconds[at(i)]);
    search_parts[at(i / plies)](s, s.plies[at(i % plies)]);
  });
  for (std::size_t i = 0; i < seconds.size(); ++i)
    s.plies[i % s.plies.size()].search_seconds += seconds[i];
  // Adjacent plies first: the nodes that they occlude are skipped for the plies beyond.
  std::array<std::vector<PlyContact*>, 2> pairs;
  each_pass(s, [&](PlyContact& pass) { pairs[neighbours(pass) ? 0 : 1].push_back(&pass); });
  std::vector<PlyEdgeContact*> edge_contacts;
  each_edge_contact(s, [&](PlyEdgeContact& edges) { edge_contacts.push_back(&edges); });
  const int near = static_cast<int>(pairs[0].size());
  pool.run(near + static_cast<int>(s.tools.size()), [&](int i) {
    if (i < near)
      search_plies(s, *pairs[0][i]);
    else
      search_tool(s, s.tools[i - near]);
  });
  const int edges = static_cast<int>(edge_contacts.size());
  pool.run(edges + static_cast<int>(pairs[1].size()), [&](int i) { // longest tasks first
    if (i < edges)
      search_edges(s, *edge_contacts[at(i)]);
    else
      search_plies(s, *pairs[1][i - edges]);
  });
  for (PlyPair& pair : s.ply_pairs)
    allocate_forces(s, pair);
  for (NodeSums& n : s.node_sums)
    n.moved2 = 0.0;
  for (PlyBody& ply : s.plies)
    ply.max_displacement = ply.thickening_path = 0.0;
  find_far_tools(s, s.tools);
  for (ToolState& t : s.tools) // what it may still move in this step
    t.max_displacement = t.body.force_controlled && !t.far ? t.body.max_approach_speed * s.dt : 0.0;
  find_resting(s, s.tools, s);
  ++s.searches;
}

} // namespace plyform
