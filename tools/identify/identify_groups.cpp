// SPDX-License-Identifier: GPL-3.0-or-later
// Specimens of two kinds: shear of both signs, with the stitch that they differ by; warp and weft.
#include "base/format.hpp"
#include "base/text.hpp"
#include "core/identify/fit_signs.hpp"
#include "core/identify/fit_stitch.hpp"
#include "core/identify/stitch_load.hpp"
#include "tools/identify/identify_parts.hpp"
#include "tools/identify/identify_rubber.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

std::string degrees(double angle) {
  return fmt::format("{:.3g} degrees", angle / degree);
}

/// "0.45 at 30 degrees (95 % limits 0.42 to 0.49, from the scatter between specimens)".
std::string ratio_text(const GroupDifference& d, const std::string& place) {
  return fmt::format(
      "{:.3g}{} (95 % limits {:.3g} to {:.3g}, {})", d.ratio, place, d.least, d.most,
      d.between_specimens
          ? std::string("from the scatter between specimens")
          : fmt::format("from the limits of one specimen each, and {:g} % by which specimens of "
                        "one kind usually differ",
                        100.0 * GroupDifference::usual_scatter));
}

/// Ratios at 10, 20, 30, 40 degrees, as far as both go.
std::string ratios_along(const LawDifference& difference) {
  std::string text;
  for (const double angle : {10.0, 20.0, 30.0, 40.0}) {
    const auto at = std::min_element(
        difference.places.begin(), difference.places.end(), [&](double a, double b) {
          return std::abs(a / degree - angle) < std::abs(b / degree - angle);
        });
    if (std::abs(*at / degree - angle) > 2.0) continue;
    text +=
        fmt::format("{}{:.3g} at {:.0f}", text.empty() ? "" : ", ",
                    difference.at[static_cast<std::size_t>(at - difference.places.begin())].ratio,
                    *at / degree);
  }
  return text + " degrees";
}

/// Rows of a fit as CSV, angles with a sign, specimens counted on from `before`.
std::string rows_text(const ShearFit& fit, double sign, std::size_t before) {
  std::string rows;
  for (std::size_t i = 0; i < fit.angle.size(); ++i)
    rows += fmt::format("{:.9g},{:.9g},{:.9g},{:.9g},{}\n", fit.extension[i],
                        sign * fit.angle[i] / degree, fit.measured[i], fit.fitted[i],
                        before + fit.specimen[i] + 1);
  return rows;
}

constexpr const char* rows_header = "displacement_mm,shear_deg,measured_N,fitted_N,specimen\n";

/// Figures and notes of one side behind its name.
void put_side(const std::string& side, const Identified& of, Identified& result) {
  for (const std::string& figure : of.figures)
    result.figures.push_back(side + ": " + figure);
  for (const std::string& note : of.notes)
    result.notes.push_back(side + ": " + note);
  for (const LawNumber& number : of.numbers)
    result.numbers.push_back({side + ": " + number.name, number.unit, number.value, number.limits});
}

/// A law of both signs as TOML.
LawText signs_law(const ShearLaw& law) {
  const auto list = [](const std::vector<double>& k) {
    std::string text;
    for (const double value : k)
      text += fmt::format("{}{:.7g}", text.empty() ? "" : ", ", value);
    return "[" + text + "]";
  };
  if (!law.tabulated())
    return {
        "shear", "polynomial", list(law.k), {}, {{"negative_polynomial", list(law.negative_k)}}};
  std::string rows;
  for (std::size_t i = 0; i < law.angle.size(); ++i)
    rows += fmt::format("\n    [{:.6g}, {:.6g}],", law.angle[i] / degree, law.torque[i]);
  return {"shear", "table", "[" + rows + "\n]", {}};
}

void note_stitches(const Fabric& fabric, const std::vector<std::size_t>& taken,
                   Identified& result) {
  if (taken.empty()) return;
  std::vector<std::string> names;
  for (const std::size_t i : taken)
    names.push_back(fabric.stitches[i].name);
  result.figures.push_back(fmt::format("taken off: what {} {} by {} in the fabric file",
                                       joined(names), names.size() > 1 ? "pull" : "pulls",
                                       names.size() > 1 ? "their laws" : "its law"));
}

