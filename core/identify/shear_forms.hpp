// SPDX-License-Identifier: GPL-3.0-or-later
// The laws that a shear curve may have, each fitted to rows.
//
//   polynomial of n       C = k1 g + k3 g^3 ...
//   static torque and     C = C0 s(g/a) + k1 g + k3 g^3 ..., s(t) = (3 t - t^3)/2 up to t = 1, then
//   polynomial of n       1: yarns stick, and turn once C0 is overcome, within the small angle a
//   table of n points     shear_table.hpp
//
// A fabric file has polynomials and tables: the second is written as a table, whose curve passes it
// to 0.1 % from a on.
#pragma once

#include "core/identify/shear_rows.hpp"

namespace plyform {

/// A law of one form fitted to rows, with the share of in-plane bending that follows from it.
struct ShearSolution {
  ShearForm form;
  LinearLaw law; ///< of a table: exact at the solution
  LinearFit fit;
  double scale = 0.0; ///< rad, of the coefficients of a polynomial: the end of the rows
  BendingShare share;
  Fabric fabric;                                  ///< with the law found
  double static_torque = 0.0, static_angle = 0.0; ///< C0 (N mm), a (rad)
  std::vector<double> polynomial;                 ///< k1, k3 ..., N mm; empty of a table
  Eigen::MatrixXd at_points;                      ///< torques at a table's points, of fit.k
  const ShearLaw& shear() const { return fabric.crossings[0].shear; }
  /// Of the law as it is compared between specimens: coefficients, or torques at a table's points.
  std::vector<double> numbers() const;
  double squares = 0.0; ///< of weighted residuals
};

/// Rows of angles up to `end` (rad). knots: of a table; empty: looked for.
ShearSolution solve_shear(const ShearForm& form, const LoadRows& rows, double end,
                          const ShearTest& test, const Fabric& fabric,
                          const std::vector<double>& knots = {});

/// Knots of a table for a specimen that ends at `end`; none if there are none.
std::vector<double> knots_to(const std::vector<double>& knots, double end);

/// Fitted loads of extensions, N.
std::vector<double> fitted_loads(const ShearSolution& s, const ShearTest& test,
                                 const Eigen::VectorXd& extension);

/// The smallest shear angle (rad) in [from, to] at which the law decreases or is negative; a larger
/// angle than `to` if there is none.
double invalid_at(const ShearLaw& law, double from, double to);

} // namespace plyform
