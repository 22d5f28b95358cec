// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/setup/friction_ahead.hpp"

#include "base/format.hpp"
#include "core/model/motion.hpp"
#include "core/model/reachable_temperature.hpp"

#include <algorithm>

namespace plyform {
namespace {

/// mm/s in the process, of what is driven; 0 if nothing is.
double fastest(const Case& data) {
  return peak_speed_ratio * longest_strokes(data).at_full_speed / data.process_stroke_time();
}

/// N/mm^2, largest and smallest that the loads of a case press with; nothing: forces of tools
/// press, whose pressures are not known before.
std::optional<std::pair<double, double>> pressures(const Case& data) {
  double least = 1e300, most = 0.0;
  for (const PressureLoad& load : data.loads) {
    least = std::min(least, load.pressure);
    most = std::max(most, load.pressure);
  }
  return most > 0.0 ? std::optional(std::pair(least, most)) : std::nullopt;
}

/// Least and most of f(T) at the ends of what films of a law may come to.
struct Factors {
  double least = 1.0, most = 1.0;
};
Factors factors(const Case& data, int law) {
  const FrictionLawSpec& s = data.friction_laws[static_cast<std::size_t>(law)]->spec();
  if (!s.flow.factor) return {};
  Factors all{1e300, 0.0};
  for (const auto& pair : pairs_of_law(data, law))
    if (const auto film = film_temperatures(data, pair))
      for (const double celsius : {film->least, film->most})
        all.least = std::min(all.least, s.flow_at(celsius)),
        all.most = std::max(all.most, s.flow_at(celsius));
  return all;
}

void describe_hersey(const Case& data, const FrictionLawSpec& s, double speed, const Factors& by,
                     std::vector<std::string>& lines) {
  if (s.curve.empty()) return;
  const double drag = s.viscosity_at(s.film > 0.0 ? speed / s.film : 0.0) * speed;
  const double first = s.curve.front().at, last = s.curve.back().at;
  lines.push_back(fmt::format(
      "    curve of Hersey numbers from {:.3g} to {:.3g} mm: at {:.3g} mm/s of {:.3g} to {:.3g} "
      "N/mm2; where less presses it goes on as {}",
      first, last, speed, by.most * drag / last, by.least * drag / first,
      s.film_beyond ? "a film" : "Coulomb's law"));
  const auto known = pressures(data);
  if (!known) return;
  const double most = by.most * drag / known->first, pressed = by.most * drag / known->second;
  if (most > last)
    lines.push_back(
        fmt::format("    warning: the run reaches Hersey numbers of {:.3g} mm, at {:.3g} "
                    "mm/s and {:.3g} N/mm2, and the curve ends at {:.3g}; give it "
                    "points up to there",
                    most, speed, known->first, last));
  else if (pressed < first)
    lines.push_back(
        fmt::format("    warning: the run stays below Hersey numbers of {:.3g} mm where "
                    "{:.3g} N/mm2 press, and the curve begins at {:.3g}; give it points "
                    "down to there",
                    pressed, known->second, first));
}

void describe_rates(const FrictionLawSpec& s, double speed, std::vector<std::string>& lines) {
  if (s.viscosity_curve.empty()) return;
  const double rate = speed / s.film, last = s.viscosity_curve.back().at;
  if (rate > last)
    lines.push_back(
        fmt::format("    warning: rates in the film reach {:.3g} 1/s, at {:.3g} mm/s over "
                    "{:.3g} mm, and viscosity_curve ends at {:.3g}; give it points up "
                    "to there",
                    rate, speed, s.film, last));
}

} // namespace

std::vector<std::string> friction_ahead(const Case& data) {
  std::vector<std::string> lines;
  const double speed = fastest(data);
  for (std::size_t i = 0; i < data.friction_laws.size(); ++i) {
    const FrictionLawSpec& s = data.friction_laws[i]->spec();
    const std::vector<int>& named = data.friction.law;
    if (!s.has_rates() || std::find(named.begin(), named.end(), static_cast<int>(i)) == named.end())
      continue;
    if (!(speed > 0.0)) {
      lines.push_back(fmt::format("friction {}: nothing is driven, so that slip speeds are not "
                                  "known before the run",
                                  s.name));
      continue;
    }
    lines.push_back(
        fmt::format("friction {}: slip of {:.3g} mm/s at most in the process", s.name, speed));
    const Factors by = factors(data, static_cast<int>(i));
    if (s.flow.factor)
      lines.push_back(
          fmt::format("    viscosity at the temperatures of its films: {:.3g} to {:.3g} "
                      "times that at the reference",
                      by.least, by.most));
    describe_hersey(data, s, speed, by, lines);
    describe_rates(s, speed, lines);
  }
  return lines;
}

} // namespace plyform
