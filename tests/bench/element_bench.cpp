// SPDX-License-Identifier: GPL-3.0-or-later
// Time of the element: forces of all triangles and their sums at the nodes, plain and averaged, on
// the same mesh, squares of one diagonal with the yarns at 22.5 degrees to them.
#include "core/membrane.hpp"

#include <benchmark/benchmark.h>
#include <cmath>
#include <numbers>

namespace plyform {
namespace {

Fabric glass() {
  Fabric f;
  f.warp.stiffness = 46000.0;
  f.weft.stiffness = 48000.0;
  f.warp_density = f.weft_density = 0.25;
  f.shear.k = {0.37044, 0.84105, 1.03113};
  f.surface_density = 6e-10;
  return f;
}

/// Sheared by some degrees, wavy, taut in waves.
std::vector<Vec3> shape(const BlankMesh& mesh) {
  std::vector<Vec3> x;
  for (const Vec2& p : mesh.x)
    x.emplace_back(p.x() + 0.2 * p.y() + 0.01 * std::sin(0.3 * p.y()), p.y() + 0.1 * p.x(),
                   std::sin(0.05 * p.x() + 0.07 * p.y()));
  return x;
}

void ElementForces(benchmark::State& state) {
  const double cells = static_cast<double>(state.range(0));
  BlankSpec blank;
  blank.outline.boundary = {{0, 0}, {300, 0}, {300, 300}, {0, 300}};
  blank.element_size = 300.0 / cells;
  const BlankMesh mesh = mesh_blank(blank, 0.0, 0.5 * std::numbers::pi);
  Membrane m = make_membrane(mesh, glass(), std::numbers::pi / 8.0,
                             state.range(1) ? ElementKind::averaged : ElementKind::plain);
  const std::vector<Vec3> x = shape(mesh);
  std::vector<ElementForce> q(m.triangles.size());
  std::vector<Vec3> force(x.size());
  for (auto _ : state) {
    element_forces(m, x, 1e-6, 0, m.patches(), q);
    for (std::size_t n = 0; n < x.size(); ++n)
      force[n] = node_force(m, q, static_cast<int>(n));
    benchmark::DoNotOptimize(force.data());
  }
  state.SetLabel(state.range(1) ? "averaged" : "plain");
  state.counters["ns_an_element"] = benchmark::Counter(
      1e-9 * static_cast<double>(m.triangles.size()),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(ElementForces)->ArgsProduct({{50, 158}, {0, 1}});

} // namespace
} // namespace plyform
