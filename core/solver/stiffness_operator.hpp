// SPDX-License-Identifier: GPL-3.0-or-later
// Products of vectors with dt^2 K + 2 dt C of a whole scene, for (S) of
// core/solver/stable_time_step.hpp: yarns taut, contacts sticking, at the present positions. Small
// or unassembled parts are represented by their bounds: shear, geometric stiffness and bending;
// sheets without yarns.
#pragma once

#include "contact/forces/contact_tangent.hpp"
#include "core/base/thread_pool.hpp"
#include "core/solver/scene.hpp"

#include <Eigen/Core>
#include <memory>

namespace plyform {

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
  /// Linearised contacts of two plies: both passes of node-to-face contact, and edge-edge contact.
  struct Pair {
    std::size_t a, b;
    std::vector<ContactTangent> up, down; ///< own nodes are of a; of b
    std::vector<Vec3> force_a, force_b;
  };

  void add_ply(const PlyBody& ply, double dt);
  void add_pair(const PlyPair& pair);
  Eigen::Index degrees_of_freedom(std::size_t p) const; ///< of ply p, 3 per node
  void scale(const Eigen::VectorXd& v, std::size_t p);
  void on_ply(std::size_t p);
  void on_pair(Pair& pair);
  void gather(std::size_t p, Eigen::VectorXd& w);

  const Scene& s_;
  TangentFactors factors_;
  Eigen::Index size_ = 0;
  std::vector<double> bounded_; ///< per ply, the bounded parts' share of the left side of (S)
  std::vector<Eigen::Index> first_;
  std::vector<std::unique_ptr<YarnStiffness>> yarns_;
  std::vector<std::vector<ContactTangent>> on_ply_;
  std::vector<Pair> pairs_;
  std::vector<std::vector<Vec3>> y_, f_;
};

} // namespace plyform
