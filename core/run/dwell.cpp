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
constexpr double looks = 10.0;        // in a window
constexpr double same_work = 1e-3;    // of the largest

double force_of(const ToolState& tool) {
  return tool.filter.value().dot(tool.body.direction);
}

void begin_window(Dwell& dwell, const Scene& s) {
  dwell.low.assign(s.tools.size(), std::numeric_limits<double>::max());
  dwell.high.assign(s.tools.size(), std::numeric_limits<double>::lowest());
  dwell.window_end = s.time + window_share * s.data.solver.duration;
  dwell.next_look = s.time;
  dwell.low_work = std::numeric_limits<double>::max();
  dwell.high_work = std::numeric_limits<double>::lowest();
  dwell.moving = false;
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
  return e.kinetic <= std::max(at_rest * e.deformation(), e.floor);
}

/// Now and then, where pressures act: whether plies rest, and what is done on them.
void look(Dwell& dwell, const Scene& s, ThreadPool& pool) {
  if (s.data.loads.empty() || s.time < dwell.next_look) return;
  dwell.next_look = s.time + window_share / looks * s.data.solver.duration;
  const Energies e = current_energies(s, pool);
  dwell.moving = dwell.moving || !is_at_rest(e);
  dwell.low_work = std::min(dwell.low_work, e.external);
  dwell.high_work = std::max(dwell.high_work, e.external);
}

bool swings(const Dwell& dwell, const Scene& s) {
  if (s.data.loads.empty()) return false;
  const double most = std::max(std::abs(dwell.low_work), std::abs(dwell.high_work));
  return dwell.moving ||
         dwell.high_work - dwell.low_work > std::max(same_work * most, s.energy_floor);
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
  look(dwell, s, pool);
  if (s.time < dwell.window_end) return false;
  dwell.settled = is_steady(dwell, s.energy_floor / s.element_size) && !swings(dwell, s) &&
                  is_at_rest(current_energies(s, pool));
  begin_window(dwell, s);
  // what relaxes is never settled for good: it is held as long as the case says
  const bool rated = std::any_of(s.plies.begin(), s.plies.end(), [](const PlyBody& ply) {
    return ply.viscous || ply.viscous_bending;
  });
  return (dwell.settled && !rated) || s.time >= (1.0 + solver.dwell) * solver.duration;
}

} // namespace plyform
