// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/identify/fit_tension.hpp"

#include "base/format.hpp"
#include "core/identify/tension_rows.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace plyform {
namespace {

void check_arguments(const Strip& strip, const FitOptions& options) {
  if (!(strip.yarns > 0.0 && strip.gauge_length > 0.0))
    throw std::invalid_argument("yarns and gauge length must be greater than 0");
  if (!(options.from >= 0.0 && options.to > options.from))
    throw std::invalid_argument("the range must start at 0 or above and end above its start");
}

/// Rows of several specimens by rising strain.
Curve pooled(const std::vector<TensionSpecimen>& specimens) {
  Curve all = specimens.front().curve;
  for (std::size_t n = 1; n < specimens.size(); ++n) {
    const Curve& more = specimens[n].curve;
    all.x.insert(all.x.end(), more.x.begin(), more.x.end());
    all.y.insert(all.y.end(), more.y.begin(), more.y.end());
    all.line.insert(all.line.end(), more.line.begin(), more.line.end());
    for (const auto& [to, from] : {std::pair{&all.x_written.number, &more.x_written.number},
                                   {&all.y_written.number, &more.y_written.number}})
      to->insert(to->end(), from->begin(), from->end());
  }
  std::vector<std::size_t> order(all.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return all.x[a] < all.x[b]; });
  all.angle.clear();
  return rows_of(all, order);
}

/// Keeps the rows up to the strain at which the shortest curve ends; reports an error and returns
/// false if nothing is left to fit.
bool keep_up_to(Curve& curve, double shortest, Diagnostics& diagnostics) {
  std::vector<std::size_t> common;
  std::size_t strained = 0;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    if (curve.x[i] > shortest) continue;
    common.push_back(i);
    strained += curve.x[i] > 0.0;
  }
  if (strained < 2) {
    diagnostics.error(place_of(curve), "", "",
                      fmt::format("{} row{} up to a strain of {:.3g}, where the shortest of the "
                                  "curves ends: a law of tension needs at least 2",
                                  strained, strained == 1 ? "" : "s", shortest),
                      "check that all curves are of the same test, or identify them one by one");
    return false;
  }
  curve = rows_of(curve, common);
  return true;
}

/// What all specimens are fitted with, and what came of it.
struct TensionSolution {
  TensionLaw law;
  LinearLaw basis;
  LinearFit fit;
  std::vector<double> places; ///< strains of the basis' probes
  double rms = 0.0;
};

double rms_of(const TensionLaw& law, const Curve& curve) {
  std::vector<double> fitted;
  for (const double strain : curve.x)
    fitted.push_back(law.at(strain).value);
  return quality_of(curve.x, curve.y, fitted).rms;
}

TensionSolution line_through(const Curve& curve) {
  TensionSolution s;
  s.basis = line_law();
  s.fit = fit_linear(s.basis.loads(vector_of(curve.x)), vector_of(curve.y));
  s.law.stiffness = s.fit.k[0];
  s.places = {curve.x.back()};
  s.rms = rms_of(s.law, curve);
  return s;
}

std::optional<TensionSolution> table_through(const Curve& curve, Diagnostics& diagnostics) {
  TensionSolution s;
  const std::vector<double> knots = knots_of(curve);
  s.basis = knots_law(knots);
  s.fit = fit_linear(s.basis.loads(vector_of(curve.x)), vector_of(curve.y));
  for (const double knot : knots)
    if (knot >= 0.1 * knots.back()) s.places.push_back(knot);
  const auto law = table_of(curve, knots, {s.fit.k.begin(), s.fit.k.end()}, diagnostics);
  if (!law) return std::nullopt;
  s.law = *law;
  s.rms = rms_of(s.law, curve);
  return s;
}

/// The line, or the table where that does better; nothing after an error.
std::optional<TensionSolution> solve(const Curve& curve, const Corrections& corrections,
                                     Diagnostics& diagnostics) {
  TensionSolution line = line_through(curve);
  if (line.rms <= noisy || is_shifted_line(curve, line.fit.weights, corrections)) return line;
  std::optional<TensionSolution> table = table_through(curve, diagnostics);
  if (!table) return std::nullopt;
  return table->rms < 0.5 * line.rms ? table : std::optional(line);
}

CurveWords words_of(const Strip& strip) {
  CurveWords words;
  words.x_is_length = strip.displacement();
  words.length_unit = strip.displacement() ? "mm" : "";
  words.x_scale = strip.gauge_length;
  words.y_scale = strip.yarns;
  words.length = strip.displacement() ? 0.1 / strip.gauge_length : 1e-3;
  words.can_stretch = false; // a line stays one
  return words;
}