Identified signs_text(const SignsFit& fit, const Fabric& fabric) {
  const Identified above = shear_text(fit.positive), below = shear_text(fit.negative);
  const LawDifference& d = fit.difference;
  Identified result = fit.both ? shear_text(*fit.both) : Identified{};
  const std::string ratio =
      d.at.empty() ? std::string("not comparable")
                   : ratio_text(d.at[d.clearest], " at " + degrees(d.places[d.clearest]));
  if (fit.both) {
    result.figures.push_back("torque of negative angles over that of positive ones " + ratio +
                             ": no difference beyond scatter, one law for both signs");
  } else {
    result.title = "shear law of both signs";
    result.provides = {"shear"};
    result.laws = {signs_law(fit.law)};
    result.law_line =
        "positive angles: " + above.law_line + "\n  negative angles: " + below.law_line;
    result.figures.push_back("torque of negative angles over that of positive ones " + ratio +
                             ": the sides differ; " + ratios_along(d));
    put_side("positive angles", above, result);
    put_side("negative angles", below, result);
  }
  note_stitches(fabric, stitches_of(fabric), result);
  result.fit = rows_header + rows_text(fit.positive, 1.0, 0) +
               rows_text(fit.negative, -1.0, fit.positive.specimens.size());
  return result;
}

/// Keys of the stitch found, in its [[stitch]].
std::vector<LawText> stitch_laws(const StitchFit& fit, const StitchLaw& base, std::size_t seam) {
  const std::string table = fmt::format("stitch[{}]", seam);
  const StitchLaw& law = fit.law;
  std::vector<LawText> laws;
  const double pull = law.at(0.0).value;
  if (fit.line) {
    laws.push_back({table, "stiffness", fmt::format("{:.7g}", law.tension.stiffness), {}});
  } else {
    std::string rows;
    for (std::size_t i = 0; i < law.tension.strain.size(); ++i)
      rows += fmt::format("\n    [{:.6g}, {:.6g}],", law.tension.strain[i], law.tension.tension[i]);
    laws.push_back({table, "table", "[" + rows + "\n]", {}});
  }
  laws.push_back(
      {table, "slack", law.taut_at > 0.0 ? fmt::format("{:.6g}", law.taut_at) : std::string(), {}});
  laws.push_back(
      {table, "pretension", pull > 0.0 ? fmt::format("{:.6g}", pull) : std::string(), {}});
  if (fit.breaks)
    laws.push_back({table, "breaking_force", fmt::format("{:.6g}", law.breaking_force), {}});
  else if (base.breaking_force < law.at(fit.strain_to).value)
    laws.push_back({table, "breaking_force", "", {}});
  return laws;
}

std::string stitch_line(const StitchFit& fit) {
  const StitchLaw& law = fit.law;
  const double force = law.at(fit.strain_to).value, pull = law.at(0.0).value;
  std::string line = fit.line
                         ? fmt::format("stiffness = {:.5g} N per stitch", law.tension.stiffness)
                         : fmt::format("table of {} rows, no line fits", law.tension.strain.size());
  if (law.taut_at > 0.0) line += fmt::format(", slack up to an elongation of {:.4g}", law.taut_at);
  if (pull > 0.0) line += fmt::format(", pre-tension {:.4g} N", pull);
  line += fmt::format("; {:.4g} N at an elongation of {:.4g}", force, fit.strain_to);
  if (fit.breaks)
    line += fmt::format(", and breaks between {:.4g} and {:.4g}, at {:.4g} N", fit.breaks_from,
                        fit.breaks_to, law.breaking_force);
  return line;
}

Identified stitch_text(const StitchFit& fit, const FabricReading& base, std::size_t seam,
                       std::size_t specimens) {
  const Fabric& fabric = *base.value;
  const SeamReading& own = base.seams[seam];
  const StitchLaw& before = fabric.stitches[own.stitches.front()].law;
  const Identified slack = shear_text(fit.slack);
  const std::string drawn = fit.drawn_by_positive ? "positive angles" : "negative angles",
                    other = fit.drawn_by_positive ? "negative angles" : "positive angles";
  Identified result;
  result.title = "law of " + own.name + ", and shear law,";
  result.provides = {"shear"};
  result.laws = slack.laws;
  for (LawText& law : stitch_laws(fit, before, seam))
    result.laws.push_back(std::move(law));
  result.law_line = fmt::format("shear, by {}, where it is slack: {}", other, slack.law_line);
  result.figures.push_back(
      fmt::format("{}: {}, by {}, which draw it", own.name, stitch_line(fit), drawn));
  if (fit.line)
    result.numbers.push_back(
        {own.name + ": stiffness", "N", fit.law.tension.stiffness, fit.stiffness_limits});
  result.figures.push_back("load on that side: " +
                           figure_of_residuals(fit.quality, degrees(fit.quality.largest_at)));
  result.figures.push_back(
      fmt::format("95 % limits {}of its force +- {:.2g} % at an elongation of {:.3g}; from {}",
                  fit.line ? fmt::format("stiffness +- {:.2g} N, taut from +- {:.2g}, ",
                                         fit.stiffness_limits, fit.taut_limits)
                           : std::string(),
                  100.0 * fit.force_limits, fit.strain_to,
                  fit.limits_between ? "the spread of specimens" : "the rows, not from specimens"));
  put_side("shear law, " + other, slack, result);
  std::vector<std::size_t> taken = stitches_of(fabric, own.stitches);
  note_stitches(fabric, taken, result);
  if (!fit.breaks)
    result.notes.push_back(fmt::format(
        "no break up to an elongation of {:.3g}: beyond, its force is a guess{}", fit.strain_to,
        before.breaking_force < fit.law.at(fit.strain_to).value
            ? "; the breaking_force of the base is less than what it bore, and is taken out"
            : ""));
  result.fit = rows_header;
  for (std::size_t i = 0; i < fit.angle.size(); ++i)
    result.fit += fmt::format("{:.9g},{:.9g},{:.9g},{:.9g},{}\n", fit.extension[i],
                              (fit.drawn_by_positive ? 1.0 : -1.0) * fit.angle[i] / degree,
                              fit.measured[i], fit.fitted[i], fit.specimen[i] + 1);
  result.fit += rows_text(fit.slack, fit.drawn_by_positive ? -1.0 : 1.0, specimens);
  return result;
}

