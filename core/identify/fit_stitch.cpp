// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/identify/fit_stitch.hpp"

#include "base/format.hpp"
#include "core/identify/fit_signs.hpp"
#include "core/identify/shear_rows.hpp"
#include "core/identify/stitch_rows.hpp"
#include "core/identify/stitch_start.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plyform {
namespace {

/// Whether shear of one sign draws all legs of a stitch; reports an error if not.
std::optional<bool> drawn_by_negative(const Fabric& fabric, const std::vector<std::size_t>& own,
                                      const Place& at, Diagnostics& diagnostics) {
  bool above = false, below = false;
  for (const std::size_t i : own) {
    constexpr double least = 0.05; // 1/rad: a stitch 3 degrees from a family
    const double rate = elongation_of(fabric, fabric.stitches[i], 0.0).rate;
    above = above || rate > least;
    below = below || rate < -least;
    if (std::abs(rate) > least) continue;
    diagnostics.error(at, fabric.stitches[i].name,
                      fmt::format("{:g}", fabric.stitches[i].angle / degree),
                      "lies along one of the families, and shear does not draw it",
                      "measure its force in a tension test along it");
    return std::nullopt;
  }
  if (above != below) return below;
  diagnostics.error(at, fabric.stitches[own.front()].name, "",
                    "has legs of which positive shear draws one and negative shear the other: the "
                    "two sides do not tell the legs apart",
                    "draw single threads for its law, or give both sides a law of shear without "
                    "--stitch");
  return std::nullopt;
}

Fabric with_stitch(const StitchTest& t, const StitchLaw& law) {
  Fabric fabric = t.fabric;
  for (const std::size_t i : t.own)
    fabric.stitches[i].law = law;
  return fabric;
}

/// The law of shear, from curves on the slack side; `law`: of the stitch, which may pull there.
std::optional<ShearFit> slack_side(const StitchTest& t, const std::vector<Curve>& curves,
                                   StitchLaw law, Diagnostics& diagnostics) {
  law.breaking_force = std::numeric_limits<double>::infinity();
  const Fabric fabric = with_stitch(t, law);
  return identify_shear(
      without_stitches(curves, t.test, fabric, stitches_of(fabric), !t.negative, t.options), t.test,
      t.fabric, t.options, diagnostics);
}

/// Rows of the side that draws the stitch, as measured.
struct DrawnRows {
  StitchRows rows;
  std::vector<double> angle, measured, shares;
  std::vector<std::size_t> specimen;
  std::size_t left_out = 0; ///< beyond the other side's range
};

std::optional<DrawnRows> drawn_side(const StitchTest& t, const std::vector<Curve>& curves,
                                    double to, bool pulls, Diagnostics& diagnostics) {
  FitOptions options = t.options;
  options.flows = options.flows || pulls;
  DrawnRows drawn{{t.test, t.fabric, t.own, t.negative, {}, {}, {}}, {}, {}, {}, {}, 0};
  const auto cleared = without_stitches(curves, t.test, t.fabric, t.others, t.negative, t.options);
  constexpr double beyond = 1.02;
  for (std::size_t n = 0; n < cleared.size(); ++n) {
    const auto specimen = shear_specimen(cleared[n], t.test, t.fabric, options, diagnostics);
    if (!specimen) return std::nullopt;
    const auto count = std::count_if(specimen->angle.begin(), specimen->angle.end(),
                                     [&](double g) { return g <= beyond * to; });
    for (std::size_t i = 0; i < specimen->angle.size(); ++i) {
      if (specimen->angle[i] > beyond * to) {
        ++drawn.left_out;
        continue;
      }
      drawn.rows.extension.push_back(specimen->rows.x[static_cast<Eigen::Index>(i)]);
      drawn.angle.push_back(specimen->angle[i]);
      drawn.measured.push_back(specimen->rows.y[static_cast<Eigen::Index>(i)]);
      drawn.shares.push_back(1.0 / std::sqrt(static_cast<double>(count)));
      drawn.specimen.push_back(n);
    }
  }
  return drawn;
}

struct StitchBeside {
  StitchSolution stitch;
  std::vector<double> fitted; ///< whole load
};

/// The stitch beside a law of shear.
StitchBeside beside(const StitchTest& t, const DrawnRows& drawn, const ShearFit& slack,
                    std::optional<double> breaks) {
  Fabric fabric = t.fabric;
  fabric.crossings[0].shear = slack.law;
  StitchRows rows = drawn.rows;
  const auto n = static_cast<Eigen::Index>(rows.extension.size());
  Eigen::VectorXd shear(n);
  for (Eigen::Index i = 0; i < n; ++i)
    shear[i] = (1.0 + slack.in_plane.mean()) *
               test_load(t.test, fabric, rows.extension[static_cast<std::size_t>(i)]);
  const Eigen::VectorXd measured = vector_of(drawn.measured);
  rows.added = measured - shear;
  Eigen::VectorXd fitted = measured;
  StitchBeside solved;
  for (int i = 0; i < 3; ++i) { // weights by the fitted load
    rows.weights = load_weights(fitted, measured) * vector_of(drawn.shares).array() *
                   std::sqrt(static_cast<double>(n));
    solved.stitch = solve_stitch(rows, breaks);
    fitted = shear + solved.stitch.fitted;
  }
  solved.fitted.assign(fitted.begin(), fitted.end());
  return solved;
}

struct BothSides {
  ShearFit slack;
  DrawnRows drawn;
  StitchBeside solved;
};

/// Law of shear and stitch, with what the stitch pulls on the slack side, from a first law on.
std::optional<BothSides> solve_from(StitchLaw law, const StitchTest& t, const SignedCurves& curves,
                                    std::optional<double> breaks, Diagnostics& diagnostics) {
  const auto& slack_curves = t.negative ? curves.positive : curves.negative;
  const auto& drawn_curves = t.negative ? curves.negative : curves.positive;
  constexpr int rounds = 12;
  for (int round = 0; round < rounds; ++round) {
    Diagnostics told;
    const auto slack = slack_side(t, slack_curves, law, told);
    const bool pulls = law.at(0.0).value > 0.0; // so that loads do not begin at 0
    const auto drawn =
        slack ? drawn_side(t, drawn_curves, slack->quality.to, pulls, told) : std::nullopt;
    const bool some = drawn && drawn->angle.size() >= 6 && !drawn->rows.elongations().empty();
    const double before = law.at(0.0).value;
    std::optional<BothSides> sides;
    if (some) {
      sides.emplace(BothSides{*slack, *drawn, beside(t, *drawn, *slack, breaks)});
      law = sides->solved.stitch.law;
    }
    const bool settled =
        std::abs(law.at(0.0).value - before) <= 1e-4 * std::max(law.at(0.0).value, before);
    if (some && !settled && round + 1 < rounds) continue;
    diagnostics.warnings.insert(diagnostics.warnings.end(), told.warnings.begin(),
                                told.warnings.end());
    diagnostics.errors.insert(diagnostics.errors.end(), told.errors.begin(), told.errors.end());
    if (!slack && !(law.at(0.0).value > 0.0) && slack_curves.front().y.front() < 0.0)
      diagnostics.warning(place_of(slack_curves.front()),
                          "if stitches pull from the start, their pre-tension makes this load "
                          "negative: give the stitch a pretension in the fabric file");
    if (drawn && !some)
      diagnostics.error(place_of(drawn_curves.front()), "", "",
                        fmt::format("only {} rows up to {:.3g} degrees, where the curves of the "
                                    "other side end",
                                    drawn->angle.size(), slack->quality.to / degree),
                        "record more rows, or test the other side further");
    return sides;
  }
  return std::nullopt;
}

/// Likewise, from the first law that leads to one.
std::optional<BothSides> solve_sides(const StitchTest& t, const SignedCurves& curves,
                                     std::optional<double> breaks, Diagnostics& diagnostics) {
  std::optional<Diagnostics> refused; // from the first start
  for (const StitchLaw& law : first_laws(t, curves, breaks)) {
    Diagnostics told;
    auto sides = solve_from(law, t, curves, breaks, told);
    if (sides && told.errors.empty()) {
      diagnostics.warnings.insert(diagnostics.warnings.end(), told.warnings.begin(),
                                  told.warnings.end());
      return sides;
    }
    if (!refused) refused = std::move(told);
  }
  diagnostics.warnings.insert(diagnostics.warnings.end(), refused->warnings.begin(),
                              refused->warnings.end());
  diagnostics.errors.insert(diagnostics.errors.end(), refused->errors.begin(),
                            refused->errors.end());
  return std::nullopt;
}

/// Curves with one specimen left out, or one block of rows of the only one.
std::vector<std::vector<Curve>> left_out(const std::vector<Curve>& curves) {
  std::vector<std::vector<Curve>> sets;
  if (curves.size() > 1) {
    for (std::size_t n = 0; n < curves.size(); ++n) {
      sets.push_back(curves);
      sets.back().erase(sets.back().begin() + static_cast<std::ptrdiff_t>(n));
    }
    return sets;
  }
  constexpr std::size_t blocks = 8;
  const std::size_t inner = curves[0].size() - std::min<std::size_t>(curves[0].size(), 2);
  for (std::size_t b = 0; b < blocks; ++b) {
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < curves[0].size(); ++i) // the first and the last row stay
      if (i <= b * inner / blocks || i > (b + 1) * inner / blocks || i + 1 == curves[0].size())
        kept.push_back(i);
    sets.push_back({rows_of(curves[0], kept)});
  }
  return sets;
}

