// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/setup/scout.hpp"

#include "base/format.hpp"
#include "core/accuracy/cost_parameters.hpp"
#include "core/mesh/mesh_blank.hpp"
#include "core/mesh/mesh_ply.hpp"
#include "core/model/boundary.hpp"
#include "core/model/mirror.hpp"
#include "core/setup/chord_sizes.hpp"
#include "core/setup/shear_sizes.hpp"
#include "core/setup/size_ahead.hpp"
#include "core/setup/size_grid.hpp"
#include "core/solver/scene.hpp"

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
    if (!hold_by_mesh(data.boundaries) && takes_elements(coarse)) blank = coarse;
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

/// Triangles times steps that the scout may take: a share of what the run will, by the sizes that
/// it has found so far, and what is no long wait in any case.
class Budget {
public:
  Budget(const Case& data, double most) : data_(data), most_(most) {}

  /// Counts the elements that these sizes ask for, at this state of the scout.
  void foresee(const Frame& state, const std::vector<AskedSizes>& sizes) {
    double triangles = 0.0, steps = 0.0;
    for (std::size_t p = 0; p < sizes.size(); ++p) {
      double smallest = largest_of(data_, p);
      for (std::size_t t = 0; t < sizes[p].size(); ++t) {
        const double size = *std::min_element(sizes[p][t].begin(), sizes[p][t].end()),
                     side = square_side(state.plies[p], t);
        triangles += side * side / (size * size);
        smallest = std::min(smallest, size);
      }
      steps = std::max(steps, steps_ahead(data_, data_.plies[p], smallest));
    }
    allowed_ = std::max(allowed_, share * triangles * steps);
  }

  bool spent(double work) const { return work >= std::min(allowed_, most_); }

private:
  static constexpr double share = 0.1; // of the run
  static constexpr double least = 3e7; // six seconds of one core of 2026

  const Case& data_;
  double most_, allowed_ = least;
};

/// The places of the first of a ply's nodes and triangles: of a part whose whole is shown, of its
/// own, which come first.
PlyFrame first_of(const PlyFrame& ply, const BlankMesh& mesh) {
  const auto nodes = static_cast<std::ptrdiff_t>(mesh.x.size()),
             triangles = static_cast<std::ptrdiff_t>(mesh.triangles.size());
  PlyFrame places;
  places.x0.assign(ply.x0.begin(), ply.x0.begin() + nodes);
  places.x.assign(ply.x.begin(), ply.x.begin() + nodes);
  places.triangles.assign(ply.triangles.begin(), ply.triangles.begin() + triangles);
  return places;
}

/// Where the plies and tools of what is modelled are, and no more.
Frame places_of(const Frame& shown, const std::vector<BlankMesh>& meshes) {
  Frame state;
  for (std::size_t p = 0; p < meshes.size(); ++p)
    state.plies.push_back(first_of(shown.plies[p], meshes[p]));
  for (const ToolFrame& tool : shown.tools)
    state.tools.emplace_back().displacement = tool.displacement;
  return state;
}
Frame places_of(const Scene& scene) {
  Frame state;
  for (const PlyBody& ply : scene.plies) {
    PlyFrame& places = state.plies.emplace_back();
    places.x0 = ply.x0;
    places.x = ply.x;
    places.triangles = ply.membrane.triangles;
  }
  for (const ToolState& tool : scene.tools)
    state.tools.emplace_back().displacement = tool.body.displacement;
  return state;
}

/// What one run of the scout has seen.
struct Look {
  RunResult result;
  std::vector<AskedSizes> sizes; ///< that chords ask for
  bool spent = false;            ///< the budget, which ended it as an interrupt does
};