std::size_t seam_named(const FabricReading& base, const std::string& name) {
  const auto at = std::find_if(base.seams.begin(), base.seams.end(),
                               [&](const SeamReading& seam) { return seam.name == name; });
  return static_cast<std::size_t>(at - base.seams.begin());
}

/// "warp 46000, weft 48000 N per yarn": what comparing means for a fabric called balanced.
std::string balance_text(const std::string& what, const GroupDifference& d,
                         const std::string& place) {
  return fmt::format("weft over warp, {}: {}: {}", what, ratio_text(d, place),
                     d.differs() ? "they differ, and the fabric is not balanced in this: keep both "
                                   "laws, and lay plies by their warp"
                                 : "no difference beyond scatter");
}

/// The texts of two families as one; `balance`: how they compare, or empty.
Identified of_both(const std::string& title, const Identified& warp, const Identified& weft,
                   const std::string& balance) {
  Identified result;
  result.title = title;
  result.laws = {warp.laws.front(), weft.laws.front()};
  result.law_line = "warp: " + warp.law_line + "\n  weft: " + weft.law_line;
  if (!balance.empty()) result.figures.push_back(balance);
  put_side("warp", warp, result);
  put_side("weft", weft, result);
  result.fit = warp.fit + "# weft\n" + weft.fit.substr(weft.fit.find('\n') + 1);
  return result;
}

std::optional<Identified> tension_groups(const IdentifyArguments& a,
                                         const std::vector<Curve>& curves,
                                         const std::vector<Curve>& others,
                                         const FitOptions& options, Diagnostics& diagnostics) {
  IdentifyArguments of_weft = a;
  of_weft.test = "weft";
  of_weft.curves = a.others;
  of_weft.yarns = a.weft_yarns.value_or(a.yarns);
  const auto warp = identify_tension(curves, {a.yarns, a.gauge_length}, options, diagnostics);
  const auto weft = identify_tension(others, {of_weft.yarns, a.gauge_length}, options, diagnostics);
  if (!warp || !weft) return std::nullopt;
  const Identified first = tension_text(*warp, a), second = tension_text(*weft, of_weft);
  // Tensions of each specimen by a law of its own, at tenths of the strain that both reach.
  const double end = std::min(warp->quality.to, weft->quality.to);
  std::vector<double> strains;
  for (int i = 2; i <= 10; ++i)
    strains.push_back(0.1 * i * end);
  const auto tensions = [&](const TensionFit& fit, const std::vector<Curve>& all, double yarns) {
    std::vector<std::vector<double>> of;
    for (const Curve& curve : all) {
      Diagnostics told_before;
      const auto own = identify_tension(curve, {yarns, a.gauge_length}, options, told_before);
      of.emplace_back();
      for (const double strain : strains)
        of.back().push_back((own ? own->law : fit.law).at(strain).value);
    }
    return of;
  };
  const LawDifference d = difference_of(strains, tensions(*warp, curves, a.yarns),
                                        tensions(*weft, others, of_weft.yarns),
                                        {warp->confidence.law, weft->confidence.law});
  const std::string balance =
      d.at.empty() ? std::string()
                   : balance_text("tension per yarn", d.at[d.clearest],
                                  fmt::format(" at a strain of {:.3g}", d.places[d.clearest]));
  Identified result = of_both("tension laws of warp and weft", first, second, balance);
  result.provides = {"warp", "weft"};
  return result;
}

