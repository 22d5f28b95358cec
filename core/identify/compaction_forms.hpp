// SPDX-License-Identifier: GPL-3.0-or-later
// The laws of fit_compaction.hpp on rows of pressure and fibre volume.
#pragma once

#include "core/identify/fit_compaction.hpp"

namespace plyform {

struct CompactionRow {
  double pressure = 0.0; ///< N/mm^2
  double volume = 0.0;   ///< fibre volume fraction
  std::size_t specimen = 0;
};
using CompactionRows = std::vector<CompactionRow>; ///< by pressure, the least first

/// Numbers of (TM): s, n; of (G): A, Va; and V0.
struct FormNumbers {
  double free_volume = 0.0, scale = 0.0, shape = 0.0;
};

struct FormFit {
  FormNumbers numbers;
  FormNumbers limits;              ///< half widths of the 95 % limits, from the residuals
  double rms = 0.0, largest = 0.0; ///< residuals of thickness, over it
};

/// p of a law at a fibre volume, N/mm^2.
double pressure_at(CompactionForm form, const FormNumbers& law, double volume);
/// V of a law at a pressure.
double volume_at(CompactionForm form, const FormNumbers& law, double pressure);
/// Least squares of ln V, that is of thicknesses over themselves (Levenberg-Marquardt).
FormFit fit_form(CompactionForm form, const CompactionRows& rows);

/// The fibre volumes of the rows, or the nearest that nowhere fall.
std::vector<double> rising_volumes(const CompactionRows& rows);
/// Standard deviation of single rows, over them, from their second differences, in which a smooth
/// curve has little where there are many rows; 0 of less than ten: not known.
double scatter_of_rows(const CompactionRows& rows);
/// Between rows of one specimen.
double volume_between(const CompactionRows& rows, double pressure);
/// V where the rows would begin without pressure, in line with the first two that differ.
double rest_of(const CompactionRows& rows);

} // namespace plyform
