// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solver/step.hpp"

#include "core/model/motion.hpp"
#include "core/solver/contact_search.hpp"
#include "core/solver/displacements.hpp"
#include "core/solver/follow_folds.hpp"
#include "core/solver/follow_temperature.hpp"
#include "core/solver/follow_thickness.hpp"
#include "core/solver/nodal_forces.hpp"
#include "core/solver/pass_through.hpp"
#include "core/solver/prescribed_motion.hpp"
#include "core/solver/pretension.hpp"
#include "core/solver/stable_time_step.hpp"
#include "core/solver/step_faults.hpp"
#include "core/solver/time_step.hpp"
#include "core/solver/vacuum_contact.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

// Largest number of steps between updates of the stable time step. Elements: their geometry changes
// by far less in that time than step_factor covers. Contacts: single ones may deepen in that time,
// but none beyond renew_depth of its pair, which triggers an update.
constexpr int elements_every = 200, contacts_every = 50;

/// Moves driven tools to their positions at scene.time, and gives all their temperatures. Pushed
/// tools are moved when their forces are computed; here their force is set.
void move_tools(const Layup& layup, std::vector<ToolState>& tools) {
  for (std::size_t i = 0; i < tools.size(); ++i) {
    ToolState& t = tools[i];
    t.body.temperature =
        tool_temperature(layup.data, layup.data.tools[i], layup.time * layup.data.process_time());
    const double now = motion_at(layup.data.tools[i], layup.time, layup.data.solver.duration);
    if (t.body.force_controlled) {
      t.body.force = now;
      continue;
    }
    const Vec3 to = now * t.body.direction;
    t.body.motion = to - t.body.displacement;
    t.body.displacement = to;
  }
}

/// Searches for contacts if bodies have moved by more than the skin allows for; `searched` says so.
std::optional<Stop> search_if_due(Scene& s, ThreadPool& pool, bool& searched) {
  searched = !track_displacements(s, s.tools);
  if (!searched) return std::nullopt;
  if (auto stop = find_not_finite(s)) return stop;
  search_contacts(s, pool);
  return std::nullopt;
}

void filter_forces(std::vector<ToolState>& tools, double dt, double duration) {
  for (ToolState& t : tools)
    t.filter.add(t.force, dt, filter_share * duration);
}

std::optional<Stop> find_faults(const Scene& s) {
  std::optional<Stop> fault;
  each_kind(s, [&](const auto& kind) {
    if (!fault) fault = kind.fault(s);
  });
  if (fault) return fault;
  if (auto stop = find_pass_through(s, s.tools, s)) return stop;
  return find_squeezed(s);
}

/// (15)-(17) for one block of nodes.
NodeSums move_nodes(PlyBody& ply, const Block& block, double dt, double next_dt,
                    const MassLoads& loads) {
  NodeSums sums;
  std::array<Vec3, node_block> force;
  sum_forces(ply, block.begin, block.end, force.data());
  for (int i = block.begin; i < block.end; ++i) {
    const auto n = static_cast<std::size_t>(i);
    const Vec3 old = ply.velocity[n];
    const Vec3& f = force[i - block.begin];
    const Vec3 now = old + 0.5 * (dt + next_dt) * acceleration(ply, n, f, loads); // (16)
    ply.velocity[n] = now;
    ply.motion[n] = now * next_dt;
    ply.x[n] += ply.motion[n]; // (15)
    // trapezoidal rule over the step that begins: the damping force follows `old` at its start and
    // `now` at its end
    sums.damping += 0.5 * loads.damping * ply.mass[n] * now.dot(old + now) * next_dt;
    sums.step2 = std::max(sums.step2, ply.motion[n].squaredNorm());
    const double moved2 = (ply.x[n] - ply.x_search[n]).squaredNorm();
    if (!(moved2 <= sums.moved2) && !std::isnan(sums.moved2)) sums.moved2 = moved2; // NaN stays
  }
  return sums;
}

} // namespace

void start(Scene& s, ThreadPool& pool) {
  search_contacts(s, pool);
  update_stable_step(s, pool);
  renew_stable_step(s, pool);
  set_step(s);
}

std::optional<Stop> compute_forces(Scene& s, ThreadPool& pool) {
  bool searched = false;
  move_tools(s, s.tools);
  raise_pretension(s, s.group_blocks, pool);
  update_thickness(s, pool);
  update_temperatures(s, pool);
  if (auto stop = search_if_due(s, pool, searched)) return stop;
  const bool due = searched || s.step % elements_every == 0;
  if (due) update_stable_step(s, pool);
  follow_folds(s, s, pool, searched);
  bear_vacuums(s, s.ply_pairs);
  element_and_contact_forces(s, pool);
  filter_forces(s.tools, s.dt, s.data.solver.duration);
  if (due || s.step % contacts_every == 0 ||
      largest_displacement(s, s.tools) - s.bound_displacement > 0.5 * s.bound_margin)
    renew_stable_step(s, pool);
  else if (contacts_deepened(s))
    renew_deepened_step(s, pool);
  set_step(s);
  if (auto stop = find_faults(s)) return stop;
  prescribe_nodes(s, s);
  return std::nullopt;
}

void move_plies(Scene& s, ThreadPool& pool) {
  const MassLoads loads = mass_loads(s.data);
  pool.run(static_cast<int>(s.node_blocks.size()), [&](int i) {
    const auto b = static_cast<std::size_t>(i);
    Block& block = s.node_blocks[b];
    if (s.plies[block.ply].resting) return;
    const Stopwatch watch(block.seconds);
    s.node_sums[b] = move_nodes(s.plies[block.ply], block, s.dt, s.next_dt, loads);
  });
  for (const NodeSums& n : s.node_sums)
    s.mass_damping_work += n.damping;
  each_kind(s, [&](auto& kind) { kind.end_step(s); });
  s.dt = s.next_dt;
  s.time += s.dt;
  ++s.step;
}

} // namespace plyform
