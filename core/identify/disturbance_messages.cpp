// SPDX-License-Identifier: GPL-3.0-or-later
// Disturbances of a curve in words: fit_quality.hpp.
#include "base/format.hpp"
#include "core/identify/fit_quality.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

using Kind = DisturbanceKind;

std::string with_unit(const std::string& unit) {
  return unit.empty() ? "" : " " + unit;
}

std::string description(const Disturbance& d, const Curve& curve, const LoadRows& rows,
                        const CurveWords& words, std::size_t first) {
  const std::string unit = with_unit(words.length_unit);
  const double scale = d.kind == Kind::load_zero ? words.y_scale : words.x_scale;
  const std::string amount = fmt::format("{:.3g}", std::abs(scale * d.amount)),
                    limits = fmt::format("{:.2g}", scale * d.limits);
  switch (d.kind) {
  case Kind::load_zero:
    return fmt::format(
        "a load zero off by {}{} N (+- {}; {:.2g} % of the largest load){}",
        d.amount < 0.0 ? "-" : "", amount, limits, 100.0 * d.amount / rows.y.maxCoeff(),
        words.stiff_start && d.amount > 0.0 ? ", or a displacement zero that was set too late"
                                            : "");
  case Kind::displacement_zero:
    return d.amount > 0.0
               ? fmt::format("a specimen that was slack up to {}{} (+- {})", amount, unit, limits)
               : fmt::format("a displacement zero set {}{} too late (+- {})", amount, unit, limits);
  case Kind::stretch:
    return fmt::format("an extension {:.2g} % too large (+- {:.2g}; {:.3g}{} at the end) by slip "
                       "in the clamps or the machine's compliance",
                       100.0 * d.amount, 100.0 * d.limits, d.amount * scale * rows.x.maxCoeff(),
                       unit);
  default:
    return fmt::format("a slip of {}{} (+- {}) before line {}", amount, unit, limits,
                       curve.line[first + d.row]);
  }
}

std::string remedy_of(const Disturbance& d, const CurveWords& words) {
  switch (d.kind) {
  case Kind::load_zero:
    return std::string("--zero fit takes it off, --zero 0 keeps it") +
           (words.stiff_start && d.amount > 0.0 ? ", --toe below 0 gives the displacement" : "");
  case Kind::displacement_zero:
    return "--toe fit takes it off, --toe 0 keeps it";
  case Kind::stretch:
    return (words.x_is_length ? "give --compliance" : "measure the strain on the specimen") +
           words.angle_remedy + ", or take more --coefficients if the fabric is so";
  default:
    return "--slip fit takes it off, --to ends the curve before it" + words.angle_remedy;
  }
}

} // namespace

std::vector<Kind> kinds_looked_for(const FitOptions& options, const CurveWords& words) {
  const Corrections& c = options.corrections;
  std::vector<Kind> kinds;
  if (words.zeros_show && !c.load_zero && !c.fit_load_zero) kinds.push_back(Kind::load_zero);
  if (words.toe_shows && !c.toe && !c.fit_toe) kinds.push_back(Kind::displacement_zero);
  if (words.can_stretch) kinds.push_back(Kind::stretch);
  if (!c.fit_slip) kinds.push_back(Kind::slip);
  return kinds;
}

bool check_disturbances(const Curve& curve, const LinearLaw& law, const LoadRows& rows,
                        const FitOptions& options, const CurveWords& words,
                        Diagnostics& diagnostics) {
  const auto found = find_disturbances(law, rows, kinds_looked_for(options, words));
  if (found.empty()) return true;
  const auto start = std::find(curve.x.begin(), curve.x.end(), rows.x[0]);
  const auto first = static_cast<std::size_t>(start - curve.x.begin());
  const Disturbance& best = found.front();
  std::string what, remedy;
  for (const Disturbance& d : found) {
    what += (what.empty() ? "" : ", or ") + description(d, curve, rows, words, first);
    remedy += (remedy.empty() ? "" : "; ") + remedy_of(d, words);
  }
  const double squares = best.squares / best.plain_squares;
  const std::string rule =
      fmt::format("the rows show {}: with it residuals are {:.2g} times as large; without, the "
                  "law is up to {:.2g} % wrong",
                  what, std::sqrt(squares), 100.0 * std::min(best.change, 10.0));
  const bool worthless = best.change > useless && best.chance < surely_not_chance &&
                         best.is_no_shape && best.kind != Kind::stretch;
  if (!worthless || options.doubtful) {
    diagnostics.warning(place_of(curve), rule + "; " + remedy);
    return true;
  }
  diagnostics.error(place_of(curve), "", "", rule,
                    remedy + "; --yes-doubtful takes the curve as it is");
  return false;
}

void warn_of_unknowns(const Curve& curve, const LinearLaw& law, const LoadRows& rows,
                      const Sensitivity& sensitive, const FitOptions& options,
                      const CurveWords& words, Diagnostics& diagnostics) {
  if (!words.x_is_length || options.measured_angle) return;
  constexpr double compliance_counts = 0.02, zero_counts = 0.05; // of the law
  const auto percent = [](double share) { return 100.0 * std::min(share, 10.0); };
  const Corrections& c = options.corrections;
  std::string what, remedy;
  if (!c.compliance && sensitive.compliance >= compliance_counts) {
    what = fmt::format("the compliance of machine and clamps ({:g} mm/N would move the law by "
                       "{:.2g} %)",
                       common_compliance, percent(sensitive.compliance));
    remedy = "--compliance";
  }
  if (!c.toe && !c.fit_toe && words.toe_shows) {
    const double limits = best_toe(law, rows).limits;
    if (limits / words.length * sensitive.toe >= zero_counts) {
      what += fmt::format("{}the displacement zero (known to +- {:.2g} mm, {:g} mm would "
                          "move the law by {:.2g} %)",
                          what.empty() ? "" : ", ", limits * words.x_scale,
                          words.length * words.x_scale, percent(sensitive.toe));
      remedy += remedy.empty() ? "--toe" : " and --toe";
    }
  }
  if (!what.empty() && words.can_stretch)
    what += fmt::format(", slip in the clamps that goes on ({:g} mm by the end would move the law "
                        "by {:.2g} %)",
                        words.length * words.x_scale, percent(sensitive.slip));
  if (!what.empty())
    diagnostics.warning(place_of(curve),
                        fmt::format("not known from this curve: {}; give {}, 0 where there is "
                                    "none{}",
                                    what, remedy, words.angle_remedy));
}

} // namespace plyform
