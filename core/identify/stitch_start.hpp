// SPDX-License-Identifier: GPL-3.0-or-later
// The laws of a stitch that the search of fit_stitch.hpp starts from.
//
// With pre-tension a stitch pulls on both sides from the start, so that the law of shear and that
// of the stitch hang on each other; a start that is off makes the torque of the slack side fall.
// Near the start both are known in form: a polynomial of 3 and a line taut from e_0 on, linear in
// all but e_0, fitted to both sides at once.
#pragma once

#include "core/identify/fit_stitch.hpp"

#include <optional>
#include <vector>

namespace plyform {

/// What a law of a stitch is looked for in.
struct StitchTest {
  const ShearTest& test;
  const Fabric& fabric;
  const FitOptions& options;
  std::vector<std::size_t> own, others; ///< indices of stitches
  bool negative;                        ///< the side that draws it
};

/// Laws to start from: of a fabric with pre-tension first the line that both sides show, then the
/// fabric's own. `breaks`: the elongation at which the stitch breaks, if it is known.
std::vector<StitchLaw> first_laws(const StitchTest& test, const SignedCurves& curves,
                                  std::optional<double> breaks);

} // namespace plyform
