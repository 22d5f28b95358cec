// SPDX-License-Identifier: GPL-3.0-or-later
// The shipped case of five plies with its tools as they are, and as meshes with facets of 1 mm.
#include "core/run/run.hpp"
#include "core/setup/prepare_case.hpp"
#include "tests/bench/machine.hpp"

#include <benchmark/benchmark.h>
#include <chrono>
#include <stdexcept>

namespace plyform {
namespace {

PreparedCase five_plies() {
  PreparedCase reading = prepare_case(PLYFORM_CASES "/hemisphere_five_ply/case.toml", {});
  if (!reading.value) throw std::runtime_error(reading.errors.front().text());
  return reading;
}

/// Range: 1 if the tools are meshes. Making them clean is counted, as a file of them would be.
void WholeRun(benchmark::State& state) {
  PreparedCase reading = five_plies();
  Case& data = *reading.value;
  const bool meshes = state.range(0) != 0;
  std::vector<TriMesh> surfaces;
  double facets = 0.0;
  constexpr double reach = 400.0; // mm, beyond the plies' corners
  for (const Tool& tool : data.tools) {
    surfaces.push_back(meshes ? tessellate(tool.shape, 1.0, reach) : TriMesh{});
    facets += static_cast<double>(surfaces.back().triangles.size());
  }
  double cpu = 0.0, wall = 0.0;
  RunResult ended;
  for (auto _ : state) {
    const auto begin = std::chrono::steady_clock::now();
    const double cpu_begin = cpu_seconds();
    for (std::size_t t = 0; meshes && t < data.tools.size(); ++t)
      data.tools[t].shape = make_mesh_shape(surfaces[t], nullptr);
    ended = run_case(data, 2, {}, reading.meshes);
    cpu += cpu_seconds() - cpu_begin;
    wall += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }
  state.counters["facets"] = facets;
  state.counters["cpu_s"] = cpu;
  state.counters["wall_s"] = wall;
  state.counters["steps"] = static_cast<double>(ended.summary.steps);
}
BENCHMARK(WholeRun)->ArgNames({"meshes"})->Arg(0)->Arg(1)->Iterations(1)->Unit(benchmark::kSecond);

} // namespace
} // namespace plyform
