// SPDX-License-Identifier: GPL-3.0-or-later
// What tests of identification share: noise, messages as one text, and what comes of curves of the
// glass weave.
#pragma once

#include "core/identify/fit_shear.hpp"
#include "support/membrane_checks.hpp"

#include <algorithm>
#include <random>
#include <string>

namespace plyform {

/// Multiplies loads by 1 + `of_load` N(0, 1) and adds `of_largest` N(0, 1) of the largest.
inline Curve noisy_curve(Curve curve, double of_load, double of_largest, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const double most = *std::max_element(curve.y.begin(), curve.y.end());
  for (double& y : curve.y) {
    const double scale = 1.0 + of_load * normal(random);
    y = scale * y + of_largest * most * normal(random);
  }
  return curve;
}

inline std::string texts(const Diagnostics& diagnostics) {
  std::string all;
  for (const std::string& warning : diagnostics.warnings)
    all += warning + "\n";
  for (const CaseError& error : diagnostics.errors)
    all += error.text() + "\n";
  return all;
}

struct ShearOutcome {
  std::optional<ShearFit> fit;
  std::string texts;
  bool says(const std::string& words) const { return texts.find(words) != std::string::npos; }
};

/// By the glass weave's densities, in a machine that does not give way unless told.
inline ShearOutcome identify_glass(const std::vector<Curve>& curves, const ShearTest& test,
                                   FitOptions options = {}) {
  if (!options.corrections.compliance) options.corrections.compliance = 0.0;
  Diagnostics diagnostics;
  ShearOutcome outcome;
  outcome.fit = identify_shear(curves, test, glass_weave(), options, diagnostics);
  outcome.texts = texts(diagnostics);
  return outcome;
}

} // namespace plyform
