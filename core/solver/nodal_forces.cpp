// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solver/nodal_forces.hpp"

#include <algorithm>

namespace plyform {
namespace {

/// Lists for each ply the force arrays that are not zero in this step, in fixed order.
void collect_forces(Scene& s) {
  for (PlyBody& ply : s.plies)
    ply.nodal_forces.clear();
  each_kind(s, [&](auto& kind) { kind.list_arrays(s); });
}

/// Runs the task that a number among those of all kinds belongs to.
void run_task(Scene& s, int number) {
  int first = 0;
  each_kind<InOrder::begun>(s, [&](auto& kind) {
    const int task = number - first, tasks = kind.tasks(s);
    first += tasks;
    if (task >= 0 && task < tasks) kind.run(s, task);
  });
}

/// The tasks of forces, shared out so that a thread has plies that are neighbours, as it has their
/// nodes when they are moved. The longest come first.
std::vector<std::vector<int>> share_forces(const Scene& s, int threads) {
  std::vector<std::vector<int>> shares(static_cast<std::size_t>(threads));
  int number = 0;
  each_kind<InOrder::begun>(s, [&](const auto& kind) {
    for (int i = 0; i < kind.tasks(s); ++i) {
      const int thread = std::min(threads - 1, static_cast<int>(kind.place(s, i) * threads));
      shares[at(thread)].push_back(number++);
    }
  });
  return shares;
}

} // namespace

void element_and_contact_forces(Scene& s, ThreadPool& pool) {
  s.ply_states.clear();
  for (const PlyBody& ply : s.plies)
    s.ply_states.push_back(ply.state());
  if (s.force_shares.size() != static_cast<std::size_t>(pool.size()))
    s.force_shares = share_forces(s, pool.size());
  pool.run(s.force_shares, [&s](int number) { run_task(s, number); });
  each_kind(s, [&](auto& kind) { kind.finish(s, pool); });
  collect_forces(s);
}

MassLoads mass_loads(const Case& data) {
  return {data.gravity, data.solver.mass_damping};
}

void sum_forces(const PlyBody& ply, int begin, int end, Vec3* f) {
  each_kind_of([&]<class K>() { K::add_to_nodes(ply, begin, end, f); });
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
