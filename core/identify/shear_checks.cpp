// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/identify/shear_checks.hpp"

#include "base/format.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace plyform {
namespace {

using Eigen::Index;

/// Half the distance between a row's neighbours.
double width_at(const std::vector<double>& angle, std::size_t i) {
  const std::size_t last = angle.size() - 1;
  return 0.5 * (angle[std::min(i + 1, last)] - angle[i == 0 ? 0 : i - 1]);
}

/// What row i misses the cubic through its neighbours by, over what it would for rows that scatter
/// by 1.
double scatter_at(const std::vector<double>& angle, const std::vector<double>& torque,
                  std::size_t i) {
  const std::size_t around[] = {i - 2, i - 1, i + 1, i + 2};
  double predicted = 0.0, squares = 1.0;
  for (const std::size_t j : around) {
    double c = 1.0; // Lagrange
    for (const std::size_t k : around)
      if (k != j) c *= (angle[i] - angle[k]) / (angle[j] - angle[k]);
    predicted += c * torque[j];
    squares += c * c;
  }
  return (torque[i] - predicted) / std::sqrt(squares);
}

/// Means over 2 n + 1 neighbours.
std::vector<double> smoothed(const std::vector<double>& values, std::size_t n) {
  std::vector<double> means;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t reach = std::min({n, i, values.size() - 1 - i});
    double mean = 0.0;
    for (std::size_t j = i - reach; j <= i + reach; ++j)
      mean += values[j] / static_cast<double>(2 * reach + 1);
    means.push_back(mean);
  }
  return means;
}

} // namespace

TorqueMisfit torque_misfit(const ShearSolution& s, const LoadRows& rows, const ShearTest& test) {
  TorqueMisfit result;
  std::vector<double> angle, off;
  double squares = 0.0, noise = 0.0, all = 0.0, noise_width = 0.0, width = 0.0;
  const double factor = 1.0 + s.share.mean();
  for (Index i = 0; i < rows.x.size(); ++i) {
    const TorqueWeights w = torque_weights(test, s.fabric, rows.x[i]);
    const double torque = s.shear().at(w.angle).value, half = s.shear().at(0.5 * w.angle).value;
    const double share = torque > 0.0 ? half / torque : 0.5;
    const double fitted = w.whole * torque + w.half * half;
    angle.push_back(w.angle);
    off.push_back((rows.y[i] / factor - fitted) / (w.whole + w.half * share));
    result.torque.push_back(torque + off.back());
  }
  for (std::size_t i = 0; i < angle.size(); ++i) {
    const double torque = result.torque[i] - off[i], over = width_at(angle, i);
    squares += over * off[i] * off[i];
    all += over * torque * torque;
    width += over;
    if (i < 2 || i + 2 >= angle.size() || !(over > 0.0)) continue;
    const double scatter = scatter_at(angle, result.torque, i);
    if (!std::isfinite(scatter)) continue; // rows at one angle
    noise += over * scatter * scatter;
    noise_width += over;
  }
  if (!(all > 0.0)) return result;
  result.misfit = std::sqrt(squares / all);
  if (noise_width > 0.0) result.noise = std::sqrt(noise / noise_width / (all / width));
  return result;
}

bool check_misfit(const Curve& curve, const FitQuality& quality, const std::string& remedy,
                  Diagnostics& diagnostics) {
  const std::string figures = fmt::format("{:.3g} % rms of the torque, of the load {:.3g} % rms "
                                          "and {:.3g} % at most, at {:.3g} degrees",
                                          100.0 * quality.misfit, 100.0 * quality.rms,
                                          100.0 * quality.largest, quality.largest_at / degree);
  if (!(quality.misfit <= useless)) {
    diagnostics.error(
        place_of(curve), "", "",
        fmt::format("the curve is no law's: residuals {}; they must be less than {:g} "
                    "% of the torque",
                    figures, 100.0 * useless),
        remedy);
    return false;
  }
  if (quality.misfit > noisy)
    diagnostics.warning(place_of(curve),
                        fmt::format("noise, or a shape that the law does not have: residuals {} "
                                    "(single rows scatter by {:.2g} % of the torque); {}",
                                    figures, 100.0 * quality.noise, remedy));
  return true;
}

bool check_rises(const Curve& curve, const ShearSolution& s, const FitQuality& quality,
                 Diagnostics& diagnostics) {
  const ShearLaw& law = s.shear();
  const double at = invalid_at(law, 0.0, quality.to);
  if (at <= quality.to) {
    const LawPoint p = law.at(at);
    diagnostics.error(
        place_of(curve), "", "",
        fmt::format("the fitted torque {} at {:.3g} degrees ({:.3g} N mm, slope {:.3g} N mm/rad), "
                    "within the range covered: a cell must resist shear everywhere",
                    p.value < 0.0 ? "is negative" : "falls", at / degree, p.value, p.slope),
        s.form.kind == ShearFormKind::polynomial && s.form.size > 1
            ? fmt::format("take fewer coefficients: --coefficients {}; or --law table; or leave "
                          "out what is no shear with --from and --to",
                          s.form.size - 1)
            : "check the columns and the sign of the load");
    return false;
  }
  constexpr double end = 0.5 * std::numbers::pi;
  if (const double beyond = invalid_at(law, quality.to, end); beyond <= end)
    diagnostics.warning(place_of(curve),
                        fmt::format("beyond the range covered, from {:.3g} degrees on, the torque "
                                    "falls: do not form to larger angles with it, or take fewer "
                                    "--coefficients",
                                    beyond / degree));
  return true;
}

