// SPDX-License-Identifier: GPL-3.0-or-later
// Products of vectors with dt^2 K + 2 dt C of a whole scene, for (S) of
// core/solver/stable_time_step.hpp: yarns taut, contacts sticking, at the present positions. Small
// or unassembled parts are represented by their bounds: shear, geometric stiffness and bending;
// sheets without yarns.
#pragma once

#include "base/thread_pool.hpp"
#include "core/solver/scene.hpp"

#include <Eigen/Core>
#include <tuple>
#include <vector>

namespace plyform {

/// The products of the kinds of a list.
template <class Kinds>
struct ProductsOf;
template <class... K>
struct ProductsOf<std::tuple<K...>> {
  using Type = std::tuple<typename K::Product...>;
  static Type make(const Scene& s, const TangentFactors& factors) {
    return Type{typename K::Product(static_cast<const K&>(s), s, factors)...};
  }
};

class StiffnessOperator {
public:
  /// dt: s. The scene must outlive the operator and not change.
  StiffnessOperator(const Scene& scene, double dt);

  /// M^-1/2 (dt^2 K + 2 dt C) M^-1/2 v, with three degrees of freedom per node, ply by ply. Results
  /// are the same bits for any number of threads.
  Eigen::VectorXd apply(const Eigen::VectorXd& v, ThreadPool& pool);

  /// Start vector of Lanczos' iteration: scattered_motion of all plies.
  Eigen::VectorXd start() const;

private:
  /// f(product) of each kind, in the order in which forces are added on a node.
  template <class F>
  void each_product(const F& f) {
    std::apply([&f](auto&... product) { (f(product), ...); }, products_);
  }

  Eigen::Index degrees_of_freedom(std::size_t p) const; ///< of ply p, 3 per node
  void scale(const Eigen::VectorXd& v, std::size_t p);
  void on_ply(std::size_t p);
  void gather(std::size_t p, Eigen::VectorXd& w);

  const Scene& s_;
  ProductsOf<Forces>::Type products_;
  Eigen::Index size_ = 0;
  std::vector<double> bounded_; ///< per ply, the bounded parts' share of the left side of (S)
  std::vector<Eigen::Index> first_;
  PerPly y_, f_;
};

} // namespace plyform
