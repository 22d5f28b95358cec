// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/setup/scout.hpp"

#include "core/accuracy/cost_parameters.hpp"
#include "core/mesh/mesh_blank.hpp"
#include "core/mesh/mesh_ply.hpp"
#include "core/setup/chord_sizes.hpp"
#include "core/setup/shear_sizes.hpp"
#include "core/setup/size_grid.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

// States that are looked at: cloth moves on by less than an element from one to the next.
constexpr int looks = 40;
// No element gets below this share of the scout's for the sake of shear: what is steeper is a kink,
// which no mesh resolves.
constexpr double finest_for_shear = 0.35;

// Elements of the scout over the largest of the run: fewer take more steps, as they cut deep.
constexpr double scout_coarsening = 1.4;
// Elements so many times as large as what is wanted there do not say where it is wanted: up to 5.4
// they did (cases/square_box), 6.5 led to cuts of 0.9 mm of 0.6 mm (cases/pocket, squares of 10
// mm).
constexpr double coarse_enough = 6.0;
// Elements of the next run of the scout over those that are wanted, and runs at most.
constexpr double next_coarsening = 2.0;
constexpr int most_runs = 4;
// How far a size holds (core/setup/size_grid.hpp): later runs have small elements where it matters,
// but chords over fillets, and so too little draw-in, as the first.
constexpr double held_first = 0.3, held_later = 0.6;

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
  fast.accuracy = {preset_error("draft") * degree, false};
  pick_cost_parameters(fast, {.element_size = true});
  fast.solver.duration = std::min(fast.solver.duration, data.solver.duration);
  fast.solver.dwell = 0.0;
  fast.solver.max_balance_error = SolverOptions{}.max_balance_error; // the run's is for the run
  fast.solver.outputs = looks;
  return fast;
}

namespace {

/// What one run of the scout has seen.
struct Look {
  RunResult result;
  std::vector<AskedSizes> sizes; ///< that chords ask for
  bool gave_up = false;          ///< at the most work
};

/// most_work: triangles times steps after which it is ended as by an interrupt.
Look run_once(const Case& fast, const Case& data, int threads, const ScoutHooks& hooks,
              double most_work) {
  Look look;
  look.sizes.resize(fast.plies.size());
  std::vector<BlankMesh> meshes;
  double triangles = 0.0;
  for (const Ply& ply : fast.plies) {
    meshes.push_back(mesh_ply(fast, ply));
    triangles += static_cast<double>(meshes.back().triangles.size());
  }
  std::atomic<bool> ends{false};
  RunHooks run;
  run.progress = [&](const Progress& p) {
    if (hooks.progress) hooks.progress(p);
    look.gave_up = static_cast<double>(p.step) * triangles >= most_work;
    ends = look.gave_up || (hooks.interrupt && *hooks.interrupt);
  };
  run.interrupt = std::isfinite(most_work) ? &ends : hooks.interrupt;
  run.watch = hooks.watch;
  run.frame = [&](const Frame& state) {
    for (std::size_t p = 0; p < look.sizes.size(); ++p)
      if (look.sizes[p].empty()) {
        look.sizes[p].resize(state.plies[p].triangles.size());
        for (auto& places : look.sizes[p])
          places.fill(largest_of(data, p));
      }
    lower_to_chords(fast, state, {}, look.sizes);
  };
  look.result = run_case(fast, threads, run, meshes);
  return look;
}

void add_cost(const RunResult& result, Scouted& scouted) {
  scouted.seconds += result.summary.wall_time_s;
  for (const PlyFrame& ply : result.last.plies)
    scouted.work +=
        static_cast<double>(ply.triangles.size()) * static_cast<double>(result.summary.steps);
}

/// The largest ratio of an element of the scout to what is wanted in it.
double coarseness(const Look& look) {
  double most = 1.0;
  for (std::size_t p = 0; p < look.sizes.size(); ++p)
    for (std::size_t t = 0; t < look.sizes[p].size(); ++t) {
      const auto& places = look.sizes[p][t];
      most = std::max(most, square_side(look.result.last.plies[p], t) /
                                *std::min_element(places.begin(), places.end()));
    }
  return most;
}

/// The scout's case with elements next_coarsening times as large as wanted, none larger than
/// before.
Case finer(const Case& fast, const std::vector<SizeGrid>& wanted) {
  Case next = fast;
  for (std::size_t p = 0; p < wanted.size(); ++p) {
    SizeGrid grid = wanted[p];
    for (double& size : grid.size)
      size = std::min(next_coarsening * size, largest_of(fast, p));
    set_sizes(next, p, std::move(grid));
  }
  return next;
}

} // namespace

Scouted scout(const Case& data, double shear_error, int threads, const ScoutHooks& hooks) {
  const Case fast = scout_case(data);
  Scouted scouted;
  for (int runs = 1; runs <= most_runs; ++runs) {
    if (hooks.begins) hooks.begins(runs);
    Look look = run_once(runs == 1 ? fast : finer(fast, scouted.sizes), data, threads, hooks,
                         hooks.most_work - scouted.work);
    add_cost(look.result, scouted);
    scouted.gave_up = look.gave_up;
    if (look.gave_up) return scouted;
    if (look.result.summary.status != "done" && look.result.summary.status != "doubtful") {
      scouted.fault = look.result.summary.message;
      return scouted;
    }
    const double coarse = coarseness(look);
    lower_to_shear(look.result.last, shear_error, finest_for_shear, look.sizes);
    scouted.sizes.clear();
    for (std::size_t p = 0; p < look.sizes.size(); ++p)
      scouted.sizes.push_back(size_grid(look.result.last.plies[p], data.plies[p], look.sizes[p],
                                        largest_of(data, p), runs == 1 ? held_first : held_later));
    if (coarse <= coarse_enough) break;
  }
  return scouted;
}

} // namespace plyform
