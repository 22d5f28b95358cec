// SPDX-License-Identifier: GPL-3.0-or-later
// Whole steps of the shipped case of five plies over a hemisphere, finer and finer.
#include "core/setup/prepare_case.hpp"
#include "core/solver/step.hpp"
#include "tests/bench/element_traffic.hpp"
#include "tests/bench/sheets.hpp"

#include <benchmark/benchmark.h>
#include <chrono>
#include <fmt/format.h>
#include <fstream>
#include <malloc.h>
#include <stdexcept>

namespace plyform {
namespace {

/// Bytes of memory that the process holds, its code left out (Linux).
double resident_bytes() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (word == "RssAnon:") {
      double kilobytes = 0.0;
      status >> kilobytes;
      return 1024.0 * kilobytes;
    }
  return 0.0;
}

Scene five_plies(double element_size) {
  constexpr double shipped = 6.8; // mm
  // Steps shrink with the elements: so does the time, and the blank-holder's force comes on within
  // as many steps.
  const PreparedCase reading =
      prepare_case(PLYFORM_CASES "/hemisphere_five_ply/case.toml",
                   {{"blanks.square.element_size", fmt::format("{}", element_size)},
                    {"solver.duration", fmt::format("{}", 0.1 * element_size / shipped)}});
  if (!reading.value) throw std::runtime_error(reading.errors.front().text());
  return make_scene(*reading.value);
}

/// A stack that has gone some steps, kept for the benchmarks that come next.
struct Stack {
  std::int64_t size = 0, steps = 0; ///< um; before the first measurement
  Scene scene;
  double triangles = 0.0, bytes = 0.0; ///< memory that the scene takes
  std::string trouble;
};

void go(Stack& s, std::int64_t steps, ThreadPool& pool) {
  for (std::int64_t i = 0; i < steps && s.trouble.empty(); ++i) {
    if (const auto stop = compute_forces(s.scene, pool)) s.trouble = stop->message;
    move_plies(s.scene, pool);
  }
}

Stack& stack(std::int64_t size, std::int64_t steps) {
  static Stack s;
  if (s.size == size && s.steps == steps) return s;
  s = {};
  malloc_trim(0);
  const double before = resident_bytes();
  s.size = size, s.steps = steps;
  s.scene = five_plies(1e-3 * static_cast<double>(size));
  ThreadPool pool(2);
  start(s.scene, pool);
  go(s, steps, pool);
  malloc_trim(0);
  s.bytes = resident_bytes() - before;
  for (const PlyBody& ply : s.scene.plies)
    s.triangles += static_cast<double>(ply.membrane.triangles.size());
  return s;
}

/// One step without searches and edges, each array once.
Traffic step_traffic(const Scene& s) {
  Traffic t;
  const auto nodes = [&s](int ply) { return s.plies[ply].x.size(); };
  for (const PlyBody& ply : s.plies) {
    if (ply.simd) t += lane_traffic(*ply.simd, ply.x.size());
    t += traffic(ply.x.size(), 2 * sizeof(Vec3), 2.0);             // place, velocity
    t += traffic(ply.x.size(), 2 * sizeof(Vec3) + sizeof(double)); // motion, x_search, mass
    t += traffic(ply.nodal_forces.size() * ply.x.size(), sizeof(Vec3));
  }
  each_pass(s, [&](const PlyContact& pass) {
    if (!pass.contact.points.empty())
      t += sheet_traffic(pass.contact, nodes(pass.slave), nodes(pass.master));
  });
  for (const ToolState& tool : s.tools)
    for (const ToolPlyContact& c : tool.contacts) {
      if (c.points.empty()) continue;
      t += traffic(c.list.active.size(), sizeof(ToolPlyPoint), 2.0);
      t += traffic(c.force.size(), sizeof(Vec3), 3.0);
    }
  return t;
}

/// Share of the points of sheet contacts that touch.
double touching(const Scene& s) {
  double touch = 0.0, points = 0.0;
  each_pass(s, [&](const PlyContact& pass) {
    touch += pass.contact.sums.touching;
    points += static_cast<double>(pass.contact.points.size());
  });
  return points > 0.0 ? touch / points : 0.0;
}

/// Ranges: element size in um, steps gone before, steps measured, threads.
void WholeStep(benchmark::State& state) {
  Stack& s = stack(state.range(0), state.range(1));
  ThreadPool pool(static_cast<int>(state.range(3)));
  const long searches = s.scene.searches;
  double cpu = 0.0, wall = 0.0;
  const auto now = [] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
  };
  for (auto _ : state) {
    const double cpu_begin = cpu_seconds(), begin = now();
    go(s, state.range(2), pool);
    cpu += cpu_seconds() - cpu_begin, wall += now() - begin;
  }
  if (!s.trouble.empty()) state.SkipWithError(s.trouble.c_str());
  const double steps = static_cast<double>(state.range(2) * state.iterations());
  const double element_steps = steps * s.triangles;
  const Traffic t = step_traffic(s.scene);
  state.counters["triangles"] = s.triangles;
  state.counters["threads"] = static_cast<double>(state.range(3));
  state.counters["cpu_ns_an_element"] = 1e9 * cpu / element_steps;
  state.counters["wall_ns_an_element"] = 1e9 * wall / element_steps;
  state.counters["bytes_an_element"] = t.streamed / s.triangles;
  state.counters["of_stream"] = cpu / steps / stream_seconds(t);
  state.counters["memory_a_triangle"] = s.bytes / s.triangles;
  state.counters["touching"] = touching(s.scene);
  state.counters["steps_a_search"] =
      steps / std::max(1.0, static_cast<double>(s.scene.searches - searches));
}
BENCHMARK(WholeStep)
    ->ArgNames({"size", "before", "steps", "threads"})
    ->Args({6800, 1000, 400, 1})
    ->Args({6800, 1000, 400, 2})
    ->Args({2150, 300, 100, 1})
    ->Args({2150, 300, 100, 2})
    ->Args({680, 100, 25, 1})
    ->Args({680, 100, 25, 2})
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

} // namespace
} // namespace plyform
