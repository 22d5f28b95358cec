// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/identify/fit_signs.hpp"

#include "base/format.hpp"
#include "core/identify/shear_rows.hpp"
#include "core/identify/stitch_load.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

struct Points {
  std::vector<double> angle, torque;
};

/// Points above 0 of an odd law up to an angle: rows of its table, or so many that the curve
/// through them follows a polynomial.
Points points_of(const ShearLaw& law, double to) {
  Points points;
  if (law.tabulated()) {
    for (std::size_t i = 0; i < law.angle.size(); ++i)
      if (law.angle[i] > 0.0) {
        points.angle.push_back(law.angle[i]);
        points.torque.push_back(law.torque[i]);
      }
    return points;
  }
  constexpr int least = 4, most = 30, probes = 200;
  constexpr double near = 1e-3; // of the torque, and of a hundredth of the largest
  for (int n = least; n <= most; ++n) {
    points = {};
    ShearLaw table;
    for (int i = 0; i <= n; ++i) {
      table.angle.push_back(to * i / n);
      table.torque.push_back(law.at(to * i / n).value);
    }
    points.angle.assign(table.angle.begin() + 1, table.angle.end());
    points.torque.assign(table.torque.begin() + 1, table.torque.end());
    double worst = 0.0;
    for (int i = 1; i <= probes; ++i) {
      const double g = to * i / probes, wanted = law.at(g).value;
      worst = std::max(worst, std::abs(table.at(g).value - wanted) /
                                  std::max(wanted, 0.01 * table.torque.back()));
    }
    if (worst <= near) break;
  }
  return points;
}

/// A table of both signs.
ShearLaw joined(const Points& above, const Points& below) {
  ShearLaw law;
  for (std::size_t i = below.angle.size(); i-- > 0;) {
    law.angle.push_back(-below.angle[i]);
    law.torque.push_back(-below.torque[i]);
  }
  law.angle.push_back(0.0);
  law.torque.push_back(0.0);
  law.angle.insert(law.angle.end(), above.angle.begin(), above.angle.end());
  law.torque.insert(law.torque.end(), above.torque.begin(), above.torque.end());
  return law;
}

/// Where a table of both signs is furthest from the law of one of its sides, `own`, halves the
/// piece of that side there, unless it is within `kept_within` everywhere.
bool halve_worst_piece(const ShearLaw& table, double sign, const ShearLaw& own, double to,
                       Points& points) {
  constexpr double step = 0.05 * degree, nothing = 1e-4; // of the largest torque
  const double least = nothing * own.at(to).value;
  double worst = kept_within, at = 0.0;
  for (int i = 0; kept_from + i * step <= to; ++i) {
    const double g = kept_from + i * step, wanted = own.at(g).value;
    const double off = std::abs(sign * table.at(sign * g).value - wanted) / std::max(wanted, least);
    if (off > worst) worst = off, at = g;
  }
  if (at == 0.0) return false;
  const auto next = std::lower_bound(points.angle.begin(), points.angle.end(), at);
  if (next == points.angle.end()) return false;
  const auto place = next - points.angle.begin();
  const double before = place > 0 ? points.angle[static_cast<std::size_t>(place) - 1] : 0.0;
  const double middle = 0.5 * (before + *next);
  points.angle.insert(next, middle);
  points.torque.insert(points.torque.begin() + place, own.at(middle).value);
  return true;
}

/// Angles at which both sides are compared.
std::vector<double> common_angles(const ShearFit& a, const ShearFit& b) {
  return probe_angles(std::min(a.quality.to, b.quality.to));
}

/// Torque (N mm) of each specimen by itself at angles (rad).
std::vector<std::vector<double>> torques_of(const ShearFit& fit,
                                            const std::vector<double>& angles) {
  std::vector<std::vector<double>> torques;
  for (const ShearLaw& law : fit.of_specimen) {
    torques.emplace_back();
    for (const double angle : angles)
      torques.back().push_back(law.at(angle).value);
  }
  return torques;
}

} // namespace

std::vector<Curve> without_stitches(std::vector<Curve> curves, const ShearTest& test,
                                    const Fabric& fabric, const std::vector<std::size_t>& stitches,
                                    bool negative, const FitOptions& options) {
  if (stitches.empty()) return curves;
  const Corrections& c = options.corrections;
  const double end = 0.999 * locking_extension(test); // further rows are refused later
  for (Curve& curve : curves)
    for (std::size_t i = 0; i < curve.size(); ++i) {
      const double load = curve.y[i] - c.load_zero.value_or(0.0);
      const double extension =
          options.measured_angle && i < curve.angle.size()
              ? extension_at(test, curve.angle[i])
              : curve.x[i] - c.toe.value_or(0.0) - c.compliance.value_or(0.0) * load;
      curve.y[i] -= stitch_load(test, fabric, stitches, std::clamp(extension, 0.0, end), negative);
    }
  return curves;
}

ShearLaw law_of_both_signs(const ShearLaw& positive, double positive_to, const ShearLaw& negative,
                           double negative_to) {
  ShearLaw law;
  if (!positive.tabulated() && !negative.tabulated()) {
    law.k = positive.k;
    law.negative_k = negative.k;
    return law;
  }
  // Through 0 the curve has one slope, a mean of both sides': near it neither keeps its own law.
  constexpr int most_added = 20; // of each side
  Points above = points_of(positive, positive_to), below = points_of(negative, negative_to);
  law = joined(above, below);
  for (int n = 0; n < most_added; ++n) {
    const bool first = halve_worst_piece(law, 1.0, positive, positive_to, above),
               second = halve_worst_piece(law, -1.0, negative, negative_to, below);
    if (!first && !second) break;
    law = joined(above, below);
  }
  return law;
}

std::optional<SignsFit> identify_signs(const std::vector<Curve>& positive,
                                       const std::vector<Curve>& negative, const ShearTest& test,
                                       const Fabric& fabric, const FitOptions& options,
                                       Diagnostics& diagnostics) {
  const std::vector<std::size_t> stitches = stitches_of(fabric);
  const auto above = without_stitches(positive, test, fabric, stitches, false, options);
  const auto below = without_stitches(negative, test, fabric, stitches, true, options);
  const auto first = identify_shear(above, test, fabric, options, diagnostics);
  const auto second = identify_shear(below, test, fabric, options, diagnostics);
  if (!first || !second) return std::nullopt;
  SignsFit fit{*first, *second, std::nullopt, {}, {}};
  const std::vector<double> angles = common_angles(fit.positive, fit.negative);
  fit.difference =
      difference_of(angles, torques_of(fit.positive, angles), torques_of(fit.negative, angles),
                    {fit.positive.confidence.law, fit.negative.confidence.law});
  if (fit.difference.differs()) {
    fit.law = law_of_both_signs(fit.positive.law, fit.positive.quality.to, fit.negative.law,
                                fit.negative.quality.to);
    return fit;
  }
  std::vector<Curve> all = above;
  all.insert(all.end(), below.begin(), below.end());
  Diagnostics told_before; // warnings of each curve
  fit.both = identify_shear(all, test, fabric, options, told_before);
  if (!fit.both) {
    diagnostics.errors.insert(diagnostics.errors.end(), told_before.errors.begin(),
                              told_before.errors.end());
    return std::nullopt;
  }
  fit.law = fit.both->law;
  return fit;
}

} // namespace plyform
