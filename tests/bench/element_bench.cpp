// SPDX-License-Identifier: GPL-3.0-or-later
// The element: forces of all triangles and their sums at the nodes, plain and averaged, on the same
// mesh, squares of one diagonal with the yarns at 22.5 degrees to them; of a weave, and of one with
// one or two directions of stitches that may break.
#include "tests/bench/element_traffic.hpp"

#include <benchmark/benchmark.h>
#include <cmath>
#include <numbers>

namespace plyform {
namespace {

Fabric glass(std::int64_t stitches) {
  Fabric f = woven_fabric();
  f.families[0].tension.stiffness = 46000.0;
  f.families[1].tension.stiffness = 48000.0;
  f.families[0].density = f.families[1].density = 0.25;
  f.crossings[0].shear.k = {0.37044, 0.84105, 1.03113};
  f.surface_density = 6e-10;
  for (std::int64_t i = 0; i < stitches; ++i) {
    Stitch& s = f.stitches.emplace_back();
    s.angle = 0.6 + 0.5 * static_cast<double>(i), s.density = 0.2;
    s.law.tension.stiffness = 30.0, s.law.breaking_force = 8.0;
  }
  return f;
}

struct Sheet {
  std::int64_t cells = 0;
  bool averaged = false;
  std::int64_t stitches = 0; ///< directions
  Membrane m;
  std::vector<Vec3> x0, x; ///< x: sheared by some degrees, wavy, taut in waves
  std::vector<Vec3> force;
};

/// 2 cells^2 triangles; the last one asked for is kept, since benchmarks run several times.
Sheet& sheet(std::int64_t cells, bool averaged, std::int64_t stitches = 0) {
  static Sheet s;
  if (s.cells == cells && s.averaged == averaged && s.stitches == stitches) return s;
  s = {};
  s.cells = cells, s.averaged = averaged, s.stitches = stitches;
  BlankSpec blank;
  blank.outline.boundary = {{0, 0}, {300, 0}, {300, 300}, {0, 300}};
  blank.element_size = 300.0 / static_cast<double>(cells);
  const BlankMesh mesh = mesh_blank(blank, 0.0, 0.5 * std::numbers::pi);
  s.m = make_membrane(mesh, glass(stitches), std::numbers::pi / 8.0,
                      averaged ? ElementKind::averaged : ElementKind::plain);
  for (MembraneFamily& family : s.m.families)
    family.viscosity = family.stitch ? 0.0 : 1e-3;
  for (const Vec2& p : mesh.x) {
    s.x0.emplace_back(p.x(), p.y(), 0.0);
    s.x.emplace_back(p.x() + 0.2 * p.y() + 0.01 * std::sin(0.3 * p.y()), p.y() + 0.1 * p.x(),
                     std::sin(0.05 * p.x() + 0.07 * p.y()));
  }
  s.force.assign(s.x.size(), Vec3::Zero());
  return s;
}

void count_elements(benchmark::State& state, const Sheet& s) {
  const auto inverse_rate =
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert;
  const double triangles = static_cast<double>(s.m.triangles.size());
  state.SetLabel(s.averaged ? "averaged" : "plain");
  state.counters["triangles"] = triangles;
  state.counters["ns_an_element"] = benchmark::Counter(1e-9 * triangles, inverse_rate);
}

/// As the step does it: four groups side by side, block by block, then the sums at the nodes.
void find_forces(MembraneSimd& simd, Sheet& s, const std::vector<SimdYarnStates>& begin,
                 std::vector<SimdYarnStates>& end) {
  for (int b = 0; b < static_cast<int>(simd.blocks.size()); ++b)
    simd_forces(simd, s.m, s.x, 1e-6, b, {begin, end});
  for (std::size_t n = 0; n < s.x.size(); ++n)
    s.force[n] = simd_force(simd, n);
  benchmark::DoNotOptimize(s.force.data());
}

/// find_forces, beside what the machine streams and computes.
void ElementSimd(benchmark::State& state) {
  Sheet& s = sheet(state.range(0), state.range(1) != 0);
  MembraneSimd simd = make_membrane_simd(s.m, s.x0);
  std::vector<SimdYarnStates> states = states_at_start(simd, s.m), end = states;
  Traffic t = lane_traffic(simd, s.x.size());
  t += traffic(s.force.size(), sizeof(Vec3));
  const double seconds = stream_seconds(t), peak = peak_arithmetic();
  for (auto _ : state)
    find_forces(simd, s, states, end);
  count_elements(state, s);
  using benchmark::Counter;
  const auto rate = Counter::kIsIterationInvariantRate;
  const double triangles = static_cast<double>(s.m.triangles.size());
  state.counters["bytes_an_element"] = t.streamed / triangles;
  state.counters["GB_s"] = Counter(1e-9 * t.streamed, rate);
  state.counters["stream_GB_s"] = 1e-9 * t.streamed / seconds;
  state.counters["of_stream"] = Counter(seconds, rate | Counter::kInvert);
  state.counters["of_peak"] = Counter(element_operations(s.averaged) * triangles / peak, rate);
}
BENCHMARK(ElementSimd)
    ->ArgNames({"cells", "averaged"})
    ->ArgsProduct({{50, 158, 500, 1581}, {0, 1}})
    ->Unit(benchmark::kMicrosecond);

/// The same of a weave with so many directions of stitches.
void ElementStitched(benchmark::State& state) {
  Sheet& s = sheet(50, state.range(1) != 0, state.range(0));
  MembraneSimd simd = make_membrane_simd(s.m, s.x0);
  std::vector<SimdYarnStates> states = states_at_start(simd, s.m), end = states;
  for (auto _ : state)
    find_forces(simd, s, states, end);
  count_elements(state, s);
}
BENCHMARK(ElementStitched)
    ->ArgNames({"stitches", "averaged"})
    ->ArgsProduct({{0, 1, 2}, {0, 1}})
    ->Unit(benchmark::kMicrosecond);

/// One triangle after the other, the oracle of the above.
void ElementForces(benchmark::State& state) {
  Sheet& s = sheet(state.range(0), state.range(1) != 0);
  std::vector<ElementForce> q(s.m.triangles.size());
  std::vector<YarnMemory> states = memory_at_start(s.m);
  for (auto _ : state) {
    element_forces(s.m, s.x, 1e-6, 0, s.m.groups(), {states, states}, q);
    for (std::size_t n = 0; n < s.x.size(); ++n)
      s.force[n] = node_force(s.m, q, static_cast<int>(n));
    benchmark::DoNotOptimize(s.force.data());
  }
  count_elements(state, s);
}
BENCHMARK(ElementForces)
    ->ArgNames({"cells", "averaged"})
    ->ArgsProduct({{50, 158}, {0, 1}})
    ->Unit(benchmark::kMicrosecond);

/// Energies, as asked for now and then.
void ElementEnergy(benchmark::State& state) {
  Sheet& s = sheet(state.range(0), state.range(1) != 0);
  const MembraneSimd simd = make_membrane_simd(s.m, s.x0);
  const std::vector<SimdYarnStates> states = states_at_start(simd, s.m);
  for (auto _ : state) {
    MembraneEnergy sum;
    for (int b = 0; b < static_cast<int>(simd.blocks.size()); ++b) {
      const MembraneEnergy e = simd_energy(simd, s.m, s.x, 1e-6, b, states);
      sum.fibre += e.fibre, sum.shear += e.shear;
    }
    benchmark::DoNotOptimize(sum);
  }
  count_elements(state, s);
}
BENCHMARK(ElementEnergy)
    ->ArgNames({"cells", "averaged"})
    ->ArgsProduct({{50}, {0, 1}})
    ->Unit(benchmark::kMicrosecond);

} // namespace
} // namespace plyform
