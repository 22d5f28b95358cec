// SPDX-License-Identifier: GPL-3.0-or-later
// Identifies the law of a sheet of rubber (core/model/mooney_rivlin.hpp) from uniaxial and
// equibiaxial tension: nominal stress, force over the section before forming, against stretch l,
//   uniaxial     s = 2 (l - 1/l^2) (C10 + C01/l)
//   equibiaxial  s = 2 (l - 1/l^5) (C10 + C01 l^2)
// linear in the constants. Uniaxial tension hardly tells C10 from C01, since C01/l varies little,
// and says little of what the sheet does when it is stretched both ways; so Mooney-Rivlin is taken
// only where the rows show both constants, else neo-Hookean, mu alone.
#pragma once

#include "core/identify/fit_quality.hpp"
#include "core/model/mooney_rivlin.hpp"

#include <optional>
#include <string>
#include <vector>

namespace plyform {

enum class RubberTest { uniaxial, equibiaxial };

/// A curve, and how it was measured. x: displacement (mm) with a gauge length, else strain or
/// stretch; y: force of the section (N), or nominal stress where the curve says so.
struct RubberCurve {
  Curve curve;
  RubberTest test = RubberTest::uniaxial;
};

struct RubberSpecimen {
  double area = 1.0;         ///< mm^2, width times thickness before forming; for forces
  double gauge_length = 1.0; ///< mm; 1 when x is the strain or stretch itself
  bool displacement() const { return gauge_length != 1.0; }
};

/// Half widths of 95 % limits of the stress of a test at the largest stretch measured, over it.
struct RubberLimits {
  double uniaxial = 0.0, equibiaxial = 0.0;
};

struct RubberFit {
  MooneyRivlinLaw law;      ///< N/mm^2: of the material, not yet times its thickness
  bool neo_hookean = false; ///< C01 = 0
  std::string why;          ///< that law
  Confidence confidence;    ///< of mu, or of C10 and C01; law_at: a stretch
  RubberLimits by_both;     ///< of a Mooney-Rivlin law of these rows, whichever is taken
  MooneyRivlinLaw mooney;   ///< that law
  double mooney_rms = 0.0;  ///< its residuals
  FitQuality quality;       ///< from, to, largest_at: stretches
  double largest_stretch = 1.0;
  std::vector<double> stretch, measured, fitted; ///< -, N/mm^2
  std::vector<std::size_t> specimen;             ///< from 0, of each row
  std::vector<RubberTest> test;                  ///< of each row
  std::vector<SpecimenLaw> specimens;            ///< coefficients: of the law that is taken
  Scatter scatter;                               ///< of two specimens or more of one test
};

/// Which law: neo-Hookean, Mooney-Rivlin, or chosen by the rows.
enum class RubberLaw { chosen, neo_hookean, mooney_rivlin };

/// Law of rubber from curves of one or more specimens, each with the same weight. options.from, to:
/// strains. Chosen: Mooney-Rivlin if chance would make its residuals so much less than those of a
/// neo-Hookean law no more than once in a thousand, its constants are not negative, and both
/// stresses at the largest stretch have limits within 10 %. Reports an error and returns nothing if
/// a curve violates check_rising or check_zeros, has fewer than four rows or strains of more than
/// 10, falls, cannot be fitted to within 20 %, shows a disturbance that makes the law worthless, or
/// is no rubber's; warns if constants are not told apart.
std::optional<RubberFit> identify_rubber(std::vector<RubberCurve> curves,
                                         const RubberSpecimen& specimen, RubberLaw law,
                                         const FitOptions& options, Diagnostics& diagnostics);

} // namespace plyform
