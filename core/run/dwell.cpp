// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/run/dwell.hpp"

#include "core/solver/step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plyform {
namespace {

constexpr double window_share = 0.05; // of the duration
constexpr double steady = 0.01;       // of the largest force
constexpr double at_rest = 0.01;      // kinetic energy over that of deformation

double force_of(const ToolState& tool) {
  return tool.filter.value().dot(tool.body.direction);
}

void begin_window(Dwell& dwell, const Scene& s) {
  dwell.low.assign(s.tools.size(), std::numeric_limits<double>::max());
  dwell.high.assign(s.tools.size(), std::numeric_limits<double>::lowest());
  dwell.window_end = s.time + window_share * s.data.solver.duration;
}

/// floor: N, forces that are rounding errors.
bool is_steady(const Dwell& dwell, double floor) {
  double largest = 0.0, varies = 0.0;
  for (std::size_t t = 0; t < dwell.low.size(); ++t) {
    largest = std::max({largest, std::abs(dwell.low[t]), std::abs(dwell.high[t])});
    varies = std::max(varies, dwell.high[t] - dwell.low[t]);
  }
  return varies <= std::max(steady * largest, floor);
}

bool is_at_rest(const Energies& e) {
  return e.kinetic <= std::max(at_rest * (e.fibre + e.shear + e.stitch + e.bending), e.floor);
}

} // namespace

bool dwell_ends(Dwell& dwell, const Scene& s, ThreadPool& pool) {
  const SolverOptions& solver = s.data.solver;
  if (s.time < solver.duration) return false;
  if (solver.dwell == 0.0) return true;
  if (dwell.window_end == 0.0) begin_window(dwell, s); // low and high are empty without tools
  for (std::size_t t = 0; t < s.tools.size(); ++t) {
    const double force = force_of(s.tools[t]);
    dwell.low[t] = std::min(dwell.low[t], force);
    dwell.high[t] = std::max(dwell.high[t], force);
  }
  if (s.time < dwell.window_end) return false;
  dwell.settled =
      is_steady(dwell, s.energy_floor / s.element_size) && is_at_rest(current_energies(s, pool));
  begin_window(dwell, s);
  return dwell.settled || s.time >= (1.0 + solver.dwell) * solver.duration;
}

} // namespace plyform
