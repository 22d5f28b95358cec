// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solver/nodal_forces.hpp"

#include "core/solver/force_kinds.hpp"

#include <algorithm>

namespace plyform {
namespace {

/// Lists for each ply the force arrays that are not zero in this step, in fixed order.
void collect_forces(Scene& s) {
  for (PlyBody& ply : s.plies)
    ply.nodal_forces.clear();
  each_kind([&]<class K>() { K::list_arrays(s); });
}

/// Calls f.operator()<K>(task) for the kind K that a number among all tasks belongs to.
template <class F>
void with_task(const Scene& s, int number, const F& f) {
  int first = 0;
  each_kind<TasksOfForces>([&]<class K>() {
    const int task = number - first, tasks = K::tasks(s);
    first += tasks;
    if (task >= 0 && task < tasks) f.template operator()<K>(task);
  });
}

/// The tasks of forces, shared out so that a thread has plies that are neighbours, as it has their
/// nodes when they are moved. The longest come first.
std::vector<std::vector<int>> share_forces(const Scene& s, int threads) {
  std::vector<std::vector<int>> shares(static_cast<std::size_t>(threads));
  int number = 0;
  each_kind<TasksOfForces>([&]<class K>() {
    for (int i = 0; i < K::tasks(s); ++i) {
      const int thread = std::min(threads - 1, static_cast<int>(K::place(s, i) * threads));
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
  pool.run(s.force_shares, [&s](int number) {
    with_task(s, number, [&s]<class K>(int task) { K::run(s, task); });
  });
  each_kind([&]<class K>() { K::finish(s, pool); });
  collect_forces(s);
}

MassLoads mass_loads(const Scene& s) {
  return {s.data.gravity, s.data.solver.mass_damping};
}

void sum_forces(const PlyBody& ply, int begin, int end, Vec3* f) {
  each_kind([&]<class K>() { K::add_to_nodes(ply, begin, end, f); });
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
