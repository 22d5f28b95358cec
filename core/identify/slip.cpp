// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/identify/slip.hpp"

#include "base/format.hpp"
#include "core/model/monotone_curve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plyform {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Options for a law that is only compared: whatever it is.
FitOptions for_comparison(FitOptions options, bool measured_angle) {
  options.measured_angle = measured_angle;
  options.doubtful = true;
  if (measured_angle) {
    options.corrections.compliance = {};
    options.corrections.fit_slip = false;
  }
  return options;
}

/// What (a) says at the rows that have this measured angle; NaN beyond them.
double formula_at(const std::vector<Curve>& curves, const ShearTest& test, double angle) {
  double sum = 0.0;
  int count = 0;
  for (const Curve& curve : curves)
    for (std::size_t i = 1; i < curve.size(); ++i) {
      const double a = curve.angle[i - 1], b = curve.angle[i];
      if (!(a <= angle && angle <= b + 1e-9 && a < b))
        continue; // several times, where angles scatter
      const double x = curve.x[i - 1] + (curve.x[i] - curve.x[i - 1]) * (angle - a) / (b - a);
      sum += shear_angle(test, x);
      ++count;
    }
  return count == 0 ? unknown : sum / count;
}

double slip_work(const std::vector<Curve>& curves, const ShearTest& test) {
  double all = 0.0, sheared = 0.0;
  for (const Curve& curve : curves)
    for (std::size_t i = 1; i < curve.size(); ++i) {
      const double load = 0.5 * (curve.y[i - 1] + curve.y[i]);
      all += load * (curve.x[i] - curve.x[i - 1]);
      sheared +=
          load * (extension_at(test, curve.angle[i]) - extension_at(test, curve.angle[i - 1]));
    }
  return all > 0.0 ? 1.0 - sheared / all : 0.0;
}

/// Within the range of the curve, which need not hold 0.
double value_within(const MonotoneCurve& curve, double x) {
  const auto above = std::upper_bound(curve.x.begin(), curve.x.end() - 1, x) - curve.x.begin();
  const CubicPiece piece = curve.piece(static_cast<std::size_t>(above) - 1);
  return piece.value(x - piece.begin);
}

std::string first_error(const Diagnostics& diagnostics) {
  return diagnostics.errors.empty() ? "" : diagnostics.errors.front().rule;
}

/// Torques of one law over another, less 1, at the angles that reports speak of.
std::vector<SlipAt> torques(const ShearLaw& law, const ShearLaw& over, double end) {
  std::vector<SlipAt> result;
  for (const double g : {10.0, 20.0, 30.0, 40.0})
    if (const double angle = g * degree; angle <= end + 1e-9)
      result.push_back({angle, unknown, law.at(angle).value / over.at(angle).value - 1.0});
  return result;
}

} // namespace

double usual_slip(double formula_angle) {
  constexpr double at = 26.0 * degree, slip = 4.0 * degree;
  constexpr double further = (8.5 - 4.0) / (44.0 - 26.0);
  return formula_angle < at ? slip * formula_angle / at : slip + further * (formula_angle - at);
}

SlipEffect slip_effect(const std::vector<Curve>& curves, const ShearTest& test,
                       const Fabric& fabric, const FitOptions& options, const ShearLaw& law) {
  double end = 0.0;
  for (const Curve& curve : curves)
    end = std::max(end, *std::max_element(curve.angle.begin(), curve.angle.end()));
  Diagnostics ignored;
  const auto formula =
      identify_shear(curves, test, fabric, for_comparison(options, false), ignored);
  SlipEffect effect{torques(formula ? formula->law : law, law, std::min(end, options.to)),
                    slip_work(curves, test), formula ? "" : first_error(ignored)};
  for (SlipAt& at : effect.at) {
    at.formula = formula_at(curves, test, at.angle);
    if (!formula) at.torque = unknown;
  }
  return effect;
}

SlipEffect possible_slip(const std::vector<Curve>& curves, const ShearTest& test,
                         const Fabric& fabric, const FitOptions& options, const ShearLaw& law) {
  std::vector<Curve> slipping = curves;
  double end = 0.0;
  for (Curve& curve : slipping) {
    curve.angle.clear();
    for (const double x : curve.x) {
      const double formula = shear_angle(test, std::min(x, 0.999 * locking_extension(test)));
      curve.angle.push_back(formula - usual_slip(formula));
      end = std::max(end, curve.angle.back());
    }
  }
  Diagnostics ignored;
  const auto fit = identify_shear(slipping, test, fabric, for_comparison(options, true), ignored);
  if (!fit) return {{}, 0.0, first_error(ignored)};
  return {torques(law, fit->law, std::min(end, options.to)), slip_work(slipping, test), ""};
}

bool put_angles(Curve& curve, Curve angles, Diagnostics& diagnostics) {
  if (!check_rising(angles, "displacement", diagnostics)) return false;
  std::vector<double> x, angle; // rows of one displacement: their last angle
  for (std::size_t i = 0; i < angles.size(); ++i) {
    if (!x.empty() && angles.x[i] == x.back()) {
      angle.back() = angles.y[i];
      continue;
    }
    x.push_back(angles.x[i]);
    angle.push_back(angles.y[i]);
  }
  const MonotoneCurve through{x, angle};
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < curve.size(); ++i)
    if (curve.x[i] >= x.front() && curve.x[i] <= x.back()) kept.push_back(i);
  const std::size_t left_out = curve.size() - kept.size();
  const std::string range = fmt::format("{:g} to {:g} mm of {}", x.front(), x.back(), angles.file);
  if (kept.size() < 2) {
    diagnostics.error(place_of(curve), "", "",
                      fmt::format("{} rows are within {}", kept.size(), range),
                      "give the angles of the same test, and their displacement in mm");
    return false;
  }
  if (left_out > 0)
    diagnostics.warning(place_of(curve), fmt::format("{} row{} beyond {}, where angles were "
                                                     "measured: left out",
                                                     left_out, left_out == 1 ? "" : "s", range));
  curve = rows_of(curve, kept);
  curve.angle.clear();
  for (const double at : curve.x)
    curve.angle.push_back(value_within(through, at));
  curve.angle_name = angles.y_name;
  curve.angle_written = {{}, angles.y_written.unit, angles.y_written.factor};
  return true;
}

} // namespace plyform
