// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/results/history.hpp"

#include "core/results/bridging.hpp"
#include "core/results/broken_stitches.hpp"
#include "core/results/draw_in.hpp"
#include "core/results/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace plyform {

namespace {

/// The energies of a state: those of stitches, compaction and rates where a fabric has them, and
/// of films where there are any.
template <class Visit>
void each_energy(const Frame& frame, Visit&& visit) {
  const bool stitched = std::any_of(frame.plies.begin(), frame.plies.end(),
                                    [](const PlyFrame& one) { return !one.stitches.empty(); });
  const bool gives_way = std::any_of(frame.plies.begin(), frame.plies.end(),
                                     [](const auto& one) { return !one.fibre_volume.empty(); });
  const bool rated = std::any_of(frame.plies.begin(), frame.plies.end(),
                                 [](const PlyFrame& one) { return !one.shear_rate.empty(); });
  for (const EnergyTerm& term : energy_terms) {
    const bool of_stitches =
        term.value == &Energies::stitch || term.value == &Energies::stitch_breaking;
    if (of_stitches && !stitched) continue;
    if (term.value == &Energies::compaction && !gives_way) continue;
    if (term.value == &Energies::viscous && !rated) continue;
    if (term.value == &Energies::film && !frame.films) continue;
    visit(StateNumber{{std::string(term.name) + "_mJ", term.name, term.label, "mJ", 2, 1e-6},
                      Location::run,
                      "",
                      true},
          frame.energy.*term.value);
  }
}

/// Calls visit(StateNumber, value) for each number of a state, in the order of files. NaN where it
/// is not known. A new number needs an entry here.
template <class Visit>
void each_number(const Frame& frame, Visit&& visit) {
  visit(StateNumber{{"time_s", "time", "time", "s", 4, 1e-9}}, frame.time);
  visit(StateNumber{{"stroke_mm", "stroke", "stroke", "mm", 2, 1e-4}}, frame.stroke_mm);
  const Description force{"force_N", "force", "force", "N", 1, 1e-4},
      raw{"force_raw_N", "force-raw", "force of the last step", "N", 1, 1e-4},
      moved{"displacement_mm", "displacement", "displacement", "mm", 2, 1e-4};
  for (const ToolFrame& one : frame.tools) {
    visit(StateNumber{force, Location::tool, one.name}, one.force_N);
    visit(StateNumber{raw, Location::tool, one.name}, one.force_raw_N);
    visit(StateNumber{moved, Location::tool, one.name}, one.stroke_mm);
  }
  for (const BoundaryFrame& one : frame.boundaries) {
    visit(StateNumber{force, Location::boundary, one.name}, one.force_N);
    visit(StateNumber{moved, Location::boundary, one.name}, one.stroke_mm);
  }
  for (const PlyFrame& one : frame.plies) // which drive a case without a stroke
    if (!std::isnan(one.load_pressure))
      visit(StateNumber{{"load_pressure_N_mm2", "load-pressure", "pressure of loads on plies",
                         "N/mm²", 4, 1e-6, Scale::both_ways, "from below less from above"},
                        Location::ply,
                        one.name},
            one.load_pressure);
  each_energy(frame, visit);
  visit(
      StateNumber{{"balance_error", "balance-error", "error of the energy balance", "1", 3, 1e-9}},
      frame.energy.balance_error());
  for (const PlyFrame& one : frame.plies) {
    const auto of_ply = [&](Description number, double value) {
      visit(StateNumber{std::move(number), Location::ply, one.name, false, false}, value);
    };
    of_ply({"largest_shear_deg", "largest-shear", "largest shear angle", "deg", 2, 0.005},
           largest_magnitude(one.shear_deg));
    of_ply({"rms_shear_deg", "rms-shear", "shear angle, rms over the area", "deg", 2, 0.005},
           root_mean_square(one.shear_deg, areas_before(one)));
    of_ply({"draw_in_mm", "draw-in", "draw-in, mean of eight walks", "mm", 2, 1e-3},
           draw_in(one).mean());
    if (!one.wrinkle_height.empty())
      of_ply({"largest_wrinkle_mm", "largest-wrinkle", "highest wrinkle", "mm", 2, 1e-3},
             largest(one.wrinkle_height));
    if (!one.bridging_height.empty()) {
      const Bridging bridging = bridging_of(one);
      of_ply({"largest_bridging_mm", "largest-bridging", "largest bridging height", "mm", 2, 1e-3},
             bridging.height);
      of_ply({"bridging_area_mm2", "bridging-area", "bridging area", "mm²", 0, 0.1}, bridging.area);
    }
    if (!one.temperature.empty())
      of_ply({"mean_temperature_C", "mean-temperature", "mean temperature", "°C", 1, 1e-6,
              Scale::whole},
             mean_of_nodes(one, one.temperature));
    if (!one.stitches.empty())
      of_ply({"broken_stitch_share", "broken-stitches", "share of stitches broken", "1", 3, 1e-6,
              Scale::from_zero, "of the length of those that are broken most"},
             broken_share(one));
  }
}

} // namespace

void append_state(std::vector<Series>& history, const Frame& frame) {
  const bool first = history.empty();
  std::size_t i = 0;
  each_number(frame, [&](StateNumber number, double value) {
    if (first) history.push_back({std::move(number), {}});
    if (i < history.size()) history[i].values.push_back(value);
    ++i;
  });
  if (i != history.size()) throw std::logic_error("a state has other numbers than the first");
}

} // namespace plyform