/// Checks one specimen with the kind of law that all have.
std::optional<SpecimenLaw> law_of_specimen(const TensionSpecimen& specimen,
                                           const TensionSolution& all, const Strip& strip,
                                           const FitOptions& options, Diagnostics& diagnostics) {
  const Curve& curve = specimen.curve;
  LoadRows rows = specimen.rows();
  const LinearFit own = fit_linear(all.basis.loads(rows.x), rows.y);
  rows.weights = own.weights;
  CurveWords words = words_of(strip);
  words.zeros_show = words.toe_shows = all.law.linear(); // a table follows a wrong zero too
  if (!check_disturbances(curve, all.basis, rows, options, words, diagnostics)) return std::nullopt;
  SpecimenLaw law{curve.file, {own.k.begin(), own.k.end()}, {}, specimen.corrected, {}};
  law.quality = quality_of(curve.x, curve.y, {own.fitted.begin(), own.fitted.end()});
  if (!check_quality(curve, law.quality, fmt::format("a strain of {:.3g}", law.quality.largest_at),
                     "check the columns, or smooth the curve", diagnostics) ||
      !check_usual(place_of(curve), "stiffness of a yarn", all.law.largest_slope(), usual_stiffness,
                   "N per yarn", options.doubtful, diagnostics))
    return std::nullopt;
  law.sensitive = sensitivities(all.basis, rows, words.length,
                                common_compliance * strip.yarns / strip.gauge_length);
  warn_of_unknowns(curve, all.basis, rows, law.sensitive, options, words, diagnostics);
  return law;
}

void put_rows(const std::vector<TensionSpecimen>& specimens, TensionFit& result) {
  for (std::size_t n = 0; n < specimens.size(); ++n)
    for (std::size_t i = 0; i < specimens[n].curve.size(); ++i) {
      result.strain.push_back(specimens[n].curve.x[i]);
      result.measured.push_back(specimens[n].curve.y[i]);
      result.fitted.push_back(result.law.at(result.strain.back()).value);
      result.specimen.push_back(n);
    }
}

} // namespace

std::optional<TensionFit> identify_tension(const std::vector<Curve>& curves, const Strip& strip,
                                           const FitOptions& options, Diagnostics& diagnostics) {
  check_arguments(strip, options);
  const std::size_t errors = diagnostics.errors.size();
  std::vector<TensionSpecimen> specimens;
  double shortest = options.to;
  for (const Curve& curve : curves) {
    auto specimen = tension_specimen(curve, strip, options, "strain", diagnostics);
    if (!specimen) continue;
    shortest = std::min(shortest, specimen->curve.x.back());
    specimens.push_back(std::move(*specimen));
  }
  if (diagnostics.errors.size() > errors || specimens.empty()) return std::nullopt;
  for (TensionSpecimen& specimen : specimens)
    if (!keep_up_to(specimen.curve, shortest, diagnostics)) return std::nullopt;
  const std::optional<TensionSolution> all =
      solve(pooled(specimens), options.corrections, diagnostics);
  if (!all) return std::nullopt;
  TensionFit result;
  result.law = all->law;
  std::vector<Eigen::VectorXd> own;
  for (const TensionSpecimen& specimen : specimens) {
    auto law = law_of_specimen(specimen, *all, strip, options, diagnostics);
    if (!law) continue;
    own.push_back(vector_of(law->coefficients));
    result.specimens.push_back(std::move(*law));
  }
  if (diagnostics.errors.size() > errors) return std::nullopt;
  put_rows(specimens, result);
  result.quality = quality_of(result.strain, result.measured, result.fitted);
  if (own.size() == 1) {
    const TensionSpecimen& only = specimens.front();
    const LinearFit fit =
        with_found(all->fit, all->basis, only.rows(), options.corrections, only.corrected);
    result.confidence = confidence_of(fit, all->basis.probes, all->places);
  } else {
    result.scatter = scatter_of(own, all->basis.probes, all->places);
    result.confidence = confidence_between(own, all->basis.probes, all->places);
  }
  return result;
}

std::optional<TensionFit> identify_tension(Curve curve, const Strip& strip,
                                           const FitOptions& options, Diagnostics& diagnostics) {
  return identify_tension(std::vector<Curve>{std::move(curve)}, strip, options, diagnostics);
}

} // namespace plyform
