// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/setup/scout.hpp"

#include "core/accuracy/error_model.hpp"
#include "core/mesh/mesh_blank.hpp"
#include "core/setup/chord_sizes.hpp"
#include "core/setup/shear_sizes.hpp"
#include "core/setup/size_grid.hpp"

#include <algorithm>
#include <numbers>

namespace plyform {
namespace {

// States that are looked at: cloth moves on by less than an element from one to the next.
constexpr int looks = 40;
// No element gets below this share of the scout's for the sake of shear: what is steeper is a kink,
// which no mesh resolves.
constexpr double finest_for_shear = 0.35;

// Elements of the scout over the largest of the run: fewer take more steps, as they cut deep.
constexpr double scout_coarsening = 1.4;

double largest_of(const Case& data, std::size_t ply) {
  return data.blanks[at(data.plies[ply].blank)].element_size;
}

} // namespace

Case scout_case(const Case& data) {
  Case fast = data;
  for (BlankSpec& blank : fast.blanks) {
    blank.zones.clear(), blank.sizes.reset();
    BlankSpec coarse = blank;
    scale_elements(coarse, scout_coarsening);
    if (data.boundaries.empty() && takes_elements(coarse)) blank = coarse;
  }
  fast.accuracy = {preset_error("draft") * std::numbers::pi / 180.0, false};
  pick_cost_parameters(fast, {.element_size = true});
  fast.solver.duration = std::min(fast.solver.duration, data.solver.duration);
  fast.solver.dwell = 0.0;
  fast.solver.max_balance_error = SolverOptions{}.max_balance_error; // the run's is for the run
  fast.solver.outputs = looks;
  return fast;
}

Scouted scout(const Case& data, double shear_error, int threads, const ScoutHooks& hooks) {
  if (hooks.begins) hooks.begins();
  const Case fast = scout_case(data);
  std::vector<AskedSizes> sizes(fast.plies.size());
  RunHooks run;
  run.progress = hooks.progress;
  run.interrupt = hooks.interrupt;
  run.frame = [&](const Frame& state) {
    for (std::size_t p = 0; p < sizes.size(); ++p)
      if (sizes[p].empty()) {
        sizes[p].resize(state.plies[p].triangles.size());
        for (auto& places : sizes[p])
          places.fill(largest_of(data, p));
      }
    lower_to_chords(fast, state, {}, sizes);
  };
  const RunResult result = run_case(fast, threads, run);
  Scouted scouted;
  scouted.seconds = result.summary.wall_time_s;
  for (const PlyFrame& ply : result.last.plies)
    scouted.work +=
        static_cast<double>(ply.triangles.size()) * static_cast<double>(result.summary.steps);
  if (result.summary.status != "done" && result.summary.status != "doubtful") {
    scouted.fault = result.summary.message;
    return scouted;
  }
  lower_to_shear(result.last, shear_error, finest_for_shear, sizes);
  for (std::size_t p = 0; p < sizes.size(); ++p)
    scouted.sizes.push_back(
        size_grid(result.last.plies[p], data.plies[p], sizes[p], largest_of(data, p)));
  return scouted;
}

} // namespace plyform
