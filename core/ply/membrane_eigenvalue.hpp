// SPDX-License-Identifier: GPL-3.0-or-later
// Highest frequency of a membrane, which limits the stable time step of explicit integration.
//
//   omega_e  1/s   root of the largest eigenvalue of any element's M_e^-1 K_e: a bound of omega
//                  (Irons)
//   omega    1/s   root of the largest eigenvalue of M^-1 K, by Lanczos' iteration; up to a quarter
//                  below omega_e
//   M        t     lumped masses;  K  N/mm  tangent stiffness with all yarns in tension (or in
//                  compression, if that is stiffer)
//   y        mm    K y = - sum of (F) of core/ply/membrane.hpp with N_a of the small strains that y
//                  makes: eps_a = f_a . sum_i,n v_a,i c_i,n y_n (K)
#pragma once

#include "base/lanczos.hpp"
#include "core/mesh/pairs.hpp"
#include "core/ply/membrane.hpp"

namespace plyform {

/// Element bounds (Irons) of the eigenvalues of one ply's membrane at its present shape.
struct EigenvalueBound {
  double omega2 = 0.0; ///< 1/s^2
  double yarns = 0.0;  ///< 1/s^2, largest with the yarns' stiffness alone; of a foil its sheet's
  double soft = 0.0;   ///< 1/s^2, largest with shear, sheet and geometric stiffness alone
  /// Whether a collapse penalty of more than 0.2 yarn stiffness acts on any triangle.
  bool penalty_acts = false;
  double damping = 0.0; ///< 1/s, of M^-1 C
  double viscous = 0.0; ///< s, C <= viscous * K of the yarns
  int triangle = -1;    ///< the triangle with the largest omega2
};

/// For checkpoints: base/archive.hpp.
template <class F>
void each_member(EigenvalueBound& bound, F&& f) {
  auto& [omega2, yarns, soft, penalty_acts, damping, viscous, triangle] = bound;
  f("omega2", omega2);
  f("yarns", yarns);
  f("soft", soft);
  f("penalty_acts", penalty_acts);
  f("damping", damping);
  f("viscous", viscous);
  f("triangle", triangle);
}

/// Element bounds at positions x (mm, n).
EigenvalueBound eigenvalue_bound(const Membrane& m, std::span<const Vec3> x);

/// Of each triangle the largest omega^2 (1/s^2) of its strain group by itself, with the masses that
/// it gives its nodes, at positions x (mm, n): as Irons' bound of elements, but of pairs, whose one
/// mean strain is less stiff than two. The deviations within a pair do not count.
std::vector<double> group_omega2(const Membrane& m, std::span<const Vec3> x);

/// Products of vectors with (stiffness K + damping C) of taut yarns at one shape x (mm), active
/// collapse penalties included. stiffness, damping: factors (damping in 1/s). Keeps a reference to
/// the membrane, which must outlive it.
class YarnStiffness {
public:
  YarnStiffness(const Membrane& m, std::span<const Vec3> x, double stiffness, double damping);

  /// Adds the product with y (mm, n nodes), (K), to f (N, n nodes).
  void add_to(std::span<const Vec3> y, std::span<Vec3> f);

private:
  struct Row { // of one family in one triangle
    Vec3 f;
    double deviation, collapse_penalty; ///< N/mm
  };
  /// `known`: the number of families; 0: that of the membrane.
  template <std::size_t known>
  void strain_group(std::span<const Vec3> y, std::size_t group);

  const Membrane& m_;
  std::vector<Vec2> along_;  ///< v_a, one per family
  std::vector<double> taut_; ///< N/mm, one per family
  std::vector<Row> rows_;    ///< families of the first triangle, of the second ...
  std::vector<ElementForce> q_;
};

/// Start vector (3 n) of Lanczos' iteration with a component along every mode: the same
/// pseudo-random numbers every time, along the yarns and the normal, so that the vector rotates
/// with the ply.
Eigen::VectorXd scattered_motion(const Membrane& m, std::span<const Vec3> x);

/// Ratio (at most 1) of omega^2 with the yarns' stiffness alone at shape x (mm, n) to its element
/// bound EigenvalueBound::yarns. omega^2 is `upper_bound` of the largest Ritz value. 1 for a sheet
/// without yarns.
double eigenvalue_ratio(const Membrane& m, std::span<const Vec3> x);

/// Factor of the yarns' part of omega^2 for a law with a kink at zero strain (the bound of elements
/// has its small soft part multiplied too), with r the smaller slope there over the larger:
///   1 + 0.8 r (1 - r)                                                                         (R)
/// The largest slope alone is not enough near the limit of (S), core/solver/stable_time_step.hpp:
/// a step conserves another energy on each side of the kink, and modes that cross it gain at every
/// crossing. Five frictionless plies (docs/theory/time_step.md#kinks) gain where r is 0.25 or 0.5
/// from 0.91 to 0.95 of that step on, not with 0.9, nor where r is 0.1 or 0.75.
double kink_factor(const Membrane& m);

/// Bound of omega^2 (1/s^2) with the yarns' part multiplied by eigenvalue_ratio; the element bound
/// itself where stiff collapse penalties act.
double highest_omega2(const EigenvalueBound& bound, double eigenvalue_ratio);

} // namespace plyform
