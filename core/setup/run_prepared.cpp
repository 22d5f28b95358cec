// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/setup/run_prepared.hpp"

#include "core/setup/instant.hpp"

namespace plyform {
namespace {

RunResult with_preparation(RunResult result, const PreparedCase& prepared) {
  Summary& summary = result.summary;
  summary.accuracy.coarsening = prepared.coarsening;
  summary.given = prepared.given;
  summary.assumed.insert(summary.assumed.begin(), prepared.notes.begin(), prepared.notes.end());
  return result;
}

} // namespace

RunResult run_prepared(const PreparedCase& prepared, int threads, const RunHooks& hooks) {
  if (prepared.value->accuracy.instant)
    return with_preparation(run_instant(prepared, threads, hooks), prepared);
  return with_preparation(run_case(*prepared.value, threads, hooks, prepared.meshes), prepared);
}

RunResult run_prepared(const PreparedCase& prepared, Scene& scene, int threads,
                       const RunHooks& hooks) {
  if (prepared.value->accuracy.instant) return run_prepared(prepared, threads, hooks);
  return with_preparation(run_scene(scene, threads, hooks), prepared);
}

} // namespace plyform
