// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solver/nodal_forces.hpp"

#include "contact/stopwatch.hpp"
#include "core/solver/contact_search.hpp"

#include <algorithm>

namespace plyform {
namespace {

/// Lists for each ply the force arrays that are not zero in this step, in fixed order.
void collect_forces(Scene& s) {
  const auto list = [&](int ply) -> auto& {
    return s.plies[ply].nodal_forces;
  };
  for (PlyState& ply : s.plies) {
    ply.nodal_forces.clear();
    if (!ply.reaction.empty()) ply.nodal_forces.push_back(&ply.reaction);
    if (!ply.pull.empty()) ply.nodal_forces.push_back(&ply.pull);
  }
  for (const ToolState& t : s.tools)
    for (std::size_t p = 0; p < s.plies.size(); ++p)
      if (!t.contacts[p].list.active.empty())
        list(static_cast<int>(p)).push_back(&t.contacts[p].force);
  for (const PlyPair& pair : s.ply_pairs) {
    if (!pair.loaded) continue;
    list(pair.a).push_back(&pair.force_a);
    list(pair.b).push_back(&pair.force_b);
  }
}

/// Contact forces between two plies, of nodes and edges.
void pair_forces(Scene& s, PlyPair& pair) {
  if (pair.loaded) {
    std::fill(pair.force_a.begin(), pair.force_a.end(), Vec3::Zero());
    std::fill(pair.force_b.begin(), pair.force_b.end(), Vec3::Zero());
  }
  pair.loaded = false;
  const PlyState &a = s.plies[pair.a], &b = s.plies[pair.b];
  for (const int i : pair.contacts) {
    const bool up = s.ply_contacts[i].slave == pair.a;
    PlyPlyContact& contact = s.ply_contacts[i].contact;
    const PlyState &slave = up ? a : b, &master = up ? b : a;
    ply_ply_forces(contact, slave.state(), master.state(), master.membrane.triangles, s.dt,
                   {a.max_displacement + b.max_displacement, a.path_length + b.path_length},
                   up ? pair.force_a : pair.force_b, up ? pair.force_b : pair.force_a);
    pair.loaded = pair.loaded || contact.sums.touching > 0;
  }
  for (const int i : pair.edges) {
    EdgeEdgeContact& contact = s.edge_contacts[i].contact;
    edge_forces(contact, a.edge_sheet(), b.edge_sheet(), s.dt, pair.force_a, pair.force_b);
    pair.loaded = pair.loaded || contact.sums.touching > 0;
  }
}

} // namespace

void element_and_contact_forces(Scene& s, ThreadPool& pool) {
  const auto tool_task = [&](int i) {
    ToolState& t = s.tools[i];
    const Stopwatch watch(t.seconds);
    const Vec3 before = t.force;
    for (std::size_t p = 0; p < s.plies.size(); ++p)
      t.ply_paths[p] = path_length_ahead(s, t) + s.plies[p].path_length;
    t.force = tool_ply_forces(t.body, t.contacts, s.ply_states, t.ply_paths, s.dt);
    t.work -= 0.5 * (before + t.force).dot(t.body.motion);
  };
  const auto group_task = [&](int i) {
    Block& block = s.group_blocks[i];
    const Stopwatch watch(block.seconds);
    PlyState& ply = s.plies[block.ply];
    const GroupReport report =
        ply.simd ? simd_forces(*ply.simd, ply.membrane, ply.x, s.dt, block.begin)
                 : element_forces(ply.membrane, ply.x, s.dt, block.begin, block.end, ply.q);
    s.group_sums[i] += report.viscous_work;
    s.group_collapsed[i] = report.collapsed;
  };
  const auto bending_task = [&](int i) {
    Block& block = s.bending_blocks[i];
    const Stopwatch watch(block.seconds);
    PlyState& ply = s.plies[block.ply];
    bending_forces(*ply.bending, ply.x, block.begin);
  };
  const int pairs = static_cast<int>(s.ply_pairs.size());
  const int tools = pairs + static_cast<int>(s.tools.size());
  s.ply_states.clear();
  for (const PlyState& ply : s.plies)
    s.ply_states.push_back(ply.state());
  const int groups = tools + static_cast<int>(s.group_blocks.size());
  const int all = groups + static_cast<int>(s.bending_blocks.size());
  pool.run(all, [&](int i) { // longest tasks first
    if (i < pairs)
      pair_forces(s, s.ply_pairs[i]);
    else if (i < tools)
      tool_task(i - pairs);
    else if (i < groups)
      group_task(i - tools);
    else
      bending_task(i - groups);
  });
  collect_forces(s);
}

MassLoads mass_loads(const Scene& s) {
  return {s.data.gravity, s.data.solver.mass_damping};
}

void sum_forces(const PlyState& ply, int begin, int end, Vec3* f) {
  for (int n = begin; n < end; ++n) {
    Vec3& sum = f[n - begin];
    sum = ply.simd ? simd_force(*ply.simd, static_cast<std::size_t>(n))
                   : node_force(ply.membrane, ply.q, n);
    if (ply.bending) sum += simd_force(*ply.bending, static_cast<std::size_t>(n));
  }
  for (const std::vector<Vec3>* force : ply.nodal_forces) {
    const Vec3* from = force->data() + begin;
    for (int i = 0; i < end - begin; ++i)
      f[i] += from[i];
  }
}

Vec3 acceleration(const PlyState& ply, int node, const MassLoads& loads) {
  Vec3 force;
  sum_forces(ply, node, node + 1, &force);
  return acceleration(ply, static_cast<std::size_t>(node), force, loads);
}

} // namespace plyform
