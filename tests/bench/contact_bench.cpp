// SPDX-License-Identifier: GPL-3.0-or-later
// The contact step of two sheets that touch all over, with friction, both directed contacts; and
// what contact does now and then: trees, search, closest points, the exact audit.
#include "contact/intersections.hpp"
#include "contact/point_triangle.hpp"
#include "tests/bench/sheets.hpp"

#include <benchmark/benchmark.h>
#include <random>

namespace plyform {
namespace {

using benchmark::Counter;
constexpr double width = 340.0; // mm, of the shipped hemispheres
constexpr double skin = 0.5;    // mm, the default
constexpr double askew = 0.25 * std::numbers::pi;

PlyPlyContact contact_law() {
  PlyPlyContact c;
  c.law = {1.0, 1e-7, 0.2};
  c.distance = bench_thickness;
  return c;
}

/// A lower and an upper sheet and the contacts of each with the other.
struct Pair {
  BenchSheet lower, upper;
  SheetTree lower_tree, upper_tree;
  PlyPlyContact up = contact_law(), down = contact_law(); ///< slave: the upper, the lower
};

/// Meshes turned against each other by `turn` (rad). Not turned, all nodes lie on nodes.
Pair make_pair(int cells, double cell, double turn) {
  constexpr double pressed = 0.05 * bench_thickness;
  BenchSheet lower = wavy_sheet(cells, cell, 0.0, 0.0);
  BenchSheet upper = wavy_sheet(cells, cell, turn, bench_thickness - pressed);
  SheetTree lower_tree(lower.x, lower.triangles), upper_tree(upper.x, upper.triangles);
  return {std::move(lower), std::move(upper), std::move(lower_tree), std::move(upper_tree)};
}

/// CPU seconds of a search of both contacts, by part.
struct SearchTimes {
  double refit = 0.0, candidates = 0.0, points = 0.0;
  std::size_t found = 0;
};

void search(Pair& p, SearchTimes& times) {
  std::vector<Candidate> up, down;
  const double begin = cpu_seconds();
  p.lower_tree.refit(p.lower.x);
  p.upper_tree.refit(p.upper.x);
  const double refitted = cpu_seconds();
  p.lower_tree.candidates(p.upper.x, bench_thickness + skin, up);
  p.upper_tree.candidates(p.lower.x, bench_thickness + skin, down);
  const double listed = cpu_seconds();
  find_ply_ply_points(p.up, up, p.upper.state(), p.lower.state(), p.lower.triangles, 0.0);
  find_ply_ply_points(p.down, down, p.lower.state(), p.upper.state(), p.upper.triangles, 0.0);
  times.refit += refitted - begin;
  times.candidates += listed - refitted;
  times.points += cpu_seconds() - listed;
  times.found = up.size() + down.size();
}

/// The upper sheet to and fro by a fraction of what sticking allows. Range 1: whether all nodes lie
/// on nodes, as in a stack cut alike before it is drawn in; else nearly all lie over faces.
void ContactStep(benchmark::State& state) {
  const int cells = static_cast<int>(state.range(0));
  Pair p = make_pair(cells, width / cells, state.range(1) != 0 ? 0.0 : askew);
  SearchTimes unused;
  search(p, unused);
  // mm, of a step: some tenths of a millimetre in a thousand steps of the shipped mesh, less with
  // the shorter steps of finer ones
  const double finer = 50.0 / cells;
  const Vec3 way = finer * Vec3(5e-4, 3e-4, 0.0);
  std::vector<Vec3> moved = p.upper.x;
  for (Vec3& x : moved)
    x += way;
  const std::vector<Vec3> forth(moved.size(), way), back(moved.size(), -way);
  const SurfaceKinematics there{moved, forth, p.upper.area, {}},
      here{p.upper.x, back, p.upper.area, {}};
  const double dt = finer * 7e-6; // s
  std::vector<Vec3> on_upper(p.upper.x.size()), on_lower(p.lower.x.size());
  const auto step = [&](bool needs_penalty) {
    const SurfaceKinematics& upper = needs_penalty ? there : here;
    std::fill(on_upper.begin(), on_upper.end(), Vec3::Zero());
    std::fill(on_lower.begin(), on_lower.end(), Vec3::Zero());
    ply_ply_forces(p.up, upper, p.lower.state(), p.lower.triangles, dt, {way.norm(), way.norm()},
                   on_upper, on_lower);
    ply_ply_forces(p.down, p.lower.state(), upper, p.upper.triangles, dt, {way.norm(), way.norm()},
                   on_lower, on_upper);
  };
  bool needs_penalty = false;
  for (int i = 0; i < 4; ++i)
    step(needs_penalty = !needs_penalty);
  for (auto _ : state)
    step(needs_penalty = !needs_penalty);
  if (p.up.fault.node >= 0 || p.down.fault.node >= 0) state.SkipWithError("sheets too deep");
  const auto rate = Counter::kIsIterationInvariantRate;
  const double triangles = 2.0 * static_cast<double>(p.lower.triangles.size());
  const double points = static_cast<double>(p.up.list.active.size() + p.down.list.active.size());
  Traffic t = sheet_traffic(p.up, p.upper.x.size(), p.lower.x.size());
  t += sheet_traffic(p.down, p.lower.x.size(), p.upper.x.size());
  state.SetLabel(state.range(1) != 0 ? "nodes on nodes" : "nodes over faces");
  state.counters["triangles"] = triangles;
  state.counters["ns_an_element"] = Counter(1e-9 * triangles, rate | Counter::kInvert);
  state.counters["ns_a_point"] = Counter(1e-9 * points, rate | Counter::kInvert);
  state.counters["touching"] = (p.up.sums.touching + p.down.sums.touching) / points;
  state.counters["bytes_an_element"] = t.streamed / triangles;
  state.counters["GB_s"] = Counter(1e-9 * t.streamed, rate);
  state.counters["of_stream"] = Counter(stream_seconds(t), rate | Counter::kInvert);
}
BENCHMARK(ContactStep)
    ->ArgNames({"cells", "node_on_node"})
    ->ArgsProduct({{50, 158, 500}, {0, 1}})
    ->Unit(benchmark::kMicrosecond);

void search_benchmark(benchmark::State& state, int cells, double cell) {
  Pair p = make_pair(cells, cell, askew);
  SearchTimes times;
  for (auto _ : state)
    search(p, times);
  const double triangles = 2.0 * static_cast<double>(p.lower.triangles.size());
  const double nodes = 2.0 * static_cast<double>(p.lower.x.size());
  const double log_n = std::log2(0.5 * triangles);
  const double ns = 1e9 / (triangles * static_cast<double>(state.iterations()));
  const double all = ns * (times.refit + times.candidates + times.points);
  state.counters["triangles"] = triangles;
  state.counters["ns_a_triangle"] = all;
  state.counters["ns_a_triangle_log_n"] = all / log_n;
  state.counters["refit_ns"] = ns * times.refit;
  state.counters["candidates_ns"] = ns * times.candidates;
  state.counters["points_ns"] = ns * times.points;
  state.counters["faces_a_node"] = static_cast<double>(times.found) / nodes;
}

/// Ever larger sheets of the shipped mesh: as many faces near each node.
void SearchLarger(benchmark::State& state) {
  search_benchmark(state, static_cast<int>(state.range(0)), width / 50.0);
}
BENCHMARK(SearchLarger)
    ->ArgName("cells")
    ->Arg(50)
    ->Arg(158)
    ->Arg(500)
    ->Arg(1581)
    ->Unit(benchmark::kMillisecond);

/// Ever finer meshes of the same sheet: thickness and skin stay, so there are ever more.
void SearchFiner(benchmark::State& state) {
  const int cells = static_cast<int>(state.range(0));
  search_benchmark(state, cells, width / cells);
}
BENCHMARK(SearchFiner)
    ->ArgName("cells")
    ->Arg(50)
    ->Arg(158)
    ->Arg(500)
    ->Unit(benchmark::kMillisecond);

void TreeBuild(benchmark::State& state) {
  const int cells = static_cast<int>(state.range(0));
  const BenchSheet s = wavy_sheet(cells, width / cells, 0.0, 0.0);
  for (auto _ : state) {
    SheetTree tree(s.x, s.triangles);
    benchmark::DoNotOptimize(tree);
  }
  const double triangles = static_cast<double>(s.triangles.size());
  state.counters["triangles"] = triangles;
  state.counters["ns_a_triangle"] =
      Counter(1e-9 * triangles, Counter::kIsIterationInvariantRate | Counter::kInvert);
}
BENCHMARK(TreeBuild)->ArgName("cells")->Arg(50)->Arg(500)->Unit(benchmark::kMillisecond);

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
  state.counters["ns_a_pair"] =
      Counter(1e-9 * double(pairs.size()), Counter::kIsIterationInvariantRate | Counter::kInvert);
}
BENCHMARK(PointTriangle)->Arg(2)->Arg(10)->Arg(30);

/// Five plies of 5 000 triangles, a thickness apart.
void Audit(benchmark::State& state) {
  std::vector<BenchSheet> plies;
  for (int k = 0; k < 5; ++k)
    plies.push_back(wavy_sheet(50, width / 50.0, askew * (k % 2), bench_thickness * k));
  std::vector<MeshView> views;
  for (const BenchSheet& ply : plies)
    views.push_back({ply.x, ply.triangles});
  std::size_t found = 0;
  for (auto _ : state) {
    const Intersections result = find_intersections(views);
    found = result.between.size() + result.within.size();
  }
  const double triangles = 5.0 * double(plies[0].triangles.size());
  state.counters["triangles"] = triangles;
  state.counters["ns_a_triangle"] =
      Counter(1e-9 * triangles, Counter::kIsIterationInvariantRate | Counter::kInvert);
  state.counters["pairs"] = double(found);
}
BENCHMARK(Audit)->Unit(benchmark::kMillisecond);

} // namespace
} // namespace plyform
