// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/step_bound.hpp"

#include "contact/contact_springs.hpp"
#include "core/lanczos.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace plyform {
namespace {

constexpr int sharpen_every = 1000; // steps: ratios change slower than bounds
constexpr double edge_margin = 0.25 * bound_margin;

/// k and c of (S), 1/s^2 and 1/s.
struct Frequencies {
  double omega2 = 0.0, damping = 0.0;

  double left_of_s(double dt) const { return dt * dt * omega2 + 2.0 * dt * damping; }
  double step() const { return (std::sqrt(damping * damping + 4.0 * omega2) - damping) / omega2; }
};

/// Row sums of contact stiffness of each ply's nodes, N/mm, and the largest c/k of any contact.
struct ContactRows {
  std::vector<std::vector<double>> rows;
  double damping_ratio = 0.0;
};

/// What the contacts between two plies add to the rows of both.
struct PairRows {
  std::vector<double> a, b;
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

double largest_damping_ratio(const Scene& s) {
  double largest = 0.0;
  const auto grow = [&largest](const ContactLaw& law) {
    largest = std::max(largest, law.damping / law.stiffness);
  };
  for (const ToolAndContacts& tool : s.tools)
    for (const ToolContact& c : tool.contacts)
      if (!c.points.empty()) grow(c.law);
  for (const PlyContact& pair : s.ply_contacts)
    if (!pair.contact.points.empty()) grow(pair.contact.law);
  return largest;
}

ContactRows contact_rows(const Scene& s, ThreadTeam& team) {
  std::vector<PairRows> of_pair(s.ply_pairs.size());
  team.run(static_cast<int>(of_pair.size()), [&](int i) {
    const auto pair = static_cast<std::size_t>(i);
    of_pair[pair] = rows_of(s, s.ply_pairs[pair]);
  });
  ContactRows c{{}, largest_damping_ratio(s)};
  for (std::size_t p = 0; p < s.plies.size(); ++p) {
    const PlyBody& ply = s.plies[p];
    std::vector<double>& rows = c.rows.emplace_back(ply.x.size(), 0.0);
    for (const ToolAndContacts& tool : s.tools)
      add_tool_stiffness(tool.contacts[p], ply.membrane.node_area, bound_margin, rows);
  }
  const auto add = [&c](int ply, const std::vector<double>& rows) {
    std::vector<double>& to = c.rows[static_cast<std::size_t>(ply)];
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
};

PlyBound bound_of(const Scene& s, const ContactRows& touching, std::size_t p) {
  const PlyBody& ply = s.plies[p];
  const FrequencyBound& b = ply.bound;
  PlyBound of;
  of.elements = {highest_omega2(b, ply.sharpness) + (ply.bending ? ply.bending->omega2 : 0.0),
                 b.guarded ? b.damping : std::min(b.damping, ply.sharpness * b.yarns * b.viscous)};
  of.elements.damping += s.data.solver.mass_damping;
  for (std::size_t n = 0; n < ply.x.size(); ++n)
    of.contacts.omega2 =
        std::max(of.contacts.omega2, touching.rows[p][n] / ply.membrane.node_mass[n]);
  of.contacts.damping = of.contacts.omega2 * touching.damping_ratio;
  return of;
}

/// dt^2 K + 2 dt C of the whole scene. What is small in it, or not known, by its bound: shear,
/// tension and bending; sheets without yarns.
class SceneProduct {
public:
  SceneProduct(const Scene& s, double dt) : s_(s) {
    const SpringFactors factors{dt * dt, 2.0 * dt};
    for (const PlyBody& ply : s.plies) {
      first_.push_back(size_);
      size_ += static_cast<Eigen::Index>(3 * ply.x.size());
      y_.emplace_back(ply.x.size());
      Frequencies bounded{ply.bound.soft, s.data.solver.mass_damping};
      if (ply.bending) bounded.omega2 += ply.bending->omega2;
      yarns_.emplace_back();
      if (ply.membrane.fabric.isotropic)
        bounded.omega2 += ply.bound.yarns;
      else
        yarns_.back() =
            std::make_unique<YarnProduct>(ply.membrane, ply.x, factors.stiffness, factors.damping);
      bounded_.push_back(bounded.left_of_s(dt));
      std::vector<ContactSpring>& on_ply = on_ply_.emplace_back();
      const std::size_t p = on_ply_.size() - 1;
      for (const ToolAndContacts& tool : s.tools)
        append_springs(tool.contacts[p], ply.membrane.node_area, bound_margin, factors, on_ply);
    }
    f_ = y_;
    for (const PlyPair& pair : s.ply_pairs)
      add_pair(pair, factors);
  }

  /// M^-1/2 (dt^2 K + 2 dt C) M^-1/2 v, v: the plies' nodes one after the other.
  Eigen::VectorXd times(const Eigen::VectorXd& v, ThreadTeam& team) {
    const int plies = static_cast<int>(y_.size());
    team.run(plies, [&](int p) { scale(v, static_cast<std::size_t>(p)); });
    team.run(plies + static_cast<int>(pairs_.size()), [&](int i) { // longest tasks first
      if (i < plies)
        on_ply(static_cast<std::size_t>(i));
      else
        on_pair(pairs_[static_cast<std::size_t>(i - plies)]);
    });
    Eigen::VectorXd w(size_);
    team.run(plies, [&](int p) { gather(static_cast<std::size_t>(p), w); });
    return w;
  }

  Eigen::VectorXd start() const {
    Eigen::VectorXd v(size_);
    for (std::size_t p = 0; p < y_.size(); ++p)
      v.segment(first_[p], static_cast<Eigen::Index>(3 * y_[p].size())) =
          scattered_motion(s_.plies[p].membrane, s_.plies[p].x);
    return v;
  }

private:
  /// Two directed contacts, and the edges.
  struct Pair {
    std::size_t a, b;
    std::vector<ContactSpring> up, down; ///< own nodes are of a; of b
    std::vector<Vec3> force_a, force_b;
  };

  void add_pair(const PlyPair& pair, const SpringFactors& factors) {
    Pair to{static_cast<std::size_t>(pair.a), static_cast<std::size_t>(pair.b), {}, {}, {}, {}};
    const PlyBody &a = s_.plies[to.a], &b = s_.plies[to.b];
    for (const int i : pair.contacts) {
      const PlyContact& c = s_.ply_contacts[static_cast<std::size_t>(i)];
      const bool up = c.slave == pair.a;
      const PlyBody &slave = up ? a : b, &master = up ? b : a;
      append_springs(c.contact, slave.state(), master.state(), master.membrane.triangles,
                     bound_margin, factors, up ? to.up : to.down);
    }
    for (const int i : pair.edges)
      append_springs(s_.edge_contacts[static_cast<std::size_t>(i)].contact, a.state(), b.state(),
                     edge_margin, factors, to.up);
    if (to.up.empty() && to.down.empty()) return;
    to.force_a.resize(a.x.size());
    to.force_b.resize(b.x.size());
    pairs_.push_back(std::move(to));
  }

  double root_of_mass(std::size_t p, std::size_t n) const {
    return std::sqrt(s_.plies[p].membrane.node_mass[n]);
  }

  void scale(const Eigen::VectorXd& v, std::size_t p) {
    for (std::size_t n = 0; n < y_[p].size(); ++n)
      y_[p][n] = v.segment<3>(first_[p] + static_cast<Eigen::Index>(3 * n)) / root_of_mass(p, n);
  }

  void on_ply(std::size_t p) {
    for (std::size_t n = 0; n < f_[p].size(); ++n)
      f_[p][n] = bounded_[p] * s_.plies[p].membrane.node_mass[n] * y_[p][n];
    if (yarns_[p]) yarns_[p]->add_to(y_[p], f_[p]);
    add_spring_forces(on_ply_[p], y_[p], y_[p], f_[p], f_[p]);
  }

  void on_pair(Pair& pair) {
    std::fill(pair.force_a.begin(), pair.force_a.end(), Vec3::Zero());
    std::fill(pair.force_b.begin(), pair.force_b.end(), Vec3::Zero());
    add_spring_forces(pair.up, y_[pair.a], y_[pair.b], pair.force_a, pair.force_b);
    add_spring_forces(pair.down, y_[pair.b], y_[pair.a], pair.force_b, pair.force_a);
  }

  void gather(std::size_t p, Eigen::VectorXd& w) {
    const auto add = [this, p](const std::vector<Vec3>& force) {
      for (std::size_t n = 0; n < force.size(); ++n)
        f_[p][n] += force[n];
    };
    for (const Pair& pair : pairs_) {
      if (pair.a == p) add(pair.force_a);
      if (pair.b == p) add(pair.force_b);
    }
    for (std::size_t n = 0; n < f_[p].size(); ++n)
      w.segment<3>(first_[p] + static_cast<Eigen::Index>(3 * n)) = f_[p][n] / root_of_mass(p, n);
  }

  const Scene& s_;
  Eigen::Index size_ = 0;
  std::vector<double> bounded_; ///< of each ply, its part of the left side of (S)
  std::vector<Eigen::Index> first_;
  std::vector<std::unique_ptr<YarnProduct>> yarns_;
  std::vector<std::vector<ContactSpring>> on_ply_;
  std::vector<Pair> pairs_;
  std::vector<std::vector<Vec3>> y_, f_;
};

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
    double dt = std::min(s.stretch * of.sum_step(), of.elements.step());
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
  for (std::size_t p = 0; p < s.plies.size(); ++p)
    dt = std::min(dt, bound_of(s, touching, p).sum_step());

  const double stretch = s.stretch * stretch_of(s, s.stretch * dt, team);
  constexpr double grain = 1e-3; // so that what rounding does to the iteration goes no further
  s.stretch = std::max(1.0, grain * std::floor(stretch / grain));
}

} // namespace plyform