/// Half widths of 95 % limits of stiffness, taut_at and the last force.
Eigen::Vector3d jackknife(const StitchTest& t, const SignedCurves& curves, double breaks,
                          double strain) {
  Eigen::Vector3d variance = Eigen::Vector3d::Zero();
  double freedom = -2.0;
  for (const bool side : {false, true}) {
    std::vector<Eigen::Vector3d> found;
    for (const std::vector<Curve>& set : left_out(side ? curves.negative : curves.positive)) {
      SignedCurves part = curves;
      (side ? part.negative : part.positive) = set;
      Diagnostics ignored;
      if (const auto s = solve_sides(t, part, breaks, ignored)) {
        const StitchLaw& law = s->solved.stitch.law;
        found.emplace_back(law.tension.stiffness, law.taut_at, law.at(strain).value);
      }
    }
    if (found.size() < 2) return Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
    const double n = static_cast<double>(found.size());
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& one : found)
      mean += one / n;
    for (const Eigen::Vector3d& one : found)
      variance += (n - 1.0) / n * (one - mean).cwiseAbs2();
    freedom += n;
  }
  return student_95(freedom) * variance.cwiseSqrt();
}

StitchFit result_of(const BothSides& sides, const StitchTest& t) {
  const StitchSolution& s = sides.solved.stitch;
  StitchFit fit;
  fit.slack = sides.slack;
  fit.drawn_by_positive = !t.negative;
  fit.law = s.law;
  fit.line = s.line;
  fit.breaks = s.breaks_at > 0.0;
  fit.breaks_from = s.breaks_from, fit.breaks_to = s.breaks_to;
  fit.strain_to = fit.breaks ? s.breaks_from : sides.drawn.rows.elongations().back();
  fit.extension = sides.drawn.rows.extension;
  fit.angle = sides.drawn.angle;
  fit.measured = sides.drawn.measured;
  fit.fitted = sides.solved.fitted;
  fit.specimen = sides.drawn.specimen;
  fit.quality = quality_of(fit.angle, fit.measured, fit.fitted);
  return fit;
}

} // namespace

