// SPDX-License-Identifier: GPL-3.0-or-later
// Times of the broad phase, the narrow-phase routine and the exact audit on draped sheets.
#include "contact/audit.hpp"
#include "contact/candidates.hpp"
#include "contact/point_triangle.hpp"

#include <benchmark/benchmark.h>
#include <cmath>
#include <random>

namespace plyform {
namespace {

/// n x n cells, 2 n^2 triangles, 250 mm wide, lying at `height` on a ball of 75 mm with a flange.
Surface draped_ply(int n, double height) {
  Surface ply;
  const double h = 250.0 / n;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const double x = i * h - 125.0, y = j * h - 125.0, radius = 75.0;
      const double z2 = radius * radius - x * x - y * y;
      ply.x.push_back({x, y, height + (z2 > 400.0 ? std::sqrt(z2) : 20.0)});
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i, b = a + 1, d = a + n + 1, c = d + 1;
      ply.triangles.push_back({a, b, c});
      ply.triangles.push_back({a, c, d});
    }
  return ply;
}

void TreeBuild(benchmark::State& state) {
  const Surface ply = draped_ply(int(state.range(0)), 0.0);
  for (auto _ : state) {
    SheetTree tree(ply.x, ply.triangles);
    benchmark::DoNotOptimize(tree);
  }
  state.counters["triangles"] = double(ply.triangles.size());
}
BENCHMARK(TreeBuild)->Arg(50)->Arg(158)->Unit(benchmark::kMillisecond);

void TreeRefit(benchmark::State& state) {
  const Surface ply = draped_ply(int(state.range(0)), 0.0);
  SheetTree tree(ply.x, ply.triangles);
  for (auto _ : state)
    tree.refit(ply.x);
  state.counters["triangles"] = double(ply.triangles.size());
}
BENCHMARK(TreeRefit)->Arg(50)->Arg(158)->Unit(benchmark::kMillisecond);

/// One directed traversal of all nodes at a reach of 1.3 mm: 0.3 mm of ply and a skin of 1 mm.
void TreeCandidates(benchmark::State& state) {
  const Surface lower = draped_ply(int(state.range(0)), 0.0);
  const Surface upper = draped_ply(int(state.range(0)), 0.3);
  const SheetTree tree(lower.x, lower.triangles);
  std::vector<Candidate> found;
  for (auto _ : state) {
    found.clear();
    tree.candidates(upper.x, 1.3, found);
  }
  state.counters["triangles"] = double(lower.triangles.size());
  state.counters["per_node"] = double(found.size()) / double(upper.x.size());
  state.SetItemsProcessed(state.iterations() * std::int64_t(upper.x.size()));
}
BENCHMARK(TreeCandidates)->Arg(50)->Arg(158)->Unit(benchmark::kMillisecond);

/// Points over and round about their triangles (range 0: half-width of the cloud in tenths of the
/// triangle's size): all regions in a random order.
void PointTriangle(benchmark::State& state) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<std::array<Vec3, 4>> pairs(4096);
  for (auto& [p, a, b, c] : pairs) {
    a = {-1.0, -0.6, 0.0}, b = {1.0, -0.6, 0.0}, c = {0.0, 1.1, 0.0};
    for (Vec3* corner : {&a, &b, &c})
      *corner += 0.2 * Vec3(unit(random), unit(random), unit(random));
    p = 0.1 * double(state.range(0)) * Vec3(unit(random), unit(random), unit(random));
  }
  double sum = 0.0;
  for (auto _ : state)
    for (const auto& [p, a, b, c] : pairs)
      sum += closest_point_on_triangle(p, a, b, c).distance2;
  benchmark::DoNotOptimize(sum);
  state.SetItemsProcessed(state.iterations() * std::int64_t(pairs.size()));
}
BENCHMARK(PointTriangle)->Arg(2)->Arg(10)->Arg(30);

/// Five plies of 5 000 triangles, 0.3 mm apart.
void Audit(benchmark::State& state) {
  std::vector<Surface> plies;
  for (int k = 0; k < 5; ++k)
    plies.push_back(draped_ply(50, 0.3 * k));
  std::vector<SheetView> views;
  for (const Surface& ply : plies)
    views.push_back({ply.x, ply.triangles});
  std::size_t found = 0;
  for (auto _ : state) {
    const AuditResult result = audit_intersections(views);
    found = result.between.size() + result.within.size();
  }
  state.counters["triangles"] = 5.0 * double(plies[0].triangles.size());
  state.counters["pairs"] = double(found);
}
BENCHMARK(Audit)->Unit(benchmark::kMillisecond);

} // namespace
} // namespace plyform
