// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solver/step.hpp"

#include "core/model/motion.hpp"
#include "core/solver/contact_search.hpp"
#include "core/solver/pass_through.hpp"
#include "core/solver/stable_time_step.hpp"
#include "core/solver/step_faults.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plyform {
namespace {

// Steps between renewals of the stable step at most. Of elements: geometry changes by far less than
// the case's step factor leaves room for. Of contacts: each may get deeper in that time, though
// none beyond the deepest of its pair (renew_depth).
constexpr int elements_every = 200, contacts_every = 50;

/// Driven tools go to where they are at scene.time; pushed ones find their place with the forces,
/// and get their force over the first twentieth of the time, so as not to strike the stack.
void drive_tools(Scene& s) {
  constexpr double ramp = 0.05; // of the duration
  for (ToolState& t : s.tools) {
    if (t.body.force_controlled) {
      t.body.force = smooth_step(t.force_on, s.time, ramp * s.data.solver.duration);
      continue;
    }
    const Vec3 to = smooth_step(t.stroke, s.time, s.data.solver.duration) * t.body.direction;
    t.body.motion = to - t.body.displacement;
    t.body.displacement = to;
  }
}

/// Each ply's list of the force arrays that hold something in this step, in fixed order.
void collect_forces(Scene& s) {
  const auto list = [&](int ply) -> auto& {
    return s.plies[static_cast<std::size_t>(ply)].nodal_forces;
  };
  for (PlyState& ply : s.plies) {
    ply.nodal_forces.clear();
    if (!ply.reaction.empty()) ply.nodal_forces.push_back(&ply.reaction);
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

/// All that happens between two plies.
void pair_forces(Scene& s, PlyPair& pair) {
  if (pair.loaded) {
    std::fill(pair.force_a.begin(), pair.force_a.end(), Vec3::Zero());
    std::fill(pair.force_b.begin(), pair.force_b.end(), Vec3::Zero());
  }
  pair.loaded = false;
  const PlyState &a = s.plies[static_cast<std::size_t>(pair.a)],
                 &b = s.plies[static_cast<std::size_t>(pair.b)];
  for (const int i : pair.contacts) {
    const bool up = s.ply_contacts[static_cast<std::size_t>(i)].slave == pair.a;
    PlyPlyContact& contact = s.ply_contacts[static_cast<std::size_t>(i)].contact;
    const PlyState &slave = up ? a : b, &master = up ? b : a;
    ply_ply_forces(contact, slave.state(), master.state(), master.membrane.triangles, s.dt,
                   {a.max_displacement + b.max_displacement, a.path_length + b.path_length},
                   up ? pair.force_a : pair.force_b, up ? pair.force_b : pair.force_a);
    pair.loaded = pair.loaded || contact.sums.touching > 0;
  }
  for (const int i : pair.edges) {
    EdgeEdgeContact& contact = s.edge_contacts[static_cast<std::size_t>(i)].contact;
    edge_forces(contact, a.state(), a.edges, b.state(), b.edges, s.dt,
                a.path_length + b.path_length, pair.force_a, pair.force_b);
    pair.loaded = pair.loaded || contact.sums.touching > 0;
  }
}

/// Element and contact forces, each task into arrays of its own: the order in which they are done
/// does not matter.
void add_up_forces(Scene& s, ThreadPool& pool) {
  const auto tool_task = [&](int i) {
    ToolState& t = s.tools[static_cast<std::size_t>(i)];
    const Stopwatch watch(t.seconds);
    const Vec3 before = t.force;
    for (std::size_t p = 0; p < s.plies.size(); ++p)
      t.ply_paths[p] = path_ahead(s, t) + s.plies[p].path_length;
    t.force = tool_ply_forces(t.body, t.contacts, s.ply_states, t.ply_paths, s.dt);
    t.work -= 0.5 * (before + t.force).dot(t.body.motion);
  };
  const auto group_task = [&](int i) {
    Block& block = s.group_blocks[static_cast<std::size_t>(i)];
    const Stopwatch watch(block.seconds);
    PlyState& ply = s.plies[static_cast<std::size_t>(block.ply)];
    const GroupReport report =
        ply.simd ? simd_forces(*ply.simd, ply.membrane, ply.x, s.dt, block.begin)
                 : element_forces(ply.membrane, ply.x, s.dt, block.begin, block.end, ply.q);
    s.group_sums[static_cast<std::size_t>(i)] += report.viscous_work;
    s.group_collapsed[static_cast<std::size_t>(i)] = report.collapsed;
  };
  const auto bending_task = [&](int i) {
    Block& block = s.bending_blocks[static_cast<std::size_t>(i)];
    const Stopwatch watch(block.seconds);
    PlyState& ply = s.plies[static_cast<std::size_t>(block.ply)];
    bending_forces(ply.bending_simd, *ply.bending, ply.x, block.begin);
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
      pair_forces(s, s.ply_pairs[static_cast<std::size_t>(i)]);
    else if (i < tools)
      tool_task(i - pairs);
    else if (i < groups)
      group_task(i - tools);
    else
      bending_task(i - groups);
  });
  collect_forces(s);
}

/// What acts on every mass: gravity (mm/s^2) and damping (1/s).
struct MassLoads {
  Vec3 gravity;
  double damping;
};

MassLoads mass_loads(const Scene& s) {
  return {s.data.gravity, s.data.solver.mass_damping};
}

/// N, of nodes begin .. end - 1 into f[0 ..): all forces of compute_forces. Array after array,
/// which streams; a node's terms are added in the same order however its ply is cut up.
void add_up(const PlyState& ply, int begin, int end, Vec3* f) {
  for (int n = begin; n < end; ++n) {
    Vec3& sum = f[n - begin];
    sum = ply.simd ? simd_force(*ply.simd, static_cast<std::size_t>(n))
                   : node_force(ply.membrane, ply.q, n);
    if (ply.bending) sum += simd_force(ply.bending_simd, static_cast<std::size_t>(n));
  }
  for (const std::vector<Vec3>* force : ply.nodal_forces) {
    const Vec3* from = force->data() + begin;
    for (int i = 0; i < end - begin; ++i)
      f[i] += from[i];
  }
}

/// (17), of the sum of a node's forces.
Vec3 acceleration(const PlyState& ply, std::size_t n, const Vec3& force, const MassLoads& loads) {
  return force / ply.membrane.node_mass[n] + loads.gravity - loads.damping * ply.velocity[n];
}

Vec3 acceleration(const PlyState& ply, int node, const MassLoads& loads) {
  Vec3 force;
  add_up(ply, node, node + 1, &force);
  return acceleration(ply, static_cast<std::size_t>(node), force, loads);
}

/// (R) of core/model/boundary.hpp for one node: the velocity that takes it where its boundaries
/// will be. Adds to their loads and work.
void hold_node(Scene& s, const PrescribedNode& held) {
  PlyState& ply = s.plies[static_cast<std::size_t>(held.ply)];
  const auto n = static_cast<std::size_t>(held.node);
  const Vec3 before = ply.reaction[n];
  ply.reaction[n].setZero();
  const Vec3 free = acceleration(ply, held.node, mass_loads(s));
  const double span = 0.5 * (s.dt + s.next_dt);
  Vec3 reaction = Vec3::Zero(), displacement = reaction, slope = reaction;
  int last = -1; // most nodes are held along all axes by one boundary: placed once
  for (std::size_t i = 0; i < static_cast<std::size_t>(held.count); ++i) {
    const Vec3& axis = held.axis[i];
    const auto b = static_cast<std::size_t>(held.boundary[i]);
    BoundaryState& state = s.boundaries[b];
    if (held.boundary[i] != last) {
      const Boundary& boundary = s.data.boundaries[b];
      displacement = prescribed_position(boundary, ply.x0[n], state.next_displacement) - ply.x[n];
      slope = prescribed_slope(boundary, ply.x0[n], state.displacement);
      last = held.boundary[i];
    }
    const double wanted = (axis.dot(displacement) / s.next_dt - axis.dot(ply.velocity[n])) / span;
    const Vec3 r = ply.membrane.node_mass[n] * (wanted - axis.dot(free)) * axis;
    reaction += r;
    state.force += r;
    state.load += r.dot(slope);
    state.work += 0.5 * axis.dot(before + r) * axis.dot(ply.motion[n]);
  }
  ply.reaction[n] = reaction;
}

/// Forces of all boundaries, after all others are known.
void prescribe_nodes(Scene& s) {
  const double duration = s.data.solver.duration;
  for (std::size_t b = 0; b < s.boundaries.size(); ++b) {
    const double stroke = s.data.boundaries[b].stroke;
    BoundaryState& state = s.boundaries[b];
    state.displacement = smooth_step(stroke, s.time, duration);
    state.next_displacement = smooth_step(stroke, s.time + s.next_dt, duration);
    state.load = 0.0;
    state.force.setZero();
  }
  for (const PrescribedNode& held : s.held)
    hold_node(s, held);
}

/// (15)-(17) for one block of nodes.
NodeSums move_nodes(PlyState& ply, const Block& block, double dt, double next_dt,
                    const MassLoads& loads) {
  NodeSums sums;
  std::array<Vec3, node_block> force;
  add_up(ply, block.begin, block.end, force.data());
  for (int i = block.begin; i < block.end; ++i) {
    const auto n = static_cast<std::size_t>(i);
    const Vec3 old = ply.velocity[n];
    const Vec3& f = force[static_cast<std::size_t>(i - block.begin)];
    const Vec3 now = old + 0.5 * (dt + next_dt) * acceleration(ply, n, f, loads); // (16)
    ply.velocity[n] = now;
    ply.motion[n] = now * next_dt;
    ply.x[n] += ply.motion[n]; // (15)
    // trapezoidal rule over the step that begins; at its end the damping force goes by `now`
    sums.damping += 0.5 * loads.damping * ply.membrane.node_mass[n] * now.dot(old + now) * next_dt;
    sums.step2 = std::max(sums.step2, ply.motion[n].squaredNorm());
    const double moved2 = (ply.x[n] - ply.x_search[n]).squaredNorm();
    if (!(moved2 <= sums.moved2) && !std::isnan(sums.moved2)) sums.moved2 = moved2; // NaN stays
  }
  return sums;
}

double kinetic_energy(const PlyState& ply, double dt, double next_dt, const MassLoads& loads) {
  double sum = 0.0;
  for (std::size_t n = 0; n < ply.x.size(); ++n) {
    // Between two half steps: the product of their velocities where steps are equal (it is what
    // central differences conserve), and without their difference where they are not.
    const Vec3 a = acceleration(ply, static_cast<int>(n), loads);
    const Vec3 now = ply.velocity[n] + 0.5 * dt * a;
    sum += 0.5 * ply.membrane.node_mass[n] *
           (now.squaredNorm() - 0.25 * dt * next_dt * a.squaredNorm());
  }
  return sum;
}

double work_of_gravity(const PlyState& ply, const Vec3& gravity) {
  double sum = 0.0;
  if (gravity.isZero(0)) return sum;
  for (std::size_t n = 0; n < ply.x.size(); ++n)
    sum += ply.membrane.node_mass[n] * gravity.dot(ply.x[n] - ply.x0[n]);
  return sum;
}

/// visit(contact) for every ToolPlyContact, PlyPlyContact and EdgeEdgeContact of the scene.
template <class SomeScene, class Visit>
void visit_contacts(SomeScene& s, const Visit& visit) {
  for (auto& tool : s.tools)
    for (auto& contact : tool.contacts)
      visit(contact);
  for (auto& pair : s.ply_contacts)
    visit(pair.contact);
  for (auto& pair : s.edge_contacts)
    visit(pair.contact);
}

void renew_stable_step(Scene& s, ThreadPool& pool) {
  s.stable_dt = s.data.solver.step_factor * stable_step(s, pool).dt;
  s.bound_displacement = furthest_way(s);
  visit_contacts(s, [](auto& contact) {
    contact.renew_depth = depth_ahead(contact.law, contact.sums.penetration);
  });
}

bool contacts_deepened(const Scene& s) {
  bool deepened = false;
  visit_contacts(s, [&](const auto& contact) {
    deepened = deepened || contact.sums.penetration > contact.renew_depth;
  });
  return deepened;
}

/// The next step: the stable one, or a shorter one in which no contact closes by more than half of
/// the room that it has left.
void set_step(Scene& s) {
  double ratio = std::numeric_limits<double>::infinity();
  visit_contacts(s, [&](const auto& contact) { ratio = std::min(ratio, contact.sums.step_ratio); });
  s.next_dt = s.dt > 0.0 ? std::min(s.stable_dt, s.dt * ratio) : s.stable_dt;
  s.min_dt = s.min_dt > 0.0 ? std::min(s.min_dt, s.next_dt) : s.next_dt;
  s.max_dt = std::max(s.max_dt, s.next_dt);
}

} // namespace

void start(Scene& s, ThreadPool& pool) {
  search_contacts(s, pool);
  update_stable_step(s, pool);
  renew_stable_step(s, pool);
  set_step(s);
}

std::optional<Stop> compute_forces(Scene& s, ThreadPool& pool) {
  drive_tools(s);
  const bool used_up = !follow_ways(s);
  if (used_up) {
    if (auto stop = find_not_finite(s)) return stop;
    search_contacts(s, pool);
  }
  const bool due = used_up || s.step % elements_every == 0;
  if (due) update_stable_step(s, pool);
  if (!used_up) follow_spread(s, pool);
  add_up_forces(s, pool);
  if (due || s.step % contacts_every == 0 || contacts_deepened(s) ||
      furthest_way(s) - s.bound_displacement > 0.5 * bound_margin)
    renew_stable_step(s, pool);
  set_step(s);
  // at every step: small triangles turn over within a few
  if (std::find(s.group_collapsed.begin(), s.group_collapsed.end(), 1) != s.group_collapsed.end())
    if (auto stop = find_collapsed(s)) return stop;
  if (auto stop = find_fault(s)) return stop;
  if (auto stop = find_pass_through(s)) return stop;
  if (auto stop = find_squeezed(s)) return stop;
  prescribe_nodes(s);
  return std::nullopt;
}

Energies current_energies(const Scene& s, ThreadPool& pool) {
  std::vector<Energies> of_ply(s.plies.size());
  std::vector<MembraneEnergy> of_block(s.group_blocks.size());
  const int plies = static_cast<int>(s.plies.size());
  pool.run(plies + static_cast<int>(of_block.size()), [&](int i) {
    if (i >= plies) {
      const Block& block = s.group_blocks[static_cast<std::size_t>(i - plies)];
      const PlyState& ply = s.plies[static_cast<std::size_t>(block.ply)];
      if (ply.simd)
        of_block[static_cast<std::size_t>(i - plies)] =
            simd_energy(*ply.simd, ply.membrane, ply.x, block.begin);
      return;
    }
    const PlyState& ply = s.plies[static_cast<std::size_t>(i)];
    Energies& e = of_ply[static_cast<std::size_t>(i)];
    if (!ply.simd) {
      const MembraneEnergy m = membrane_energy(ply.membrane, ply.x);
      e.fibre = m.fibre, e.shear = m.shear;
    }
    if (ply.bending) e.bending = bending_energy(*ply.bending, ply.x);
    e.kinetic = kinetic_energy(ply, s.dt, s.next_dt, mass_loads(s));
    e.external = work_of_gravity(ply, s.data.gravity);
  });
  Energies e;
  for (const MembraneEnergy& block : of_block)
    e.fibre += block.fibre, e.shear += block.shear;
  for (const Energies& ply : of_ply)
    e += ply;
  const auto add = [&e](const ContactTotals& c) {
    e.contact += c.elastic;
    e.friction += c.friction;
    e.damping += c.damping;
  };
  for (const ToolState& t : s.tools) {
    for (const ToolPlyContact& c : t.contacts)
      add(c.sums);
    e.external += t.work;
  }
  for (const BoundaryState& b : s.boundaries)
    e.external += b.work;
  for (const PlyContact& pair : s.ply_contacts)
    add(pair.contact.sums);
  for (const PlyEdgeContact& pair : s.edge_contacts)
    add(pair.contact.sums);
  for (double viscous : s.group_sums)
    e.damping += viscous;
  e.damping += s.mass_damping_work;
  e.external += s.start_energy;
  return e;
}

void move_plies(Scene& s, ThreadPool& pool) {
  const MassLoads loads = mass_loads(s);
  pool.run(static_cast<int>(s.node_blocks.size()), [&](int i) {
    const auto b = static_cast<std::size_t>(i);
    Block& block = s.node_blocks[b];
    const Stopwatch watch(block.seconds);
    s.node_sums[b] =
        move_nodes(s.plies[static_cast<std::size_t>(block.ply)], block, s.dt, s.next_dt, loads);
  });
  for (const NodeSums& n : s.node_sums)
    s.mass_damping_work += n.damping;
  s.dt = s.next_dt;
  s.time += s.dt;
  ++s.step;
}

} // namespace plyform
