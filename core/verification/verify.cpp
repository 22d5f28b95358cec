// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/verification/verify.hpp"

#include "core/accuracy/error_model.hpp"
#include "core/verification/bands.hpp"
#include "core/verification/siblings.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace plyform {
namespace {

RunEnd end_of(const Case& data, RunResult run) {
  const double jitter = force_jitter(data, run.last);
  std::vector<double> balance = forces_by_balance(data, run.last);
  return {std::move(run.last), std::move(run.summary.plies), jitter, std::move(balance)};
}

} // namespace

std::optional<Verification> verify(const Case& data, const RunResult& run, int threads,
                                   const VerifyHooks& hooks) {
  const Siblings made = siblings_of(data);
  Verification result;
  result.left_out = made.left_out;
  std::map<Cause, RunEnd> ends;
  double seconds = 0.0;
  for (std::size_t i = 0; i < made.runs.size(); ++i) {
    const Sibling& sibling = made.runs[i];
    if (hooks.begins) hooks.begins(sibling.name, i + 1, made.runs.size());
    RunHooks run_hooks;
    run_hooks.progress = hooks.progress;
    run_hooks.interrupt = hooks.interrupt;
    RunResult end = run_case(sibling.data, threads, run_hooks);
    if (hooks.interrupt && hooks.interrupt->load()) return std::nullopt;
    seconds += end.summary.wall_time_s;
    if (ended(end.summary.status))
      ends[sibling.cause] = end_of(sibling.data, std::move(end));
    else
      result.left_out.push_back(fmt::format("the sibling with a {} did not go to its end: {}",
                                            sibling.name, end.summary.message));
  }
  result.cost = seconds / std::max(run.summary.wall_time_s, 1e-9);
  const RunEnd own = end_of(data, run);
  const PredictedError predicted = predicted_error(data);
  result.figures = verified_figures(own, ends, made, predicted);
  result.shear = verified_shear(own, ends, made, predicted);
  return result;
}

} // namespace plyform
