// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/verification/verify.hpp"

#include "base/format.hpp"
#include "core/accuracy/error_model.hpp"
#include "core/results/field_difference.hpp"
#include "core/solver/scene.hpp"
#include "core/verification/bands.hpp"
#include "core/verification/no_band.hpp"
#include "core/verification/siblings.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace plyform {
namespace {

// Of the run's, all siblings together; measured, each unit takes 1.2 times the time, as small
// meshes and short runs have more to prepare.
constexpr double most_work = 1.25;

std::vector<Motion> motions_of(const Case& data) {
  std::vector<Motion> motions;
  for (const Tool& tool : data.tools)
    motions.push_back(tool.motion);
  return motions;
}

RunEnd end_of(const Case& data, const RunResult& run) {
  return {run.last,
          run.summary.plies,
          force_jitter(data, run.last),
          forces_by_balance(data, run.last),
          run.summary.flies,
          run.summary.known_forces,
          figures_without_band(data, run.last),
          motions_of(data)};
}

/// Work of a run: triangles times steps.
double work_of(const RunResult& run, long first_step) {
  double triangles = 0.0;
  for (const PlyFrame& ply : run.last.plies)
    triangles += static_cast<double>(ply.triangles.size());
  return triangles * static_cast<double>(run.summary.steps - first_step);
}

struct SiblingRun {
  RunResult result;
  Trace trace;
  long first_step = 0;
};

/// Where each sibling begins in the work of all, from 0 to 1, and the end. Steps are in proportion
/// to the size of elements and to the root of the softening.
std::vector<double> begins_of(const std::vector<Sibling>& runs) {
  std::vector<double> begins{0.0};
  for (const Sibling& sibling : runs) {
    double triangles = 0.0;
    for (const BlankMesh& mesh : sibling.meshes)
      triangles += static_cast<double>(mesh.triangles.size());
    const SolverOptions& solver = sibling.data.solver;
    begins.push_back(begins.back() + std::max(triangles, 1.0) * std::sqrt(triangles) *
                                         solver.duration * (1.0 - sibling.from) /
                                         std::sqrt(solver.fibre_softening));
  }
  const double all = std::max(begins.back(), 1e-300);
  for (double& begin : begins)
    begin /= all;
  return begins;
}

SiblingRun run_sibling(const Sibling& sibling, const RunResult& run, const Trace& trace,
                       int threads, const VerifyHooks& hooks, double begin, double end) {
  SiblingRun done;
  RunHooks run_hooks;
  if (hooks.progress)
    run_hooks.progress = [&](const Progress& p) {
      const double own = std::max(p.fraction - sibling.from, 0.0) / (1.0 - sibling.from);
      hooks.progress(p, begin + (end - begin) * own);
    };
  run_hooks.interrupt = hooks.interrupt;
  if (sibling.cause != Cause::mesh && sibling.cause != Cause::softening)
    watch(run_hooks, done.trace, false);
  Scene scene = make_scene(sibling.data, sibling.meshes, threads);
  move_first_tool(sibling.data, sibling.move, scene);
  Resume resume;
  if (sibling.from > 0.0) {
    const Moment& start = *moment_at(trace, sibling.from);
    resume = {start.state, run.last};
    resume.last.step = start.step; // its own states follow
    done.first_step = start.step;
    run_hooks.resume = &resume;
  }
  done.result = run_scene(scene, threads, run_hooks);
  return done;
}

/// Siblings that have run, by their cause.
struct Done {
  std::map<Cause, SiblingRun> runs;
  double seconds = 0.0, work = 0.0; ///< work over that of the run

