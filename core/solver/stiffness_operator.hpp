// SPDX-License-Identifier: GPL-3.0-or-later
// Products of vectors with dt^2 K + 2 dt C of a whole scene, for (S) of
// core/solver/stable_time_step.hpp: yarns taut, contacts stuck, as they stand now. What is small in
// it, or not known, takes part by its bound: shear, tension and bending; sheets without yarns.
#pragma once

#include "contact/forces/contact_tangent.hpp"
#include "core/base/thread_pool.hpp"
#include "core/solver/scene.hpp"

#include <Eigen/Core>
#include <memory>

namespace plyform {

class StiffnessOperator {
public:
  /// The scene must outlive it and stay as it is.
  StiffnessOperator(const Scene& scene, double dt);

  /// M^-1/2 (dt^2 K + 2 dt C) M^-1/2 v, v: three freedoms of each node, the plies one after the
  /// other. The same bits for any number of threads.
  Eigen::VectorXd apply(const Eigen::VectorXd& v, ThreadPool& pool);

  /// A vector with a share of every mode.
  Eigen::VectorXd start() const;

private:
  /// Two directed contacts, and the edges.
  struct Pair {
    std::size_t a, b;
    std::vector<ContactTangent> up, down; ///< own nodes are of a; of b
    std::vector<Vec3> force_a, force_b;
  };

  void add_ply(const PlyState& ply, double dt);
  void add_pair(const PlyPair& pair);
  Eigen::Index freedoms(std::size_t p) const; ///< of ply p, 3 a node
  void scale(const Eigen::VectorXd& v, std::size_t p);
  void on_ply(std::size_t p);
  void on_pair(Pair& pair);
  void gather(std::size_t p, Eigen::VectorXd& w);

  const Scene& s_;
  TangentFactors factors_;
  Eigen::Index size_ = 0;
  std::vector<double> bounded_; ///< of each ply, its part of the left side of (S)
  std::vector<Eigen::Index> first_;
  std::vector<std::unique_ptr<YarnStiffness>> yarns_;
  std::vector<std::vector<ContactTangent>> on_ply_;
  std::vector<Pair> pairs_;
  std::vector<std::vector<Vec3>> y_, f_;
};

} // namespace plyform
