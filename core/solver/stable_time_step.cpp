// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solver/stable_time_step.hpp"

#include "core/base/lanczos.hpp"
#include "core/solver/stiffness_operator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plyform {
namespace {

constexpr int sharpen_every = 1000; // steps: ratios change slower than bounds

/// Row sums of the contact matrices, of each ply's nodes.
using ContactRows = std::vector<std::vector<ContactRow>>;

/// What the contacts between two plies add to the rows of both.
struct PairRows {
  std::vector<ContactRow> a, b;
};

PairRows rows_of(const Scene& s, const PlyPair& pair) {
  const PlyBody &a = s.plies[static_cast<std::size_t>(pair.a)],
                &b = s.plies[static_cast<std::size_t>(pair.b)];
  PairRows rows;
  const auto begin = [&] {
    rows.a.resize(a.x.size());
    rows.b.resize(b.x.size());
  };
  for (const int i : pair.contacts) {
    const PlyContact& c = s.ply_contacts[static_cast<std::size_t>(i)];
    if (c.contact.points.empty()) continue;
    begin();
    const bool up = c.slave == pair.a;
    const PlyBody& master = up ? b : a;
    add_sheet_stiffness(c.contact, master.state(), master.membrane.triangles, bound_margin,
                        up ? rows.a : rows.b, up ? rows.b : rows.a);
  }
  for (const int i : pair.edges) {
    const EdgeContact& contact = s.edge_contacts[static_cast<std::size_t>(i)].contact;
    if (contact.pairs.empty()) continue;
    begin();
    add_edge_stiffness(contact, edge_margin, rows.a, rows.b);
  }
  return rows;
}

ContactRows contact_rows(const Scene& s, ThreadTeam& team) {
  std::vector<PairRows> of_pair(s.ply_pairs.size());
  team.run(static_cast<int>(of_pair.size()), [&](int i) {
    const auto pair = static_cast<std::size_t>(i);
    of_pair[pair] = rows_of(s, s.ply_pairs[pair]);
  });
  ContactRows c;
  for (std::size_t p = 0; p < s.plies.size(); ++p) {
    const PlyBody& ply = s.plies[p];
    std::vector<ContactRow>& rows = c.emplace_back(ply.x.size());
    for (const ToolAndContacts& tool : s.tools)
      add_tool_stiffness(tool.contacts[p], ply.membrane.node_area, bound_margin, rows);
  }
  const auto add = [&c](int ply, const std::vector<ContactRow>& rows) {
    std::vector<ContactRow>& to = c[static_cast<std::size_t>(ply)];
    for (std::size_t n = 0; n < rows.size(); ++n)
      to[n] += rows[n];
  };
  for (std::size_t i = 0; i < of_pair.size(); ++i) {
    add(s.ply_pairs[i].a, of_pair[i].a);
    add(s.ply_pairs[i].b, of_pair[i].b);
  }
  return c;
}

/// Bounds of one ply: of its elements, yarns sharpened, and of contacts on it.
struct PlyBound {
  Frequencies elements, contacts;

  double sum_step() const {
    return Frequencies{elements.omega2 + contacts.omega2, elements.damping + contacts.damping}
        .step();
  }

  /// The step of the sum, whose part up to `known` (1/s^2) of contacts is `stretch` times as long
  /// as the sum says. What contacts have grown by since that was found counts in full: a single
  /// deep contact is as stiff as its row.
  double sharpened_step(double stretch, double known) const {
    const double grown = std::max(contacts.omega2 - known, 0.0);
    return Frequencies{(elements.omega2 + contacts.omega2 - grown) / (stretch * stretch) + grown,
                       (elements.damping + contacts.damping) / stretch}
        .step();
  }
};

PlyBound bound_of(const Scene& s, const ContactRows& touching, std::size_t p) {
  const PlyBody& ply = s.plies[p];
  const FrequencyBound& b = ply.bound;
  PlyBound of;
  of.elements = {highest_omega2(b, ply.sharpness) + (ply.bending ? ply.bending->omega2 : 0.0),
                 b.guarded ? b.damping : std::min(b.damping, ply.sharpness * b.yarns * b.viscous)};
  of.elements.damping += s.data.solver.mass_damping;
  for (std::size_t n = 0; n < ply.x.size(); ++n) {
    const ContactRow& row = touching[p][n];
    const double mass = ply.membrane.node_mass[n];
    of.contacts.omega2 = std::max(of.contacts.omega2, row.stiffness / mass);
    of.contacts.damping = std::max(of.contacts.damping, row.damping / mass);
  }
  return of;
}

/// How much longer than `dt` the stable step is.
double stretch_of(const Scene& s, double dt, ThreadTeam& team) {
  SceneProduct product(s, dt);
  const double left =
      ritz_margin *
      largest_ritz_value([&](const Eigen::VectorXd& v) { return product.times(v, team); },
                         product.start(), ritz_steps);
  return left <= 4.0 ? std::sqrt(4.0 / left) : 4.0 / left; // (S) is convex in dt
}

} // namespace

StepBound stable_step(const Scene& s, ThreadTeam& team) {
  const ContactRows touching = contact_rows(s, team);
  StepBound bound;
  for (std::size_t p = 0; p < s.plies.size(); ++p) {
    const PlyBound of = bound_of(s, touching, p);
    double dt =
        std::min(of.sharpened_step(s.stretch, s.plies[p].stretch_contacts), of.elements.step());
    if (of.contacts.omega2 > 0.0) dt = std::min(dt, of.contacts.step());
    if (bound.ply < 0 || !(dt >= bound.dt))
      bound = {dt, of.elements.omega2 + of.contacts.omega2, static_cast<int>(p),
               s.plies[p].bound.triangle};
  }
  return bound;
}

void renew_bounds(Scene& s, ThreadTeam& team) {
  const bool sharpen = s.step >= s.next_sharpening;
  team.run(static_cast<int>(s.plies.size()), [&](int p) {
    PlyBody& ply = s.plies[static_cast<std::size_t>(p)];
    const Stopwatch watch(ply.search_seconds);
    ply.bound = frequency_bound(ply.membrane, ply.x);
    if (sharpen) ply.sharpness = sharpness(ply.membrane, ply.x);
  });
  if (!sharpen) return;
  s.next_sharpening = s.step + sharpen_every;
  const ContactRows touching = contact_rows(s, team);
  double dt = std::numeric_limits<double>::infinity();
  for (std::size_t p = 0; p < s.plies.size(); ++p) {
    const PlyBound of = bound_of(s, touching, p);
    s.plies[p].stretch_contacts = of.contacts.omega2;
    dt = std::min(dt, of.sum_step());
  }
  const double stretch = s.stretch * stretch_of(s, s.stretch * dt, team);
  constexpr double grain = 1e-3; // so that what rounding does to the iteration goes no further
  s.stretch = std::max(1.0, grain * std::floor(stretch / grain));
}

} // namespace plyform
