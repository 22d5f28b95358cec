// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solver/stable_time_step.hpp"

#include "core/base/lanczos.hpp"
#include "core/solver/stiffness_operator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plyform {
namespace {

constexpr int lanczos_interval = 1000; // steps; eigenvalue ratios change more slowly than bounds

/// Row sums of the contact matrices, per ply and node.
using ContactRows = std::vector<std::vector<ContactRow>>;

/// Row sums of the contacts between two plies, per node of each.
struct PairRows {
  std::vector<ContactRow> a, b;
};

PairRows rows_of(const Scene& s, const PlyPair& pair) {
  const PlyState &a = s.plies[pair.a], &b = s.plies[pair.b];
  PairRows rows;
  const auto begin = [&] {
    rows.a.resize(a.x.size());
    rows.b.resize(b.x.size());
  };
  for (const int i : pair.contacts) {
    const PlyContact& c = s.ply_contacts[i];
    if (c.contact.points.empty()) continue;
    begin();
    const bool up = c.slave == pair.a;
    const PlyState& master = up ? b : a;
    add_ply_ply_stiffness(c.contact, master.state(), master.membrane.triangles, bound_margin,
                          up ? rows.a : rows.b, up ? rows.b : rows.a);
  }
  for (const int i : pair.edges) {
    const EdgeEdgeContact& contact = s.edge_contacts[i].contact;
    if (contact.pairs.empty()) continue;
    begin();
    add_edge_stiffness(contact, edge_margin, rows.a, rows.b);
  }
  return rows;
}

ContactRows contact_rows(const Scene& s, ThreadPool& pool) {
  std::vector<PairRows> of_pair(s.ply_pairs.size());
  pool.run(static_cast<int>(of_pair.size()), [&](int i) {
    const auto pair = static_cast<std::size_t>(i);
    of_pair[pair] = rows_of(s, s.ply_pairs[pair]);
  });
  ContactRows c;
  for (std::size_t p = 0; p < s.plies.size(); ++p) {
    const PlyState& ply = s.plies[p];
    std::vector<ContactRow>& rows = c.emplace_back(ply.x.size());
    for (const ToolState& tool : s.tools)
      add_tool_ply_stiffness(tool.contacts[p], ply.membrane.node_area, bound_margin, rows);
  }
  const auto add = [&c](int ply, const std::vector<ContactRow>& rows) {
    std::vector<ContactRow>& to = c[ply];
    for (std::size_t n = 0; n < rows.size(); ++n)
      to[n] += rows[n];
  };
  for (std::size_t i = 0; i < of_pair.size(); ++i) {
    add(s.ply_pairs[i].a, of_pair[i].a);
    add(s.ply_pairs[i].b, of_pair[i].b);
  }
  return c;
}

/// Bounds of one ply: of its elements, with the eigenvalue ratio applied, and of its contacts.
struct PlyBound {
  Frequencies elements, contacts;

  double sum_step() const {
    return Frequencies{elements.omega2 + contacts.omega2, elements.damping + contacts.damping}
        .step();
  }

  /// Stable time step (s) of the sum of both bounds, with the gain applied to the elements and to
  /// the bound of contacts up to `known` (1/s^2), its value when the gain was computed. The
  /// increase of contact stiffness since then counts in full: a single deep contact is as stiff as
  /// its row sum.
  double step_with_gain(double time_step_gain, double known) const {
    const double grown = std::max(contacts.omega2 - known, 0.0);
    return Frequencies{
        (elements.omega2 + contacts.omega2 - grown) / (time_step_gain * time_step_gain) + grown,
        (elements.damping + contacts.damping) / time_step_gain}
        .step();
  }
};

PlyBound bound_of(const Scene& s, const ContactRows& touching, std::size_t p) {
  const PlyState& ply = s.plies[p];
  const EigenvalueBound& b = ply.bound;
  PlyBound of;
  of.elements = {
      highest_omega2(b, ply.eigenvalue_ratio) + (ply.bending ? ply.bending->omega2 : 0.0),
      b.penalty_acts ? b.damping : std::min(b.damping, ply.eigenvalue_ratio * b.yarns * b.viscous)};
  of.elements.damping += s.data.solver.mass_damping;
  for (std::size_t n = 0; n < ply.x.size(); ++n) {
    const ContactRow& row = touching[p][n];
    const double mass = ply.membrane.node_mass[n];
    of.contacts.omega2 = std::max(of.contacts.omega2, row.stiffness / mass);
    of.contacts.damping = std::max(of.contacts.damping, row.damping / mass);
  }
  return of;
}

/// Ratio of the stable time step of the whole scene, by Lanczos' iteration, to `dt` (s).
double time_step_gain_of(const Scene& s, double dt, ThreadPool& pool) {
  StiffnessOperator product(s, dt);
  const double lhs =
      ritz_margin *
      largest_ritz_value([&](const Eigen::VectorXd& v) { return product.apply(v, pool); },
                         product.start(), ritz_steps);
  return lhs <= 4.0 ? std::sqrt(4.0 / lhs) : 4.0 / lhs; // (S) is convex in dt
}

} // namespace

StepBound stable_step(const Scene& s, ThreadPool& pool) {
  const ContactRows touching = contact_rows(s, pool);
  StepBound bound;
  for (std::size_t p = 0; p < s.plies.size(); ++p) {
    const PlyBound of = bound_of(s, touching, p);
    double dt = std::min(of.step_with_gain(s.time_step_gain, s.plies[p].lanczos_contacts),
                         of.elements.step());
    if (of.contacts.omega2 > 0.0) dt = std::min(dt, of.contacts.step());
    if (bound.ply < 0 || !(dt >= bound.dt))
      bound = {dt, of.elements.omega2 + of.contacts.omega2, static_cast<int>(p),
               s.plies[p].bound.triangle};
  }
  return bound;
}

void update_stable_step(Scene& s, ThreadPool& pool) {
  const bool lanczos_due = s.step >= s.next_lanczos;
  pool.run(static_cast<int>(s.plies.size()), [&](int p) {
    PlyState& ply = s.plies[p];
    const Stopwatch watch(ply.search_seconds);
    ply.bound = eigenvalue_bound(ply.membrane, ply.x);
    if (lanczos_due) ply.eigenvalue_ratio = eigenvalue_ratio(ply.membrane, ply.x);
  });
  if (!lanczos_due) return;
  s.next_lanczos = s.step + lanczos_interval;
  const ContactRows touching = contact_rows(s, pool);
  double dt = std::numeric_limits<double>::infinity();
  for (std::size_t p = 0; p < s.plies.size(); ++p) {
    const PlyBound of = bound_of(s, touching, p);
    s.plies[p].lanczos_contacts = of.contacts.omega2;
    dt = std::min(dt, of.sum_step());
  }
  const double time_step_gain =
      s.time_step_gain * time_step_gain_of(s, s.time_step_gain * dt, pool);
  // the gain is rounded down, so that rounding errors of the iteration have no effect
  constexpr double grain = 1e-3;
  s.time_step_gain = std::max(1.0, grain * std::floor(time_step_gain / grain));
}

} // namespace plyform