  bool has_chance() const {
    return runs.contains(Cause::chance) || runs.contains(Cause::late_chance);
  }
};

/// Whether a late twin has a state to begin with, and time left.
bool may_run(const Sibling& sibling, const Trace& trace, const Done& done) {
  if (sibling.from == 0.0) return true;
  const Moment* start = moment_at(trace, sibling.from);
  if (!start || start->state.empty()) return false;
  constexpr double late_steps = 1.15; // contacts make them shorter at the end
  return done.work + late_steps * (1.0 - sibling.from) <= most_work ||
         (sibling.cause == Cause::later_chance && !done.has_chance());
}

/// Where the two twins that end furthest apart part.
std::vector<Parting> partings(const RunResult& run, const Trace& trace, const Done& done) {
  double furthest = 0.0;
  std::optional<Parting> found;
  for (const auto& [cause, twin] : done.runs) {
    const bool late = cause == Cause::late_chance || cause == Cause::later_chance;
    if (!late && cause != Cause::chance) continue;
    const auto fast = done.runs.find(Cause::inertia);
    if (!late && fast == done.runs.end()) continue;
    const Frame& other = late ? run.last : fast->second.result.last;
    const double apart = shear_error(twin.result.last, other).rms;
    if (!(apart > furthest)) continue;
    furthest = apart;
    found = parting_of(late ? trace : fast->second.trace, other, twin.trace, twin.result.last);
  }
  return found ? std::vector{*found} : std::vector<Parting>{};
}

/// Whether chance is more than all that is measured else.
bool chance_decides(const VerifiedFigure& f) {
  if (!f.band || !f.chance) return false;
  return safety_of_chance * *f.chance >
         safety * std::hypot(*f.mesh, std::hypot(*f.inertia, *f.softening));
}

void tell_replaced_parts(const std::map<Cause, RunEnd>& ends, const PredictedError& predicted,
                         Verification& result) {
  if (!ends.contains(Cause::mesh) && predicted.mesh > 0.0)
    result.left_out.emplace_back("in the band of shear the predicted error of the mesh stands in; "
                                 "other figures have no band");
}

} // namespace

std::optional<Verification> verify(const Case& data, const RunResult& run, const Trace& trace,
                                   int threads, const VerifyHooks& hooks,
                                   const std::vector<BlankMesh>& meshes) {
  const Siblings made = siblings_of(data, meshes);
  Verification result;
  result.left_out = made.left_out;
  const std::vector<double> begins = begins_of(made.runs);
  Done done;
  const double own_work = std::max(work_of(run, 0), 1.0);
  Ends ends;
  for (std::size_t i = 0; i < made.runs.size(); ++i) {
    const Sibling& sibling = made.runs[i];
    if (!may_run(sibling, trace, done)) continue;
    if (hooks.begins) hooks.begins(sibling.name, i + 1, made.runs.size());
    SiblingRun end = run_sibling(sibling, run, trace, threads, hooks, begins[i], begins[i + 1]);
    if (hooks.interrupt && hooks.interrupt->load()) return std::nullopt;
    done.seconds += end.result.summary.wall_time_s;
    done.work += work_of(end.result, end.first_step) / own_work;
    if (!ended(end.result.summary.status)) {
      result.left_out.push_back(fmt::format("the sibling with a {} did not go to its end: {}",
                                            sibling.name, end.result.summary.message));
      continue;
    }
    ends[sibling.cause] = end_of(sibling.data, end.result);
    done.runs[sibling.cause] = std::move(end);
  }
  if (!done.has_chance() && !done.runs.contains(Cause::later_chance))
    result.left_out.emplace_back(
        "chance has no twin: none went to its end, or the run went on from a "
        "checkpoint beyond where they begin");
  result.cost = done.seconds / std::max(run.summary.wall_time_s, 1e-9);
  result.work = done.work;
  const RunEnd own = end_of(data, run);
  PredictedError predicted = predicted_error(data);
  if (own.flies) predicted = {}; // outside the premise of the rule
  tell_replaced_parts(ends, predicted, result);
  result.figures = verified_figures(own, ends, made, predicted);
  result.shear = verified_shear(own, ends, made, predicted);
  if (chance_decides(result.shear) ||
      std::any_of(result.figures.begin(), result.figures.end(), chance_decides))
    result.partings = partings(run, trace, done);
  return result;
}

} // namespace plyform