std::optional<Identified> bending_groups(const IdentifyArguments& a, const Fabric& fabric,
                                         const std::vector<Curve>& curves,
                                         const std::vector<Curve>& others,
                                         const FitOptions& options, Diagnostics& diagnostics) {
  IdentifyArguments of_weft = a;
  of_weft.direction = "weft";
  of_weft.curves = a.others;
  const auto warp = identify_cantilever(curves, reading_of(a), fabric, options, diagnostics);
  const auto weft = identify_cantilever(others, reading_of(a), fabric, options, diagnostics);
  if (!warp || !weft) return std::nullopt;
  const Identified first = bending_text(*warp, a), second = bending_text(*weft, of_weft);
  return of_both(
      "bending stiffnesses of warp and weft", first, second,
      balance_text("bending stiffness",
                   difference_of(warp->of_specimen, weft->of_specimen,
                                 {warp->limits / warp->stiffness, weft->limits / weft->stiffness}),
                   ""));
}

} // namespace

bool has_groups(const IdentifyArguments& a, const Fabric& fabric) {
  if (is_rubber_test(a.test) || a.test == "compaction") return false; // one law for both
  return !a.others.empty() || (is_shear_test(a.test) && !fabric.stitches.empty());
}

void check_groups(const IdentifyArguments& a, const FabricReading& base, Diagnostics& diagnostics) {
  if (a.test == "cantilever" && !a.others.empty() && a.direction != "warp")
    option_error("--direction", a.direction, "must be warp where --weft has the other specimens",
                 "give --direction warp", diagnostics);
  if (are_laboratories(a) && !a.others.empty())
    option_error("--negative", a.others.front(), "cannot stand beside curves of laboratories",
                 "identify both signs of one laboratory, or the laboratories of each sign",
                 diagnostics);
  if (a.stitch.empty()) return;
  if (a.others.empty())
    option_error("--stitch", a.stitch,
                 "needs curves of both signs: a stitch is what they differ by",
                 "give those of the other side with --negative", diagnostics);
  if (!base.value || seam_named(base, a.stitch) < base.seams.size()) return;
  std::vector<std::string> names;
  for (const SeamReading& seam : base.seams)
    names.push_back(seam.name);
  option_error("--stitch", a.stitch, "is no stitch of the fabric",
               names.empty() ? "write a [[stitch]] with its direction, density and any stiffness "
                               "into the fabric file"
                             : "it has " + joined(names),
               diagnostics);
}

std::optional<Identified> identify_groups(const IdentifyArguments& a, const FabricReading& base,
                                          const std::optional<PreparedShear>& prepared,
                                          const std::vector<Curve>& curves,
                                          const std::vector<Curve>& others,
                                          const FitOptions& options, Diagnostics& diagnostics) {
  const Fabric& fabric = *base.value;
  const ShearTest* test = prepared ? &prepared->test : nullptr;
  const auto with_assumed = [&](Identified text) {
    text.figures.insert(text.figures.begin(), prepared->assumed.begin(), prepared->assumed.end());
    return text;
  };
  if (a.test == "cantilever")
    return bending_groups(a, fabric, curves, others, options, diagnostics);
  if (!test) return tension_groups(a, curves, others, options, diagnostics);
  if (!a.stitch.empty()) {
    const std::size_t seam = seam_named(base, a.stitch);
    const auto fit = identify_stitch({curves, others}, base.seams[seam].stitches, *test, fabric,
                                     options, diagnostics);
    if (!fit) return std::nullopt;
    const std::size_t drawn = fit->drawn_by_positive ? curves.size() : others.size();
    return with_assumed(stitch_text(*fit, base, seam, drawn));
  }
  if (!fabric.stitches.empty())
    diagnostics.warning({a.fabric, 1, 1},
                        "what its stitches pull by their laws is taken off the loads first: "
                        "--stitch NAME finds such a law from both signs; for a law of shear that "
                        "has the stitches in it take them out of the file");
  if (!others.empty()) {
    const auto fit = identify_signs(curves, others, *test, fabric, options, diagnostics);
    return fit ? std::optional(with_assumed(signs_text(*fit, fabric))) : std::nullopt;
  }
  const auto all = stitches_of(fabric);
  const auto fit = identify_shear(without_stitches(curves, *test, fabric, all, false, options),
                                  *test, fabric, options, diagnostics);
  if (!fit) return std::nullopt;
  Identified result = shear_text(*fit);
  note_stitches(fabric, all, result);
  return with_assumed(result);
}

} // namespace plyform
