// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a law of shear follows its rows, and is one of a fabric.
//
// Misfit. A forming run feels torques, wherever in its range of angles, so a law is judged by
//
//   misfit^2 = integral (Cm - C)^2 dgamma / integral C^2 dgamma
//
// over the rows' range, by trapezoids, where Cm - C is what the residual of a row's load is as
// torque: (F - F_fitted) / (S_whole + S_half C(gamma/2)/C(gamma) ...), the weights of (40, 41).
// Where the load is nothing, so is what a share of it does.
//
// Noise. What single rows scatter by, on the same scale: each against the cubic through its two
// neighbours on either side. Where rows are few, the shape of the curve between them is in it.
#pragma once

#include "core/identify/fit_quality.hpp"
#include "core/identify/shear_forms.hpp"

namespace plyform {

/// rad (1 degree): rows near 0 begin below it.
inline constexpr double near_zero = 0.017453292519943295;

/// Misfit and noise of rows of one specimen, in ascending x.
struct TorqueMisfit {
  double misfit = 0.0, noise = 0.0;
  std::vector<double> torque; ///< Cm of each row, N mm
};
TorqueMisfit torque_misfit(const ShearSolution& s, const LoadRows& rows, const ShearTest& test);

/// Reports an error and returns false if the misfit exceeds `useless`, a warning above `noisy`.
bool check_misfit(const Curve& curve, const FitQuality& quality, const std::string& remedy,
                  Diagnostics& diagnostics);

/// Reports a torque that falls or is negative within the range and returns false; warns of one that
/// does beyond it.
bool check_rises(const Curve& curve, const ShearSolution& s, const FitQuality& quality,
                 Diagnostics& diagnostics);

/// Of a law that cannot fall: reports rows whose torque does, by more than noise, and returns
/// false.
bool check_rows_rise(const Curve& curve, const ShearSpecimen& specimen, const TorqueMisfit& misfit,
                     const FitOptions& options, Diagnostics& diagnostics);

/// Whether the torque is one of a fabric.
bool check_usual_torque(const Curve& curve, const Fabric& found, double end, bool doubtful,
                        Diagnostics& diagnostics);

void warn_of_layers(const Curve& curve, const BendingShare& share, Diagnostics& diagnostics);

/// Warns of what a law with a static torque, or a table, follows without being seen.
void warn_of_hidden(const ShearSpecimen& specimen, const ShearSolution& s, const ShearTest& test,
                    const Sensitivity& sensitive, const FitOptions& options,
                    Diagnostics& diagnostics);

} // namespace plyform
