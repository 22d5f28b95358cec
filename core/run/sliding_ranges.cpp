// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/run/sliding_ranges.hpp"

#include "base/format.hpp"

#include <algorithm>

namespace plyform {
namespace {

void add_range(const std::vector<CurvePoint>& curve, const RangeSeen& seen,
               std::optional<CurveRange>& range) {
  if (!(seen.work > 0.0)) return;
  if (!range) range = CurveRange{seen.least, seen.most};
  range->least = std::min(range->least, seen.least);
  range->most = std::max(range->most, seen.most);
  range->below_share += seen.below, range->above_share += seen.above;
  if (!curve.empty()) range->first = curve.front().at, range->last = curve.back().at;
}

/// Ends of f(T) as of a curve.
std::vector<CurvePoint> ends_of(const FilmFlow& flow) {
  return flow.factor ? std::vector<CurvePoint>{{flow.least, 0.0}, {flow.most, 0.0}}
                     : std::vector<CurvePoint>{};
}

void doubt_range(const PairReport& pair, const std::optional<CurveRange>& range,
                 const std::string& what, const std::string& unit, const std::string& key,
                 std::vector<std::string>& found) {
  if (!range || range->below_share + range->above_share <= doubtful_sliding_share) return;
  found.push_back(fmt::format(
      "do not trust friction of {} with {}: {:.0f} % of the work of sliding was done outside "
      "friction.{}.{}, at {} from {:.3g} to {:.3g} {} where it has {:.3g} to {:.3g}; measure "
      "friction there, or give it that range",
      pair.a, pair.b, 100.0 * (range->below_share + range->above_share), pair.friction_law, key,
      what, range->least, range->most, unit, range->first, range->last));
}

} // namespace

void add_ranges(const FrictionLaw& law, const SlidingSeen& seen, PairReport& pair) {
  add_range(law.spec().curve, seen.hersey, pair.hersey);
  add_range(law.spec().viscosity_curve, seen.rate, pair.film_rate);
  add_range(ends_of(law.spec().flow), seen.temperature, pair.film_temperature);
  pair.unsteady_share += seen.unsteady;
}

void end_ranges(PairReport& pair) {
  for (std::optional<CurveRange>* range : {&pair.hersey, &pair.film_rate, &pair.film_temperature})
    if (*range && pair.friction_mJ > 0.0)
      (*range)->below_share /= pair.friction_mJ, (*range)->above_share /= pair.friction_mJ;
  if (pair.friction_mJ > 0.0) pair.unsteady_share /= pair.friction_mJ;
}

std::vector<std::string> doubts_of_sliding(const std::vector<PairReport>& pairs) {
  std::vector<std::string> found;
  for (const PairReport& pair : pairs) {
    doubt_range(pair, pair.hersey, "Hersey numbers", "mm", "curve", found);
    doubt_range(pair, pair.film_rate, "rates", "1/s", "viscosity_curve", found);
    doubt_range(pair, pair.film_temperature, "temperatures", "degC", "temperature", found);
    if (pair.unsteady_share > doubtful_sliding_share)
      found.push_back(fmt::format(
          "do not trust friction of {} with {}: {:.0f} % of the work of sliding was done where "
          "friction falls with the speed (friction.{}) and the speed did not stay: what is elastic "
          "sticks and jumps there, or speeds change within a two-hundredth of the run; stiffer "
          "grips or plies, another speed, or a longer solver.duration",
          pair.a, pair.b, 100.0 * pair.unsteady_share, pair.friction_law));
  }
  return found;
}

} // namespace plyform