/// number: of the run; before: triangles times steps that runs before it have taken.
Look run_once(int number, const Case& fast, const Case& data, int threads, const ScoutHooks& hooks,
              double before, Budget& budget) {
  Look look;
  look.sizes.resize(fast.plies.size());
  std::vector<BlankMesh> meshes;
  double triangles = 0.0;
  for (const Ply& ply : fast.plies) {
    meshes.push_back(mesh_ply(fast, ply));
    triangles += static_cast<double>(meshes.back().triangles.size());
  }
  if (hooks.begins) hooks.begins(number, size_of_meshes(fast, meshes, threads));
  ChordSizes chords(fast);
  std::atomic<bool> ends{false};
  RunHooks run;
  run.progress = [&](const Progress& p) {
    if (hooks.progress) hooks.progress(p);
    look.spent = budget.spent(before + static_cast<double>(p.step) * triangles);
    ends = look.spent || (hooks.interrupt && *hooks.interrupt);
  };
  run.interrupt = &ends;
  run.watch = hooks.watch;
  const auto look_at = [&](const Frame& state) {
    for (std::size_t p = 0; p < look.sizes.size(); ++p)
      if (look.sizes[p].empty()) {
        look.sizes[p].resize(state.plies[p].triangles.size());
        for (auto& places : look.sizes[p])
          places.fill(largest_of(data, p));
      }
    chords.lower(state, look.sizes);
    budget.foresee(state, look.sizes);
  };
  run.frame = [&](const Frame& shown) { look_at(places_of(shown, meshes)); };
  run.glance = [&](const Scene& scene) { look_at(places_of(scene)); };
  look.result = run_case(fast, threads, run, meshes);
  look.spent = look.spent && look.result.summary.status == "interrupted";
  return look;
}

void add_cost(const Look& look, Scouted& scouted) {
  scouted.seconds += look.result.summary.wall_time_s;
  for (const AskedSizes& sizes : look.sizes) // of each triangle
    scouted.work +=
        static_cast<double>(sizes.size()) * static_cast<double>(look.result.summary.steps);
}

/// Gives the images of a part, which is shown as a whole, the sizes of its own triangles.
void repeat_at_images(const Case& data, std::vector<AskedSizes>& sizes) {
  const std::size_t parts = parts_of(data);
  for (AskedSizes& of : sizes) {
    const std::size_t own = of.size();
    for (std::size_t t = own; t < parts * own; ++t)
      of.push_back(of[t - own]);
  }
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

/// What the budget has left unseen.
std::string ended_early(const Look& look, const Case& fast, int runs, double work) {
  std::string text = fmt::format(
      "the run with coarse elements that looks where small ones are needed was ended at its "
      "budget, after {:.2g} million element-steps, ",
      1e-6 * work);
  if (runs > 1)
    return text + fmt::format("in its run {}: the mesh is that of the run before, whose elements "
                              "were too coarse to say everywhere where small ones are needed",
                              runs);
  return text + fmt::format("at {:.0f} % of the time: the mesh is fine for what it had seen until "
                            "then; elements that are too large for what comes later are told of "
                            "when the run ends",
                            100.0 * look.result.last.time / fast.solver.duration);
}

} // namespace

Scouted scout(const Case& data, double shear_error, int threads, const ScoutHooks& hooks) {
  const Case fast = scout_case(data);
  Budget budget(data, hooks.most_work);
  Scouted scouted;
  for (int runs = 1; runs <= most_runs; ++runs) {
    Look look = run_once(runs, runs == 1 ? fast : finer(fast, scouted.sizes), data, threads, hooks,
                         scouted.work, budget);
    add_cost(look, scouted);
    if (look.spent) scouted.ended = ended_early(look, fast, runs, scouted.work);
    if (look.spent && runs > 1) break; // what the run before has seen of all of it
    if (!look.spent && !ended(look.result.summary.status)) {
      scouted.fault = look.result.summary.message;
      break;
    }
    const double coarse = coarseness(look);
    repeat_at_images(fast, look.sizes);
    lower_to_shear(look.result.last, shear_error, finest_for_shear, look.sizes);
    scouted.sizes.clear();
    for (std::size_t p = 0; p < look.sizes.size(); ++p)
      scouted.sizes.push_back(size_grid(look.result.last.plies[p], data.plies[p], look.sizes[p],
                                        largest_of(data, p), runs == 1 ? held_first : held_later));
    if (look.spent || coarse <= coarse_enough) break;
  }
  return scouted;
}

} // namespace plyform