bool check_rows_rise(const Curve& curve, const ShearSpecimen& specimen, const TorqueMisfit& misfit,
                     const FitOptions& options, Diagnostics& diagnostics) {
  constexpr double least = 0.1, noises = 4.0; // of the largest torque; of the rows' noise
  const std::vector<double> torque = smoothed(misfit.torque, misfit.torque.size() / 20);
  const double most = *std::max_element(torque.begin(), torque.end());
  double rms = 0.0;
  for (const double value : torque)
    rms += value * value / static_cast<double>(torque.size());
  std::size_t top = 0, from = 0, to = 0;
  for (std::size_t i = 0; i < torque.size(); ++i) {
    if (torque[i] > torque[top]) top = i;
    if (torque[top] - torque[i] > torque[from] - torque[to]) {
      from = top;
      to = i;
    }
  }
  const double fall = torque[from] - torque[to];
  if (fall <= std::max(least * most, noises * misfit.noise * std::sqrt(rms))) return true;
  const auto& angle = specimen.angle;
  const std::string rule = fmt::format(
      "the torque of the rows falls from {:.3g} N mm at {:.3g} degrees to {:.3g} at {:.3g}: no law "
      "of shear falls, as a cell must resist shear everywhere; yarns slip, the specimen wrinkles, "
      "or "
      "it was unloaded",
      torque[from], angle[from] / degree, torque[to], angle[to] / degree);
  const std::string remedy =
      angle[from] > 2.0 * least_range
          ? fmt::format("end the curve there: --to {:.3g}", angle[from] / degree)
          : fmt::format("begin after it: --from {:.3g}, or take the rows before out",
                        angle[to] / degree);
  if (options.doubtful) {
    diagnostics.warning(place_of(curve), rule + "; " + remedy);
    return true;
  }
  diagnostics.error(place_of(curve), "", "", rule,
                    remedy + "; --yes-doubtful takes a law that is level there");
  return false;
}

bool check_usual_torque(const Curve& curve, const Fabric& found, double end, bool doubtful,
                        Diagnostics& diagnostics) {
  const ShearLaw& law = found.crossings[0].shear;
  const double cells = found.families[0].density * found.families[1].density;
  double rigidity = cells * law.secant(std::min(10.0 * degree, end));
  if (rigidity < usual_shear_rigidity.least) // of weaves whose yarns turn freely at first
    rigidity = cells * law.secant(std::min(30.0 * degree, end));
  return check_usual(place_of(curve), "shear stiffness", rigidity, usual_shear_rigidity, "N/mm",
                     doubtful, diagnostics);
}

void warn_of_layers(const Curve& curve, const BendingShare& share, Diagnostics& diagnostics) {
  constexpr double large = 0.4; // of the load: half of it is not known
  if (share.most <= large) return;
  diagnostics.warning(
      place_of(curve),
      fmt::format("in-plane bending of the yarns adds {:.0f} to {:.0f} % to the load of shear: the "
                  "law is as uncertain; test a longer specimen",
                  100.0 * share.least, 100.0 * share.most));
}

void warn_of_hidden(const ShearSpecimen& specimen, const ShearSolution& s, const ShearTest& test,
                    const Sensitivity& sensitive, const FitOptions& options,
                    Diagnostics& diagnostics) {
  const Corrections& c = options.corrections;
  const double first = specimen.angle.front(), most = specimen.rows.y.maxCoeff();
  if (c.fit_load_zero && first > near_zero && std::abs(specimen.corrected.load_zero) > 0.005 * most)
    diagnostics.warning(
        place_of(specimen.curve),
        fmt::format("{:.2g} N were taken off as a wrong load zero, but no row below {:.3g} degrees "
                    "shows that they are one: a static torque looks the same, and the law is then "
                    "wrong where it is small. Record rows below 1 degree, or leave --zero fit out "
                    "unless the load cell is known to be off",
                    specimen.corrected.load_zero, first / degree));
  if (s.form.kind == ShearFormKind::polynomial) return;
  if (first > near_zero && specimen.rows.y[0] > noise_share * most && !c.load_zero &&
      !c.fit_load_zero) {
    LoadRows rows = specimen.rows;
    rows.weights = s.fit.weights;
    const double zero =
        best_load_zero(linear_shear({test, s.fabric, 3, s.scale, 1.0}), rows).amount;
    diagnostics.warning(
        place_of(specimen.curve),
        fmt::format(
            "{:.3g} N at {:.3g} degrees, the first row: the curve does not show whether they "
            "are a static torque, to which the law rises from 0, or a wrong load zero (by "
            "{:.2g} N, {:.2g} % of the largest load, beside a polynomial of 3). Record rows "
            "below 1 degree, or give --zero: fit to take it off, 0 if it was checked",
            rows.y[0], first / degree, zero, 100.0 * zero / rows.y.maxCoeff()));
  }
  if (c.toe || c.fit_toe || options.measured_angle) return;
  diagnostics.warning(
      place_of(specimen.curve),
      fmt::format(
          "{}: not known from this curve is the displacement zero (1 mm would move the law by "
          "{:.2g} %); give --toe, 0 if the specimen was taut",
          s.form.kind == ShearFormKind::table
              ? "a table follows slack, slip and compliance as it follows the fabric"
              : "a static torque is reached within as little as slack is taken up in",
          100.0 * std::min(sensitive.toe, 10.0)));
}

} // namespace plyform
