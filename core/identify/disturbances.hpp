// SPDX-License-Identifier: GPL-3.0-or-later
// Finds what a test machine has added to a curve, where the curve shows it.
//
// The law is fitted with one of the disturbances of corrections.hpp more, of free size. It is found
// if the residuals get less by more than chance would do once in a thousand curves (Student's t of
// the further coefficient, by its error in two ways; of a slip times the rows it may stand at) and
// the law moves by more than 2 %. A stretched extension (slip that goes on, compliance) looks like
// a law of another shape: whether one coefficient more does as well is told. A disturbance that the
// curve does not show may be there all the same; `sensitivities` says how far each would move the
// law.
#pragma once

#include "core/identify/corrections.hpp"

#include <string>
#include <vector>

namespace plyform {

enum class DisturbanceKind { load_zero, displacement_zero, stretch, slip };

struct Disturbance {
  DisturbanceKind kind;
  double amount = 0.0, limits = 0.0; ///< N, x, share of x, x; with 95 % limits
  std::size_t row = 0;               ///< of a slip
  double change = 0.0;               ///< largest of the law without it, over the law with it
  double squares = 0.0, plain_squares = 0.0; ///< of residuals with and without it
  double chance = 0.0;                       ///< of a find where there is nothing
  bool is_no_shape = true;                   ///< one coefficient more does not do as well
  double freedom = 1.0;                      ///< of residuals with it
  Eigen::VectorXd k = {};                    ///< of the law with it
};

/// Each of `looked_for`, the one that explains the rows best first, found or not.
std::vector<Disturbance> fit_disturbances(const LinearLaw& law, const LoadRows& rows,
                                          const std::vector<DisturbanceKind>& looked_for);
bool is_found(const Disturbance& d);

/// The disturbances that explain the rows best, the best first; several where the rows do not tell
/// them apart. Empty: none is found. `looked_for`: which may be there.
std::vector<Disturbance> find_disturbances(const LinearLaw& law, const LoadRows& rows,
                                           const std::vector<DisturbanceKind>& looked_for);

/// How far a disturbance of a given size would move the law, as share of it.
struct Sensitivity {
  double load_zero = 0.0;  ///< of one percent of the largest load
  double toe = 0.0;        ///< of the displacement zero by `length`
  double slip = 0.0;       ///< of a slip of `length` that grows with x
  double compliance = 0.0; ///< of `compliance`
};
Sensitivity sensitivities(const LinearLaw& law, const LoadRows& rows, double length,
                          double compliance);

} // namespace plyform
