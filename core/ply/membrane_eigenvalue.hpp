// SPDX-License-Identifier: GPL-3.0-or-later
// Highest frequency of a membrane, which limits the stable step of explicit integration.
//
//   omega_e  1/s   largest of one element's M_e^-1 K_e: a bound of the mesh (Irons)
//   omega    1/s   largest of M^-1 K, found by Lanczos' iteration; up to a quarter below omega_e
//   M        t     lumped masses;  K  N/mm  tangent stiffness, all yarns taken as taut (or pressed
//                  flat, where that is stiffer)
//   y        mm    K y = - sum of (F) of core/ply/membrane.hpp with N_a of the small strains that y
//                  makes: eps_a = f_a . sum_n c_a,n y_n                                        (K)
#pragma once

#include "core/mesh/pairs.hpp"
#include "core/ply/membrane.hpp"

namespace plyform {

/// Bounds of one ply at its present shape, by Irons.
struct EigenvalueBound {
  double omega2 = 0.0;            ///< 1/s^2
  double yarns = 0.0, soft = 0.0; ///< 1/s^2, largest of yarns alone; of shear and tension
  bool guarded = false; ///< whether a guard about as stiff as its yarns acts on a triangle
  double damping = 0.0; ///< 1/s, of M^-1 C
  double viscous = 0.0; ///< s, C is at most so many times the yarns' K
  int triangle = -1;    ///< where
};
EigenvalueBound eigenvalue_bound(const Membrane& m, std::span<const Vec3> x);

/// Products with (stiffness K + damping C) of taut yarns, guards that act included, at one shape;
/// not for a sheet without yarns. The membrane must outlive it.
class YarnStiffness {
public:
  YarnStiffness(const Membrane& m, std::span<const Vec3> x, double stiffness, double damping);

  /// Adds the product with y (mm), (K), to f, both n nodes.
  void add_to(std::span<const Vec3> y, std::span<Vec3> f);

private:
  struct Row {
    Vec3 f1, f2;
    std::array<double, 2> deviation, collapse_penalty; ///< N/mm
  };
  void strain_group(std::span<const Vec3> y, std::size_t group);

  const Membrane& m_;
  std::array<double, 2> taut_; ///< N/mm
  std::vector<Row> rows_;      ///< one a triangle
  std::vector<ElementForce> q_;
};

/// A motion (3 n) with a share of every mode, always the same: numbers without pattern along the
/// yarns and across the sheet, so that it turns with it.
Eigen::VectorXd scattered_motion(const Membrane& m, std::span<const Vec3> x);

constexpr int ritz_steps = 30;       ///< leaves 1 % to find on meshes of 1e6 triangles
constexpr double ritz_margin = 1.03; ///< for that, three times

/// omega^2 of the yarns' stiffness alone at shape x (mm) over EigenvalueBound::yarns, at most 1:
/// the largest Ritz value with a margin of 3 % for what the iteration has not found. 1 for a sheet
/// without yarns.
double eigenvalue_ratio(const Membrane& m, std::span<const Vec3> x);

/// Largest omega^2 (1/s^2) of a bound whose part of the yarns is sharpened; Irons' where guards
/// act.
double highest_omega2(const EigenvalueBound& bound, double eigenvalue_ratio);

} // namespace plyform
