// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solver/stiffness_operator.hpp"

#include "core/ply/mass_normalise.hpp"

namespace plyform {

StiffnessOperator::StiffnessOperator(const Scene& s, double dt)
    : s_(s), products_(ProductsOf<Forces>::make(s, {dt * dt, 2.0 * dt})) {
  for (const PlyBody& ply : s.plies) {
    first_.push_back(size_);
    y_.emplace_back();
    Frequencies bounded{0.0, s.data.solver.mass_damping};
    if (ply.resting) { // no part of what moves: without degrees of freedom
      bounded_.push_back(0.0);
      continue;
    }
    size_ += static_cast<Eigen::Index>(3 * ply.x.size());
    y_.back().resize(ply.x.size());
    each_kind_of([&]<class K>() { K::add_bound_of_rest(ply, bounded); });
    bounded_.push_back(bounded.stability_lhs(dt));
  }
  f_ = y_;
}

Eigen::VectorXd StiffnessOperator::apply(const Eigen::VectorXd& v, ThreadPool& pool) {
  const int plies = static_cast<int>(y_.size());
  pool.run(plies, [&](int p) { scale(v, at(p)); });
  int tasks = 0;
  each_product([&](auto& product) { tasks += product.tasks(); });
  pool.run(plies + tasks, [&](int i) { // longest tasks first
    if (i < plies) return on_ply(at(i));
    int first = plies;
    each_product([&](auto& product) {
      const int task = i - first;
      first += product.tasks();
      if (task >= 0 && task < product.tasks()) product.run(task, y_);
    });
  });
  each_product([&](const auto& product) { product.add_between(y_, f_); });
  Eigen::VectorXd w(size_);
  pool.run(plies, [&](int p) { gather(at(p), w); });
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
  if (!s_.plies[p].resting)
    each_product([&](const auto& product) { product.add_on_ply(p, y_, f_); });
}

void StiffnessOperator::gather(std::size_t p, Eigen::VectorXd& w) {
  each_product([&](const auto& product) { product.gather(p, f_); });
  over_root_of_mass(s_.plies[p].mass, std::span<const Vec3>(f_[p]),
                    w.segment(first_[p], degrees_of_freedom(p)));
}

} // namespace plyform
