// SPDX-License-Identifier: GPL-3.0-or-later
// Identifies friction over the Hersey number from pull-out tests: a ply is pulled at a speed v from
// between two others, or two plates, that press with p.
//
//   mu = F / (2 A p)       of the steady load F, the mean of the rows in the range asked for   (M)
//   H = eta v / p, mm      eta: viscosity of the matrix at the test's temperature              (H)
//
// The curve is straight in a plot of logarithms between a few points, spread evenly over the
// logarithm of H where tests are, and passes the tests by least squares there: as many points as
// the tests bear, one more only where chance would gain as much once in a hundred.
#pragma once

#include "core/identify/curve_file.hpp"
#include "core/identify/fit_quality.hpp"

#include <optional>
#include <vector>

namespace plyform {

/// One test. curve: displacement (mm), load (N).
struct PullOutTest {
  Curve curve;
  double speed = 0.0;     ///< mm/s
  double pressure = 0.0;  ///< N/mm^2
  double viscosity = 0.0; ///< N s/mm^2 (1 Pa s is 1e-6 of it)
};

/// What a test gives.
struct PullOutPoint {
  std::string file;
  double hersey = 0.0, friction = 0.0, fitted = 0.0; ///< mm, -, -
  double steady = 0.0, scatter = 0.0;                ///< N, standard deviation over the mean
  double peak = 0.0;                                 ///< N, the largest load before, over steady
};

struct PullOutFit {
  std::vector<double> hersey, friction; ///< of the curve's points, ascending
  std::vector<PullOutPoint> tests;      ///< in the order given
  FitQuality quality;                   ///< of friction over H; from, to: mm
  double limits = 0.0;                  ///< 95 %, of the friction, over it
};

/// area: A, mm^2, of one face. from, to: mm of displacement of steady rows. points: of the curve,
/// or 0: chosen, 2 to 8. Reports an error and returns nothing for fewer than three tests, Hersey
/// numbers that differ by less than a factor of two, ranges without rows, loads of 0 or below, or
/// residuals of more than 20 %.
std::optional<PullOutFit> identify_pull_out(const std::vector<PullOutTest>& tests, double area,
                                            double from, double to, int points,
                                            Diagnostics& diagnostics);

} // namespace plyform
