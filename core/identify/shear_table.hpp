// SPDX-License-Identifier: GPL-3.0-or-later
// Laws of shear that are tables: torques v_j >= 0 that do not fall at shear angles, the knots, with
// the program's monotone curve (core/model/monotone_curve.hpp) through (0, 0) and them.
//
// The curve C(g; v) is homogeneous of degree 1 in v, as slopes of chords, their harmonic means and
// the end's slope are; so by Euler C(g; v) = sum_j v_j dC/dv_j. With the derivatives at a table the
// load is a LinearLaw, exact there and linearised around it: covariance, limits, disturbances and
// sensitivities of linear_law.hpp hold for tables. Unknowns are increments u_j = v_j - v_{j-1} >=
// 0, found by repeated non-negative least squares with the derivatives of the step before (Gauss
// and Newton), from piecewise linear laws on.
//
// Knots are added one at a time, each where it makes the residuals least, at shear angles of rows.
#pragma once

#include "core/identify/shear_rows.hpp"

namespace plyform {

struct TorqueTable {
  std::vector<double> knots; ///< rad, ascending, above 0
  Eigen::VectorXd torque;    ///< N mm, at the knots
};

/// dC(g)/dv of a table at any angle: C = row . torque.
class TableBasis {
public:
  explicit TableBasis(const TorqueTable& table);
  /// Adds weight * dC(g)/dv, g >= 0, to a row.
  void add(double g, double weight, Eigen::Ref<Eigen::RowVectorXd> row) const;

private:
  std::vector<double> knots_;
  Eigen::MatrixXd value_, slope_; ///< of each point, (0, 0) first: derivatives by v
};

/// The law that is linear at a table; coefficients: the increments that are not 0.
struct TableLaw {
  LinearLaw law;
  Eigen::MatrixXd torque; ///< at the knots, of the coefficients
};
TableLaw linear_table(const TorqueTable& table, const ShearTest& test, const Fabric& fabric,
                      double factor);

/// Rows as they enter (40, 41).
struct TorqueRows {
  std::vector<TorqueWeights> weights; ///< with the share of in-plane bending
  Eigen::VectorXd load;
  Eigen::ArrayXd share; ///< further weights of the rows, or empty
};
TorqueRows torque_rows(const LoadRows& rows, const ShearTest& test, const Fabric& fabric,
                       double factor);

/// The table of given knots that follows the rows best.
TorqueTable fit_table(const std::vector<double>& knots, const TorqueRows& rows);

/// Knots of tables of 1, 2 ... `most` points.
std::vector<std::vector<double>> grow_knots(const TorqueRows& rows, double end, int most);

} // namespace plyform
