// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solver/stiffness_operator.hpp"

#include "core/ply/in_plane_law.hpp"
#include "core/ply/mass_normalise.hpp"
#include "core/solver/attached_motion.hpp"
#include "core/solver/stable_time_step.hpp"

#include <algorithm>

namespace plyform {

StiffnessOperator::StiffnessOperator(const Scene& s, double dt)
    : s_(s), factors_{dt * dt, 2.0 * dt} {
  for (const PlyBody& ply : s.plies)
    add_ply(ply, dt);
  f_ = y_;
  for (const PlyPair& pair : s.ply_pairs)
    add_pair(pair);
}

void StiffnessOperator::add_ply(const PlyBody& ply, double dt) {
  const std::size_t p = y_.size();
  first_.push_back(size_);
  if (ply.resting) { // no part of what moves: without degrees of freedom
    y_.emplace_back(), yarns_.emplace_back(), on_ply_.emplace_back();
    bounded_.push_back(0.0);
    return;
  }
  size_ += static_cast<Eigen::Index>(3 * ply.x.size());
  y_.emplace_back(ply.x.size());
  Frequencies bounded{ply.bound.soft, s_.data.solver.mass_damping};
  if (ply.bending) bounded.omega2 += ply.bending->omega2;
  yarns_.emplace_back();
  if (in_plane_law(ply.membrane.fabric).yarns)
    yarns_.back() = std::make_unique<YarnStiffness>(
        ply.membrane, ply.x, kink_factor(ply.membrane) * factors_.stiffness, factors_.damping);
  else
    bounded.omega2 += ply.bound.yarns;
  bounded_.push_back(bounded.stability_lhs(dt));
  std::vector<ContactTangent>& on_ply = on_ply_.emplace_back();
  for (const ToolState& tool : s_.tools)
    append_tangents(tool.contacts[p], ply.membrane.node_area, s_.bound_margin, factors_, on_ply);
}

void StiffnessOperator::add_pair(const PlyPair& pair) {
  Pair to{static_cast<std::size_t>(pair.a), static_cast<std::size_t>(pair.b), {}, {}, {}, {}};
  const PlyBody &a = s_.plies[to.a], &b = s_.plies[to.b];
  for (const int i : pair.contacts) {
    const PlyContact& c = s_.ply_contacts[i];
    const bool up = c.slave == pair.a;
    const PlyBody &slave = up ? a : b, &master = up ? b : a;
    append_tangents(c.contact, slave.state(), master.state(), master.membrane.triangles,
                    s_.bound_margin, factors_, up ? to.up : to.down);
  }
  for (const int i : pair.edges)
    append_tangents(s_.edge_contacts[i].contact, a.state(), b.state(), edge_margin(s_), factors_,
                    to.up);
  if (to.up.empty() && to.down.empty()) return;
  to.force_a.resize(a.x.size());
  to.force_b.resize(b.x.size());
  pairs_.push_back(std::move(to));
}

Eigen::VectorXd StiffnessOperator::apply(const Eigen::VectorXd& v, ThreadPool& pool) {
  const int plies = static_cast<int>(y_.size());
  pool.run(plies, [&](int p) { scale(v, static_cast<std::size_t>(p)); });
  pool.run(plies + static_cast<int>(pairs_.size()), [&](int i) { // longest tasks first
    if (i < plies)
      on_ply(static_cast<std::size_t>(i));
    else
      on_pair(pairs_[i - plies]);
  });
  add_attachment_forces(s_, factors_.stiffness, y_, f_);
  Eigen::VectorXd w(size_);
  pool.run(plies, [&](int p) { gather(static_cast<std::size_t>(p), w); });
  return w;
}

Eigen::VectorXd StiffnessOperator::start() const {
  Eigen::VectorXd v(size_);
  for (std::size_t p = 0; p < y_.size(); ++p)
    if (!s_.plies[p].resting)
      v.segment(first_[p], degrees_of_freedom(p)) =
          scattered_motion(s_.plies[p].membrane, s_.plies[p].x);
  return v;
}

Eigen::Index StiffnessOperator::degrees_of_freedom(std::size_t p) const {
  return static_cast<Eigen::Index>(3 * y_[p].size());
}

void StiffnessOperator::scale(const Eigen::VectorXd& v, std::size_t p) {
  over_root_of_mass(s_.plies[p].mass, v.segment(first_[p], degrees_of_freedom(p)), y_[p]);
}

void StiffnessOperator::on_ply(std::size_t p) {
  for (std::size_t n = 0; n < f_[p].size(); ++n)
    f_[p][n] = bounded_[p] * s_.plies[p].mass[n] * y_[p][n];
  if (yarns_[p]) yarns_[p]->add_to(y_[p], f_[p]);
  add_tangent_forces(on_ply_[p], y_[p], y_[p], f_[p], f_[p]);
}

void StiffnessOperator::on_pair(Pair& pair) {
  std::fill(pair.force_a.begin(), pair.force_a.end(), Vec3::Zero());
  std::fill(pair.force_b.begin(), pair.force_b.end(), Vec3::Zero());
  add_tangent_forces(pair.up, y_[pair.a], y_[pair.b], pair.force_a, pair.force_b);
  add_tangent_forces(pair.down, y_[pair.b], y_[pair.a], pair.force_b, pair.force_a);
}

void StiffnessOperator::gather(std::size_t p, Eigen::VectorXd& w) {
  const auto add = [this, p](const std::vector<Vec3>& force) {
    for (std::size_t n = 0; n < force.size(); ++n)
      f_[p][n] += force[n];
  };
  for (const Pair& pair : pairs_) {
    if (pair.a == p) add(pair.force_a);
    if (pair.b == p) add(pair.force_b);
  }
  over_root_of_mass(s_.plies[p].mass, std::span<const Vec3>(f_[p]),
                    w.segment(first_[p], degrees_of_freedom(p)));
}

} // namespace plyform
