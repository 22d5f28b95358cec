// SPDX-License-Identifier: GPL-3.0-or-later
// Contacts of tools and of plies, and boundaries, as kinds of force.
#include "base/format.hpp"
#include "base/stopwatch.hpp"
#include "core/solver/attached_motion.hpp"
#include "core/solver/displacements.hpp"
#include "core/solver/scene.hpp"
#include "core/solver/step_faults.hpp"

#include <algorithm>

namespace plyform {
namespace {

void add_sums(const ContactLaw& law, const ContactTotals& sums, Energies& e) {
  e.contact += sums.elastic;
  e.compaction += sums.compaction;
  (law.has_film() ? e.film : e.friction) += sums.friction;
  e.damping += sums.damping;
}

void add(const std::vector<ContactRow>& rows, std::span<ContactRow> to) {
  for (std::size_t n = 0; n < rows.size(); ++n)
    to[n] += rows[n];
}

/// The node of the deepest of some points.
template <class Points>
int deepest_node(const Points& points) {
  return std::min_element(points.begin(), points.end(),
                          [](const auto& a, const auto& b) { return a.gap < b.gap; })
      ->node;
}

const std::string& name_of(const Layup& layup, int ply) {
  return layup.plies[at(ply)].name;
}

} // namespace

double ToolContacts::place(const Layup&, int task) const {
  return static_cast<double>(task) / static_cast<double>(tools.size());
}

void ToolContacts::run(Layup& layup, int task) {
  ToolState& t = tools[at(task)];
  const Stopwatch watch(t.seconds);
  const Vec3 before = t.force;
  for (std::size_t p = 0; p < layup.plies.size(); ++p)
    t.ply_paths[p] = path_length_ahead(t, layup.dt) + layup.plies[p].path_length;
  t.force = tool_ply_forces(t.body, t.contacts, layup.ply_states, t.ply_paths, layup.dt);
  t.work -= 0.5 * (before + t.force).dot(t.body.motion);
}

void ToolContacts::list_arrays(Layup& layup) {
  for (const ToolState& t : tools)
    for (std::size_t p = 0; p < layup.plies.size(); ++p)
      if (!t.contacts[p].list.active.empty())
        layup.plies[p].nodal_forces.push_back(&t.contacts[p].force);
}

void ToolContacts::add_energies(const Layup&, ThreadPool&, Energies& e) const {
  for (const ToolState& t : tools) {
    for (const ToolPlyContact& c : t.contacts)
      add_sums(c.law, c.sums, e);
    e.external += t.work;
  }
}

void ToolContacts::add_rows(const Layup& layup, std::size_t ply, std::span<ContactRow> rows) const {
  for (const ToolState& tool : tools)
    add_tool_ply_stiffness(tool.contacts[ply], layup.plies[ply].state(), layup.bound_margin, rows);
}

void ToolContacts::add_times(Times& times) const {
  for (const ToolState& tool : tools) {
    times.contact += tool.seconds;
    for (const ToolPlyContact& c : tool.contacts)
      times.search += c.time.search;
  }
}

void ToolContacts::add_seen(const Layup& layup, std::vector<PairSeen>& seen) const {
  for (const ToolState& t : tools)
    for (std::size_t p = 0; p < layup.plies.size(); ++p) {
      const ToolPlyContact& c = t.contacts[p];
      seen.push_back({t.name, layup.plies[p].name, c.law, c.sums, c.time.forces + c.time.search});
    }
}

std::string ToolContacts::who(const Layup& layup, std::size_t tool, std::size_t ply) const {
  return fmt::format("ply {}, node {}, and tool {}", layup.plies[ply].name,
                     deepest_node(tools[tool].contacts[ply].points), tools[tool].name);
}

double PlyContacts::place(const Layup& layup, int task) const {
  const PlyPair& pair = ply_pairs[at(task)];
  return 0.5 * (pair.a + pair.b + 1) / static_cast<double>(layup.plies.size());
}

void PlyContacts::run(Layup& layup, int task) {
  PlyPair& pair = ply_pairs[at(task)];
  if (pair.loaded) {
    std::fill(pair.force_a.begin(), pair.force_a.end(), Vec3::Zero());
    std::fill(pair.force_b.begin(), pair.force_b.end(), Vec3::Zero());
  }
  pair.loaded = false;
  const PlyBody &a = layup.plies[at(pair.a)], &b = layup.plies[at(pair.b)];
  for (PlyContact& pass : pair.passes) {
    const bool up = pass.slave == pair.a;
    const PlyBody &slave = up ? a : b, &master = up ? b : a;
    ply_ply_forces(pass.contact, slave.state(), master.state(), master.membrane.triangles, layup.dt,
                   {a.max_displacement + b.max_displacement, a.path_length + b.path_length},
                   up ? pair.force_a : pair.force_b, up ? pair.force_b : pair.force_a);
    pair.loaded = pair.loaded || pass.contact.sums.touching > 0;
  }
  EdgeEdgeContact& edges = pair.edges.contact;
  edge_forces(edges, a.edge_sheet(), b.edge_sheet(), layup.dt, pair.force_a, pair.force_b);
  pair.loaded = pair.loaded || edges.sums.touching > 0;
}

void PlyContacts::list_arrays(Layup& layup) {
  for (const PlyPair& pair : ply_pairs) {
    if (!pair.loaded) continue;
    layup.plies[at(pair.a)].nodal_forces.push_back(&pair.force_a);
    layup.plies[at(pair.b)].nodal_forces.push_back(&pair.force_b);
  }
}

void PlyContacts::add_energies(const Layup&, ThreadPool&, Energies& e) const {
  each_pass(*this, [&](const PlyContact& pass) {
    add_sums(pass.contact.law, pass.contact.sums, e);
    e.external += pass.contact.sums.vacuum;
  });
  each_edge_contact(*this, [&](const PlyEdgeContact& edges) {
    add_sums(edges.contact.law, edges.contact.sums, e);
  });
}

void PlyContacts::add_rows(const Layup&, std::size_t ply, std::span<ContactRow> rows) const {
  for (const PlyPair& pair : ply_pairs) {
    if (at(pair.a) == ply) add(pair.rows_a, rows);
    if (at(pair.b) == ply) add(pair.rows_b, rows);
  }
}

std::optional<Stop> PlyContacts::fault(const Layup& layup) const {
  return find_fault(*this, layup);
}

void PlyContacts::add_times(Times& times) const {
  const auto add_time = [&times](const auto& contact) {
    times.contact += contact.time.forces, times.search += contact.time.search;
  };
  each_pass(*this, [&](const PlyContact& c) { add_time(c.contact); });
  each_edge_contact(*this, [&](const PlyEdgeContact& c) { add_time(c.contact); });
}

void PlyContacts::add_seen(const Layup& layup, std::vector<PairSeen>& seen) const {
  const auto add = [&](int a, int b, const auto& contact, bool of_edges) {
    seen.push_back({name_of(layup, std::min(a, b)), name_of(layup, std::max(a, b)), contact.law,
                    contact.sums, contact.time.forces + contact.time.search, of_edges});
  };
  each_pass(*this, [&](const PlyContact& c) { add(c.slave, c.master, c.contact, false); });
  each_edge_contact(*this, [&](const PlyEdgeContact& c) { add(c.a, c.b, c.contact, true); });
}

std::string PlyContacts::who(const Layup& layup, const PlyContact& pass) {
  return fmt::format("ply {}, node {}, and ply {}", name_of(layup, pass.slave),
                     deepest_node(pass.contact.points), name_of(layup, pass.master));
}

std::string PlyContacts::who(const Layup& layup, const PlyEdgeContact& edges) {
  return fmt::format("edges of plies {} and {}", name_of(layup, edges.a), name_of(layup, edges.b));
}

void BoundaryForces::finish(Scene& s, ThreadPool&) {
  pull_springs(*this, s, s.tools);
}

void BoundaryForces::list_arrays(Layup& layup) {
  for (PlyBody& ply : layup.plies) {
    if (!ply.reaction.empty()) ply.nodal_forces.push_back(&ply.reaction);
    if (!ply.pull.empty()) ply.nodal_forces.push_back(&ply.pull);
  }
}

void BoundaryForces::add_energies(const Layup&, ThreadPool&, Energies& e) const {
  for (const BoundaryState& b : boundaries)
    e.external += b.work;
}

void BoundaryForces::add_rows(const Layup& layup, std::size_t ply,
                              std::span<ContactRow> rows) const {
  add_attachment_stiffness(*this, layup, ply, rows);
}

} // namespace plyform
