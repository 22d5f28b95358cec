// SPDX-License-Identifier: GPL-3.0-or-later
// Fits a stitch's force to loads that it adds: the core of fit_stitch.hpp.
#pragma once

#include "core/identify/linear_law.hpp"
#include "core/identify/stitch_load.hpp"

#include <optional>

namespace plyform {

/// What stitches add, row by row, on the side that draws them.
struct StitchRows {
  ShearTest test;
  const Fabric& fabric;
  std::vector<std::size_t> stitches; ///< of one law
  bool negative = false;             ///< the side
  std::vector<double> extension;     ///< mm
  Eigen::VectorXd added;             ///< N
  Eigen::ArrayXd weights;            ///< of each row

  /// N of each row for a force over elongation.
  Eigen::VectorXd loads(const StitchForce& force) const;
  /// The elongations of both zones that are above 0, ascending.
  std::vector<double> elongations() const;
};

struct StitchSolution {
  StitchLaw law; ///< its breaking_force is that of a break found
  bool line = true;
  double breaks_at = 0.0; ///< elongation; 0: it does not
  double breaks_from = 0.0, breaks_to = 0.0;
  Eigen::VectorXd fitted; ///< N
  double squares = 0.0;   ///< weighted, of the residuals

  double force(double strain) const; ///< 0 beyond the break
};

/// The best law; breaks: the elongation at which it breaks if that is known, infinite for never.
StitchSolution solve_stitch(const StitchRows& rows, std::optional<double> breaks = std::nullopt);

} // namespace plyform
