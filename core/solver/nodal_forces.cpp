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
  for (PlyBody& ply : s.plies) {
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
  const PlyBody &a = s.plies[pair.a], &b = s.plies[pair.b];
  for (const int i : pair.contacts) {
    const bool up = s.ply_contacts[i].slave == pair.a;
    PlyPlyContact& contact = s.ply_contacts[i].contact;
    const PlyBody &slave = up ? a : b, &master = up ? b : a;
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

/// How many tasks of each kind forces have, in the order of their numbers and of what they take.
struct ForceTasks {
  explicit ForceTasks(const Scene& s)
      : pairs(static_cast<int>(s.ply_pairs.size())),
        tools(pairs + static_cast<int>(s.tools.size())),
        groups(tools + static_cast<int>(s.group_blocks.size())),
        all(groups + static_cast<int>(s.bending_blocks.size())) {}
  int pairs, tools, groups, all; ///< number of the first task that is of a later kind
};

/// The tasks of forces, shared out so that a thread has plies that are neighbours, as it has their
/// nodes when they are moved. The longest come first.
std::vector<std::vector<int>> share_forces(const Scene& s, int threads) {
  std::vector<std::vector<int>> shares(static_cast<std::size_t>(threads));
  const ForceTasks tasks(s);
  const double plies = static_cast<double>(s.plies.size());
  const auto give = [&](int task, double place) { // place: in the stack, from 0 to 1
    const int thread = std::min(threads - 1, static_cast<int>(place * threads));
    shares[static_cast<std::size_t>(thread)].push_back(task);
  };
  for (int i = 0; i < tasks.pairs; ++i)
    give(i, 0.5 * (s.ply_pairs[i].a + s.ply_pairs[i].b + 1) / plies);
  for (int i = tasks.pairs; i < tasks.tools; ++i)
    give(i, static_cast<double>(i - tasks.pairs) / (tasks.tools - tasks.pairs));
  for (int i = tasks.tools; i < tasks.groups; ++i)
    give(i, static_cast<double>(i - tasks.tools) / (tasks.groups - tasks.tools));
  for (int i = tasks.groups; i < tasks.all; ++i)
    give(i, static_cast<double>(i - tasks.groups) / (tasks.all - tasks.groups));
  return shares;
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
    PlyBody& ply = s.plies[block.ply];
    const GroupReport report =
        ply.simd ? simd_forces(*ply.simd, ply.membrane, ply.x, s.dt, block.begin,
                               {ply.viscosity, ply.viscosity})
                 : element_forces(ply.membrane, ply.x, s.dt, block.begin, block.end, {}, ply.q);
    s.group_sums[i] += report.viscous_work;
    s.group_collapsed[i] = report.collapsed;
  };
  const auto bending_task = [&](int i) {
    Block& block = s.bending_blocks[i];
    const Stopwatch watch(block.seconds);
    PlyBody& ply = s.plies[block.ply];
    bending_forces(*ply.bending, ply.x, block.begin);
  };
  const ForceTasks tasks(s);
  s.ply_states.clear();
  for (const PlyBody& ply : s.plies)
    s.ply_states.push_back(ply.state());
  if (s.force_shares.size() != static_cast<std::size_t>(pool.size()))
    s.force_shares = share_forces(s, pool.size());
  pool.run(s.force_shares, [&](int i) {
    if (i < tasks.pairs)
      pair_forces(s, s.ply_pairs[i]);
    else if (i < tasks.tools)
      tool_task(i - tasks.pairs);
    else if (i < tasks.groups)
      group_task(i - tasks.tools);
    else
      bending_task(i - tasks.groups);
  });
  collect_forces(s);
}

MassLoads mass_loads(const Scene& s) {
  return {s.data.gravity, s.data.solver.mass_damping};
}

void sum_forces(const PlyBody& ply, int begin, int end, Vec3* f) {
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

Vec3 acceleration(const PlyBody& ply, int node, const MassLoads& loads) {
  Vec3 force;
  sum_forces(ply, node, node + 1, &force);
  return acceleration(ply, static_cast<std::size_t>(node), force, loads);
}

} // namespace plyform
