// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/setup/run_prepared.hpp"

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
  return with_preparation(run_case(*prepared.value, threads, hooks, prepared.meshes), prepared);
}

RunResult run_prepared(const PreparedCase& prepared, Scene& scene, int threads,
                       const RunHooks& hooks) {
  return with_preparation(run_scene(scene, threads, hooks), prepared);
}

} // namespace plyform
