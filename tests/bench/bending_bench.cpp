// SPDX-License-Identifier: GPL-3.0-or-later
// Bending: forces of all nodes, four side by side as the step does it and one after the other, out
// of the sheet alone and with yarns that bend in it.
#include "core/ply/bending_simd.hpp"
#include "tests/support/bending_laws.hpp"
#include "tests/support/bending_reference.hpp"

#include <benchmark/benchmark.h>
#include <cmath>
#include <numbers>

namespace plyform {
namespace {

struct BentSheet {
  Bending bending;
  BendingSimd simd;
  std::vector<Vec3> x, force;
  double triangles = 0.0;
};

/// cells^2 squares of 6.8 mm; `mesh_kind` a MeshKind; wavy and sheared.
BentSheet bent_sheet(std::int64_t cells, std::int64_t mesh_kind, bool in_plane) {
  const double size = 6.8 * static_cast<double>(cells);
  BlankSpec blank;
  blank.outline.boundary = {{0, 0}, {size, 0}, {size, size}, {0, size}};
  blank.element_size = 6.8;
  blank.mesh = static_cast<MeshKind>(mesh_kind);
  const BlankMesh mesh = mesh_blank(blank, 0.0, 0.5 * std::numbers::pi);
  BendingLaw law = weave_bending();
  law.families[0].law.stiffness = law.families[1].law.stiffness = law.twist = 2.0;
  if (in_plane) {
    law.families[0].in_plane = 8.0, law.families[1].in_plane = 8.0;
  }
  BentSheet s;
  const std::vector<double> masses(mesh.x.size(), 1e-8);
  s.bending = make_bending(mesh.x, mesh.triangles, law, 0.0, 0.5 * std::numbers::pi, masses);
  std::vector<Vec3> x0;
  for (const Vec2& p : mesh.x) {
    x0.emplace_back(p.x(), p.y(), 0.0);
    s.x.emplace_back(p.x() + 0.2 * p.y(), p.y() + 0.1 * p.x(),
                     std::sin(0.05 * p.x() + 0.07 * p.y()));
  }
  s.simd = make_bending_simd(s.bending, x0);
  s.force.resize(s.x.size());
  s.triangles = static_cast<double>(mesh.triangles.size());
  return s;
}

void count_elements(benchmark::State& state, const BentSheet& s) {
  const char* mesh = state.range(1) == static_cast<std::int64_t>(MeshKind::diagonal) ? "diagonal"
                     : state.range(1) == static_cast<std::int64_t>(MeshKind::alternating)
                         ? "alternating"
                         : "free";
  state.SetLabel(std::string(mesh) + (state.range(2) != 0 ? ", in the plane too" : ""));
  state.counters["triangles"] = s.triangles;
  state.counters["ns_an_element"] =
      benchmark::Counter(1e-9 * s.triangles, benchmark::Counter::kIsIterationInvariantRate |
                                                 benchmark::Counter::kInvert);
}

void BendingLanesForces(benchmark::State& state) {
  BentSheet s = bent_sheet(state.range(0), state.range(1), state.range(2) != 0);
  for (auto _ : state) {
    for (int b = 0; b < static_cast<int>(s.simd.blocks.size()); ++b)
      bending_forces(s.simd, s.x, b);
    for (std::size_t n = 0; n < s.x.size(); ++n)
      s.force[n] = simd_force(s.simd, n);
    benchmark::DoNotOptimize(s.force.data());
  }
  count_elements(state, s);
}
BENCHMARK(BendingLanesForces)
    ->ArgNames({"cells", "mesh", "in_plane"})
    ->ArgsProduct({{50, 158}, {0, 1, 4}, {0, 1}})
    ->Unit(benchmark::kMicrosecond);

/// The oracle of the above.
void BendingReference(benchmark::State& state) {
  BentSheet s = bent_sheet(state.range(0), state.range(1), state.range(2) != 0);
  for (auto _ : state) {
    s.force = reference_bending_forces(s.bending, s.x);
    benchmark::DoNotOptimize(s.force.data());
  }
  count_elements(state, s);
}
BENCHMARK(BendingReference)
    ->ArgNames({"cells", "mesh", "in_plane"})
    ->ArgsProduct({{50}, {0, 1}, {0, 1}})
    ->Unit(benchmark::kMicrosecond);

} // namespace
} // namespace plyform
