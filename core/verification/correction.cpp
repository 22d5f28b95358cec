// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/verification/correction.hpp"

#include "base/format.hpp"
#include "core/results/field_difference.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace plyform {
namespace {

enum { of_mesh, of_inertia, of_softening, causes };

constexpr std::array<double, causes> order = {order_of_mesh, order_of_inertia, order_of_softening};
constexpr std::array<double, causes> work = {2.7, 1.0, 0.5};      // exponents, core/accuracy
constexpr double smallest_elements = 0.5, longest_duration = 4.0; // over those of the first run
constexpr double least_share = 0.25;                              // of (W/k)^2, whatever chance has

/// (1): factors of the errors, 1 for those that stay; left2: A, deg^2.
std::array<double, causes> factors_of_errors(const std::array<double, causes>& errors, double left2,
                                             std::array<bool, causes> stays) {
  std::array<double, causes> factors{1.0, 1.0, 1.0};
  for (bool changed = true; changed;) {
    changed = false;
    double share2 = left2, sum = 0.0;
    for (int j = 0; j < causes; ++j)
      if (stays[j])
        share2 -= errors[j] * errors[j];
      else
        sum += work[j] / order[j];
    share2 = std::max(share2, 0.0);
    for (int j = 0; j < causes; ++j) {
      factors[j] = 1.0;
      if (stays[j]) continue;
      const double x = std::sqrt(share2 * work[j] / order[j] / sum);
      if (x < errors[j])
        factors[j] = x / errors[j];
      else
        stays[j] = changed = true;
    }
  }
  return factors;
}

std::string list_of_fixed(const std::array<bool, causes>& stays) {
  std::string text;
  for (int j = 0; j < causes; ++j)
    if (stays[j])
      text += std::string(text.empty() ? "" : ", ") +
              std::array{"elements", "duration", "softening"}[j];
  return text;
}

/// flew: the run that the parts are of.
void scale(VerifiedFigure& f, const AskedAccuracy& asked, bool flew = false) {
  const double power = flew      ? order_outside_premise
                       : f.force ? order_of_inertia_of_forces
                                 : order_of_inertia;
  const double mesh = std::pow(asked.element_size, order_of_mesh);
  const double inertia = std::pow(asked.duration, -power);
  const double softening = std::pow(asked.softening, order_of_softening);
  if (f.mesh) *f.mesh *= mesh;
  if (f.inertia) *f.inertia *= inertia;
  if (f.softening) *f.softening *= softening;
  for (SignedErrors& one : f.estimates)
    one = {mesh * one.mesh, inertia * one.inertia, softening * one.softening};
}

} // namespace

CorrectedCase corrected_case(const Case& data, const Verification& verification,
                             const FixedParameters& fixed) {
  CorrectedCase corrected{data, {}};
  AskedAccuracy& asked = corrected.asked;
  const VerifiedFigure& shear = verification.shear;
  const ErrorPart measured = width_of_band(shear);
  asked.wanted_deg = data.accuracy.shear_error / degree;
  asked.measured_deg = asked.expected_deg =
      measured.value_or(std::numeric_limits<double>::quiet_NaN());
  if (asked.kept()) return corrected;
  if (!measured) {
    asked.why_not = "the shear has no band, as a part of its error was not measured";
    return corrected;
  }
  const double allowed = asked.wanted_deg / safety;
  const double left2 =
      std::max(allowed * allowed - *shear.chance * *shear.chance, least_share * allowed * allowed);
  const std::array<double, causes> errors = {*shear.mesh, *shear.inertia, *shear.softening};
  std::array<bool, causes> stays = {fixed.element_size || !may_refine(data, smallest_elements),
                                    fixed.duration,
                                    fixed.softening || data.solver.fibre_softening <= 1.0};
  const std::array<double, causes> factors = factors_of_errors(errors, left2, stays);
  const auto factor = [&](int j, double sign) { return std::pow(factors[j], sign / order[j]); };
  asked.element_size = std::max(factor(of_mesh, 1.0), smallest_elements);
  asked.duration = std::min(factor(of_inertia, -1.0), longest_duration);
  asked.softening =
      std::max(factor(of_softening, 1.0), std::min(1.0 / data.solver.fibre_softening, 1.0));
  VerifiedFigure after = shear;
  scale(after, asked);
  asked.expected_deg = *width_of_band(after);
  for (BlankSpec& blank : corrected.data.blanks)
    scale_elements(blank, asked.element_size);
  corrected.data.solver.duration *= asked.duration;
  corrected.data.solver.fibre_softening *= asked.softening;
  if (!corrected.changed())
    asked.why_not = list_of_fixed(stays).empty()
                        ? "chance alone, how far two equal runs differ, is more than that"
                        : "what stays as it is leaves too much: " + list_of_fixed(stays);
  return corrected;
}

Verification after_correction(const Verification& first, const AskedAccuracy& asked,
                              const RunEnd& first_run, const RunEnd& second) {
  Verification all = first;
  all.asked = asked;
  const std::vector<VerifiedFigure> now = verified_figures(second, {}, {}, {});
  for (VerifiedFigure& f : all.figures) {
    const auto same = std::find_if(now.begin(), now.end(),
                                   [&](const VerifiedFigure& n) { return n.name == f.name; });
    if (same != now.end()) f.value = same->value, f.jitter = same->jitter;
    scale(f, asked, first_run.flies);
    if (unmeasured(f).empty()) set_band(f);
  }
  scale(all.shear, asked, first_run.flies);
  all.shear.value = verified_shear(second, {}, {}, {}).value;
  set_band(all.shear);
  all.asked->moved_deg = shear_error(first_run.last, second.last).rms;
  return all;
}

} // namespace plyform
