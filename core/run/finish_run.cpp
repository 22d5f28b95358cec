// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/run/finish_run.hpp"

#include "base/format.hpp"
#include "base/version.hpp"
#include "contact/intersections.hpp"
#include "core/accuracy/error_model.hpp"
#include "core/model/fabric_estimates.hpp"
#include "core/run/densest_packing.hpp"
#include "core/run/facet_penetration.hpp"
#include "core/run/ply_motion.hpp"
#include "core/run/ply_plausibility.hpp"
#include "core/run/run_diagnosis.hpp"
#include "core/run/sliding_ranges.hpp"
#include "core/solver/element_mass_scaling.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plyform {
namespace {

/// Contact report of the state in `s`, with the exact count of intersections.
ContactReport audit(const Scene& s, const Snapshot& good, ThreadPool& pool) {
  ContactReport r;
  r.max_tool_penetration_mm = good.tool_penetration;
  r.max_ply_penetration_mm = good.ply_penetration;
  std::vector<MeshView> sheets;
  for (const PlyBody& ply : s.plies)
    sheets.push_back({ply.x, ply.membrane.triangles});
  const Intersections found =
      find_intersections(sheets, [&pool](int count, const auto& task) { pool.run(count, task); });
  r.intersections_between_plies = static_cast<long>(found.between.size());
  r.intersections_within_plies = static_cast<long>(found.within.size());
  return r;
}

/// Inserts reasons to doubt a result at the begin of WorkReport::missing, and changes the status
/// "done" to "doubtful".
void doubt_if(const std::vector<std::string>& reasons, Summary& sum) {
  sum.doubts = reasons;
  sum.work.missing.insert(sum.work.missing.begin(), reasons.begin(), reasons.end());
  if (reasons.empty() || sum.status != "done") return;
  sum.status = "doubtful";
  for (const std::string& reason : reasons)
    sum.message += (sum.message.empty() ? "" : "; ") + reason;
}

/// What WorkReport::missing says of the forces; empty if nothing.
std::string unsettled_forces(const Scene& s, const Dwell& dwell) {
  if (s.data.solver.dwell == 0.0 || dwell.settled || s.time < s.data.solver.duration) return {};
  const bool pressed = !s.data.loads.empty();
  return fmt::format("{} when the dwell ended, {:.2g} s after the {}: a larger solver.dwell, or a "
                     "longer solver.duration, gives them more time",
                     pressed ? "plies had not come to rest, or forces not settled,"
                             : "forces had not settled",
                     s.time - s.data.solver.duration, pressed ? "duration" : "stroke");
}

/// What is predicted, unless the premise of the rule does not hold.
AccuracyReport accuracy_of(const Scene& s, bool flies) {
  const Case& data = s.data;
  const PredictedError error = predicted_error(data, effective_mass_factor(s));
  AccuracyReport accuracy{error.inertia, error.softening,    error.mesh, error.promised(data),
                          1.0,           error.unknown(data)};
  if (!flies) return accuracy;
  accuracy.inertia_deg = accuracy.promised_deg = std::numeric_limits<double>::quiet_NaN();
  if (accuracy.unknown.empty())
    accuracy.unknown = "plies fly at the end, and the rule of inertia is for plies that follow the "
                       "tools";
  return accuracy;
}

std::vector<PushedTool> pushed_tools(const Scene& s) {
  constexpr double share = 0.05, still = 0.01; // of the time; mm
  std::vector<PushedTool> found;
  for (const ToolState& tool : s.tools)
    if (tool.body.force_controlled)
      found.push_back(
          {tool.name, tool.body.speed, std::abs(tool.body.speed) * share * s.time < still});
  return found;
}

/// What WorkReport::missing says of moulds that a force still closes.
std::vector<std::string> moulds_under_way(const Summary& sum) {
  std::vector<std::string> found;
  const bool any = std::any_of(sum.plies.begin(), sum.plies.end(),
                               [](const PlyReport& ply) { return ply.mould.has_value(); });
  for (const PushedTool& tool : sum.pushed)
    if (any && !tool.at_rest)
      found.push_back(
          fmt::format("rest: {}, pushed by a force, moves by {:.2g} mm/s at the end, of "
                      "the simulated time; a longer solver.dwell lets the mould close",
                      tool.name, tool.speed_mm_s));
  return found;
}

} // namespace

void finish(const Scene& s, const RunState& state, const Frame& last, RunResult& result,
            ThreadPool& pool, double elapsed) {
  const Snapshot& good = state.good;
  Summary& sum = result.summary;
  sum.title = s.data.title;
  sum.version = version();
  sum.wall_time_s = elapsed;
  sum.steps = s.step;
  sum.min_step_s = s.min_dt;
  sum.max_step_s = s.max_dt;
  sum.largest_added_mass = s.largest_added_mass;
  sum.element_added_mass = largest_added_element_mass(s);
  sum.threads = pool.size();
  const LargestMotion motion = largest_motion(s, motion_of_plies(s), last.energy.external);
  sum.motion_share = motion.share;
  sum.flies = !motion.flying.empty();
  sum.accuracy = accuracy_of(s, !motion.flying.empty());
  sum.contact = audit(s, good, pool);
  const std::vector<ToolCut> cuts = cuts_between_nodes(s, pool);
  sum.contact.max_tool_penetration_between_nodes_mm = deepest(cuts);
  sum.work = report_work(s, last);
  sum.plies = report_plies(s, result.last);
  sum.assumed = assumptions(s.data);
  const auto stop_if = [&sum](bool wrong, const std::string& message) {
    if (wrong && sum.status == "done") sum.status = "stopped", sum.message = message;
  };
  stop_if(sum.contact.intersections_between_plies > 0,
          fmt::format("the plies overlap: {} pairs of triangles of different plies cross in "
                      "the final state; a finer mesh or a longer solver.duration may help",
                      sum.contact.intersections_between_plies));
  stop_if(any_self_contact(s) && sum.contact.intersections_within_plies > 0,
          fmt::format("a ply goes through itself: {} pairs of triangles of one ply cross in the "
                      "final state, though it is in contact with itself; a finer mesh or a longer "
                      "solver.duration may help",
                      sum.contact.intersections_within_plies));
  sum.known_forces = state.known_forces;
  sum.pushed = pushed_tools(s);
  std::vector<std::string> reasons = doubts(s, last, sum.plies, cuts);
  for (auto&& more : {doubts_of_forces(s, state.known_forces, state.astray),
                      doubts_of_sliding(sum.work.pairs), doubts_of_packing(s, last, state.packing)})
    reasons.insert(reasons.end(), more.begin(), more.end());
  if (sum.contact.intersections_within_plies > 0 && !any_self_contact(s))
    reasons.push_back(fmt::format("do not trust folds: {} pairs of triangles of one ply cross, as "
                                  "nothing keeps them apart; contact.self = \"on\" does",
                                  sum.contact.intersections_within_plies));
  doubt_if(reasons, sum);
  for (std::string& moves : moulds_under_way(sum))
    sum.work.missing.push_back(std::move(moves));
  if (const std::string forces = unsettled_forces(s, state.dwell); !forces.empty())
    sum.work.missing.push_back(forces);
}

} // namespace plyform