std::optional<StitchFit> identify_stitch(const SignedCurves& curves,
                                         const std::vector<std::size_t>& own, const ShearTest& test,
                                         const Fabric& fabric, const FitOptions& options,
                                         Diagnostics& diagnostics) {
  const Curve& shown = curves.positive.front();
  const auto negative = drawn_by_negative(fabric, own, place_of(shown), diagnostics);
  if (!negative) return std::nullopt;
  const StitchTest t{test, fabric, options, own, stitches_of(fabric, own), *negative};
  const auto sides = solve_sides(t, curves, std::nullopt, diagnostics);
  if (!sides) return std::nullopt;
  StitchFit fit = result_of(*sides, t);
  const Curve& drawn = (*negative ? curves.negative : curves.positive).front();
  if (!check_quality(drawn, fit.quality,
                     fmt::format("{:.3g} degrees, where shear draws the stitch",
                                 fit.quality.largest_at / degree),
                     "check which curves are of negative angles, and the direction of the stitch; "
                     "leave out what is no shear with --to",
                     diagnostics))
    return std::nullopt;
  if (sides->drawn.left_out > 0)
    diagnostics.warning(place_of(drawn),
                        fmt::format("{} rows beyond {:.3g} degrees, where the curves of the other "
                                    "side end, say nothing of the stitch and are left out",
                                    sides->drawn.left_out, fit.slack.quality.to / degree));
  const double breaks =
      fit.breaks ? sides->solved.stitch.breaks_at : std::numeric_limits<double>::infinity();
  const double force = fit.law.at(fit.strain_to).value;
  FitOptions of_that_form = options; // of the law of shear, whatever is left out
  of_that_form.law = fit.slack.form.kind;
  const bool table = fit.slack.form.kind == ShearFormKind::table;
  of_that_form.points = table ? fit.slack.form.size : 0;
  of_that_form.coefficients = table ? 0 : fit.slack.form.size;
  const StitchTest again{test, fabric, of_that_form, own, t.others, *negative};
  const Eigen::Vector3d limits = jackknife(again, curves, breaks, fit.strain_to);
  fit.stiffness_limits = limits[0], fit.taut_limits = limits[1];
  fit.force_limits = limits[2] / force;
  fit.limits_between = curves.positive.size() > 1 && curves.negative.size() > 1;
  if (force > 0.0 && limits[2] < force) return fit;
  constexpr double rounding = 1e-9; // of the largest load
  const bool any = force > rounding * *std::max_element(fit.measured.begin(), fit.measured.end());
  diagnostics.error(place_of(drawn), fabric.stitches[own.front()].name,
                    fmt::format("{:.3g} N", any ? force : 0.0),
                    any ? fmt::format("is no more than chance: its 95 % limits are +- {:.3g} N, "
                                      "and the two sides do not differ beyond their scatter",
                                      limits[2])
                        : std::string("is all that the side which draws it bears beyond the other "
                                      "one: the curves show no stitch"),
                    fmt::format("check which curves are of negative angles: {} shear draws this "
                                "stitch; test more specimens, or take the law of both sides "
                                "without --stitch",
                                *negative ? "negative" : "positive"));
  return std::nullopt;
}

} // namespace plyform
