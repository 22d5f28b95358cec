// SPDX-License-Identifier: GPL-3.0-or-later
// Identifies a yarn's law of tension against strain from strip or yarn tests, and its law of
// compression. Tension: one stiffness if a line through the origin follows the curves, else a
// table.
#pragma once

#include "core/identify/fit_quality.hpp"
#include "core/model/fabric.hpp"

#include <optional>
#include <vector>

namespace plyform {

/// Largest number of rows of a tension table, including [0, 0].
inline constexpr std::size_t table_rows = 20;

/// How a tension curve was measured; x / gauge_length is the strain, y / yarns the tension of one
/// yarn, N.
struct Strip {
  double yarns = 1.0;
  double gauge_length = 1.0; ///< mm; 1 when x is the strain itself
  bool displacement() const { return gauge_length != 1.0; }
};

struct TensionFit {
  TensionLaw law;
  FitQuality quality;
  std::vector<double> strain, measured, fitted; ///< -, N per yarn, N per yarn
  std::vector<std::size_t> specimen;            ///< from 0, of each row
  Confidence confidence;              ///< of the stiffness, or of the table's tensions; of the law
  std::vector<SpecimenLaw> specimens; ///< coefficients: stiffness, or the table's tensions
  Scatter scatter;                    ///< of two specimens or more
};

/// Law of tension from strip or yarn tests of one or more specimens. A stiffness if the residuals
/// of a line through the origin are within 2 % rms, or a table would not halve them; else a table
/// of at most 20 rows: at the strains of the curve if they are that few, else at strains selected
/// evenly from them, with tensions by least squares, as far as all specimens go. Corrections are
/// those of x and y as measured. Reports an error and returns nothing if a curve violates
/// check_rising or check_zeros, has fewer than two rows or strains of 50 % and more, softens,
/// cannot be fitted to within 20 %, shows a disturbance that makes the law worthless, or is no
/// yarn's.
std::optional<TensionFit> identify_tension(const std::vector<Curve>& curves, const Strip& strip,
                                           const FitOptions& options, Diagnostics& diagnostics);
std::optional<TensionFit> identify_tension(Curve curve, const Strip& strip,
                                           const FitOptions& options, Diagnostics& diagnostics);

struct CompressionFit {
  double stiffness = 0.0, stiffness_limits = 0.0; ///< N per yarn, with 95 % limits
  std::optional<double> buckling_force;           ///< N per yarn; none: no plateau
  FitQuality quality;
  std::vector<double> strain, measured, fitted; ///< of shortening, positive
};

/// Law of compression of a yarn, C and the force at which it gives way, from a curve of shortening
/// and force (both positive) of a supported strip or yarn: N = C e up to N_b, 0.01 C beyond, by
/// least squares over the place of the kink. Errors as of identify_tension.
std::optional<CompressionFit> identify_compression(Curve curve, const Strip& strip,
                                                   const FitOptions& options,
                                                   Diagnostics& diagnostics);

/// Reports an error if a compression stiffness (N) is more than that of the fabric's `yarns`
/// ("warp", "weft") in tension, if they have one.
void check_compression(double stiffness, const std::string& yarns, const Fabric& fabric,
                       const Place& at, Diagnostics& diagnostics);

} // namespace plyform
