// SPDX-License-Identifier: GPL-3.0-or-later
// Identifies the laws of a fabric from measured curves.
//
// Shear. By (40, 41) of shear_tests.hpp the load is linear in the torque Cs, and so in the
// coefficients of Cs(g) = k1 g + k3 g^3 + k5 g^5 ...: linear least squares, exact also where (40)
// contains both Cs(g) and Cs(g/2).
//
// Weights. The load grows by two to three orders of magnitude over a test. Least squares of the
// load itself would fit the law near locking and hardly constrain the first 20 degrees, in which
// most of a part lies; least squares of the relative error would fit the noise of the load cell at
// the start. Therefore each row has the weight 1 / max(F, load_floor x the largest F): relative
// accuracy down to the load that a load cell can resolve. F is the fitted load, found by iteration:
// with the measured load, rows that read low would get more weight and the law would be biased low.
// Simulated bias tests of a glass weave, 60 rows up to 55 degrees, largest error of the law over
// the range in the worst 5 % of 300 tests, for a floor of 0.01, 0.1 and infinity (least squares of
// the load): 1 % noise of the load 0.9, 1.3 and 4.7 %; 0.5 % of the load and 0.2 % of the
// largest 8.4, 4.1 and 3.9 %.
//
// Yarns. Tension against strain: one stiffness if a line through the origin follows the curve,
// else a table.
#pragma once

#include "core/fit/curve_file.hpp"
#include "core/fit/shear_tests.hpp"

#include <limits>
#include <optional>
#include <vector>

namespace plyform {

/// Fraction of the largest load below which rows have equal weight: see the head of this file.
inline constexpr double load_floor = 0.1;
/// Residuals, rms over load: above the first a warning, above the second an error.
inline constexpr double noisy = 0.02, useless = 0.2;
/// rad (5 degrees): smallest range of shear angles that a law can be identified from.
inline constexpr double least_range = 0.08726646259971647;
/// Largest number of rows of a tension table, including [0, 0].
inline constexpr std::size_t table_rows = 20;

struct FitOptions {
  int coefficients = 3; ///< of the shear law, 1 to 6
  double from = 0.0;    ///< shear angle (rad) or strain of the first row that counts ...
  double to = std::numeric_limits<double>::infinity(); ///< ... and of the last
};

/// How well a law follows the rows it was fitted to. Residuals are over max(fitted load,
/// load_floor x the largest).
struct FitQuality {
  std::size_t rows = 0;
  double from = 0.0, to = 0.0; ///< shear angle (rad) or strain covered
  double rms = 0.0, largest = 0.0;
  double largest_at = 0.0; ///< rad or strain
};

struct ShearFit {
  ShearLaw law;
  FitQuality quality;
  std::vector<double> extension, angle, measured, fitted; ///< mm, rad, N, N of each row
  BendingShare in_plane; ///< of in-plane bending: its mean is in the fitted load
};

struct TensionFit {
  TensionLaw law;
  FitQuality quality;
  std::vector<double> strain, measured, fitted; ///< -, N per yarn, N per yarn
};

/// Law of shear from extension (mm) and load (N) of a test. Uses the fabric's densities and fibre
/// angle, which must be 90 degrees, and its in-plane bending, whose share of the load of a
/// bias-extension test is subtracted (it depends on the law found, by iteration). Reports an error
/// and returns nothing if the curve violates check_curve, reaches 90 degrees, covers too little
/// (two rows per coefficient, 5 degrees), cannot be fitted to within 20 %, or gives a torque that
/// is negative or decreases within its range. Throws std::invalid_argument for options out of
/// range.
std::optional<ShearFit> identify_shear(Curve curve, const ShearTest& test, const Fabric& fabric,
                                       const FitOptions& options, Diagnostics& diagnostics);

/// How a tension curve was measured; x / gauge_length is the strain, y / yarns the tension of one
/// yarn, N.
struct Strip {
  double yarns = 1.0;
  double gauge_length = 1.0; ///< mm; 1 when x is the strain itself
};

/// Law of tension from a strip or yarn test. A stiffness if the residuals of a line through the
/// origin are within 2 % rms, or a table would not halve them; else a table of at most 20 rows: at
/// the strains of the curve if they are that few, else at strains selected evenly from them, with
/// tensions by least squares. Reports an error and returns nothing if the curve violates
/// check_curve, has fewer than two rows or strains of 50 % and more, softens, or cannot be fitted
/// to within 20 %.
std::optional<TensionFit> identify_tension(Curve curve, const Strip& strip,
                                           const FitOptions& options, Diagnostics& diagnostics);

/// Functions that both share. quality_of: residuals of the rows at shear angles or strains `at`.
/// check_quality: reports an error and returns false if they exceed `useless`, a warning if they
/// exceed `noisy`; `where` describes the position of the largest one.
FitQuality quality_of(const std::vector<double>& at, const std::vector<double>& measured,
                      const std::vector<double>& fitted);
bool check_quality(const Curve& curve, const FitQuality& quality, const std::string& where,
                   const std::string& remedy, Diagnostics& diagnostics);

} // namespace plyform
