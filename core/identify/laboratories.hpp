// SPDX-License-Identifier: GPL-3.0-or-later
// Laws of shear that several laboratories found for one fabric: mean and scatter over the shear
// angle, and the law of the mean and of a standard deviation beside it.
//
// The law of a laboratory is the mean of the laws of its curves, that of all the mean of those of
// the laboratories, each with the same weight. Between: standard deviation of the laboratories'
// laws. Within: of the curves of a laboratory about its mean, pooled over those with several,
// s^2 = sum (n_i - 1) s_i^2 / sum (n_i - 1).
//
// Laws count up to the last row of their curves. From where only some reach, the mean grows by the
// factor that theirs does, and the deviation between laboratories keeps its share of the mean, or
// has that of those who go on where they scatter by more: neither jumps where a laboratory ends.
#pragma once

#include "core/model/shear_law.hpp"

#include <optional>
#include <string>
#include <vector>

namespace plyform {

/// The law of one curve.
struct LaboratoryCurve {
  std::string laboratory;
  ShearLaw law;
  double to; ///< rad: the last row
};

/// The law of a laboratory.
struct LaboratoryLaw {
  std::string name;
  std::size_t curves;
  double to;                  ///< rad
  std::vector<double> torque; ///< N mm, at each angle; NaN beyond its range
};

struct LaboratoryMean {
  std::vector<double> angle; ///< rad, from 0 by half a degree to the last row of all
  std::vector<LaboratoryLaw> laboratories;
  std::vector<double> mean, between; ///< N mm
  std::vector<double> within;        ///< N mm; NaN where no laboratory has two curves
  std::vector<std::size_t> reach;    ///< how many laboratories do
  double common;                     ///< rad: the angle that all reach

  /// At an angle (rad) within the range, linearly between those of `angle`.
  double value_at(const std::vector<double>& values, double angle) const;
};

/// Laboratories in the order of their first curves; two or more, else std::invalid_argument.
LaboratoryMean laboratory_mean(const std::vector<LaboratoryCurve>& curves);

/// The law of the mean and `deviations` standard deviations between laboratories, as a table whose
/// monotone curve is within 1 % of it (of a tenth of the largest below that). Where this torque
/// would be negative or fall, it stays what it was before; from and to (rad): where.
struct DeviatedLaw {
  ShearLaw law;
  std::optional<double> cut_from = {}, cut_to = {};
};
DeviatedLaw deviated_law(const LaboratoryMean& mean, double deviations);

} // namespace plyform
