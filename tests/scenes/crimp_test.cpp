// SPDX-License-Identifier: GPL-3.0-or-later
// Biaxial tests of a crimped weave as whole runs, against the cell's own equation.
#include "core/run/run.hpp"
#include "support/kill_checks.hpp"
#include "support/stress_scenes.hpp"
#include "support/thread_checks.hpp"

#include <algorithm>
#include <gtest/gtest.h>

namespace plyform::crimp_test {
namespace {

constexpr double half = 20.0; // mm, half a side

/// A grip of one edge that holds it along its direction only, so that it may shorten.
Boundary edge_grip(const std::string& name, const Vec2& low, const Vec2& high,
                   const Vec3& direction, double stroke) {
  Boundary b = hold(name, low, high, direction, stroke);
  b.as<Grip>().held = {direction.x() != 0.0, direction.y() != 0.0, direction.z() != 0.0};
  return b;
}

Fabric crimped() {
  Fabric f = glass_weave();
  f.crossings[0].crimp = CrimpedCell{{4.0, 4.0}, {0.004, 0.01}};
  return f;
}

/// Warp along x drawn by a strain, weft by another, or free where that is NaN. Mesh askew.
Case biaxial(double warp, double weft) {
  Case data = stack_of({0.0}, rectangle(2.0 * half, 2.0 * half, 5.0, MeshKind::diagonal));
  data.fabrics[0] = crimped();
  const Vec2 far(half + 1.0, half + 1.0), in(half - 0.1, half - 0.1);
  data.boundaries = {
      edge_grip("left", {-far.x(), -far.y()}, {-in.x(), far.y()}, -Vec3::UnitX(), warp * half),
      edge_grip("right", {in.x(), -far.y()}, far, Vec3::UnitX(), warp * half)};
  if (!std::isnan(weft)) {
    data.boundaries.push_back(
        edge_grip("below", {-far.x(), -far.y()}, {far.x(), -in.y()}, -Vec3::UnitY(), weft * half));
    data.boundaries.push_back(
        edge_grip("above", {-far.x(), in.y()}, far, Vec3::UnitY(), weft * half));
  }
  Boundary flat = hold("flat", -far, far, Vec3::UnitZ(), 0.0);
  flat.as<Grip>().held = {false, false, true};
  data.boundaries.push_back(flat);
  set_friction(data, 0.0);
  data.solver.duration = 0.02;
  return data;
}

double load(const RunResult& run, const std::string& name) {
  for (const BoundaryFrame& b : run.last.boundaries)
    if (b.name == name) return b.force_N;
  return std::nan("");
}

/// Loads of the grips over yarns for strain ratios 0, 0.5, 1, 2.
TEST(Crimp, BiaxialRunsFollowTheCell) {
  const Fabric f = crimped();
  const double yarns = 2.0 * half * f.families[0].density;
  for (const double ratio : {0.0, 0.5, 1.0, 2.0}) {
    const double eps = 0.01;
    const RunResult run = run_case(biaxial(eps, ratio * eps), 1, {});
    ASSERT_TRUE(ended(run.summary.status)) << run.summary.message;
    const CellAnswer cell = answer_of(*f.crossings[0].crimp, {eps, ratio * eps},
                                      f.families[0].tension, f.families[1].tension);
    const double warp = std::abs(load(run, "right")), weft = std::abs(load(run, "above"));
    std::printf("strain ratio %g: warp %.4g N per yarn, %.5f of the cell; weft %.4g, %.5f\n", ratio,
                warp / yarns, warp / yarns / cell.pull[0], weft / yarns,
                weft / yarns / cell.pull[1]);
    EXPECT_NEAR(warp / yarns, cell.pull[0], 0.01 * cell.pull[0]);
    EXPECT_NEAR(weft / yarns, cell.pull[1], 0.01 * cell.pull[1]);
    EXPECT_LT(std::abs(run.last.energy.balance_error()), 1e-3);
  }
}

/// Free to shorten, the weft takes the height: no load within the toe, that of straight yarns
/// beyond, and the weft has shortened as its length says.
TEST(Crimp, StripOfFreeWeftHasAToe) {
  const Fabric f = crimped();
  const CrimpedCell& cell = *f.crossings[0].crimp;
  const double yarns = 2.0 * half * f.families[0].density, c = cell.crimp[0];
  for (const double eps : {0.5 * c, 2.0 * c}) {
    const RunResult run = run_case(biaxial(eps, std::nan("")), 1, {});
    ASSERT_TRUE(ended(run.summary.status)) << run.summary.message;
    const double per_yarn = std::abs(load(run, "right")) / yarns;
    const double straight =
        f.families[0].tension.stiffness * std::max(0.0, (1.0 + eps) / (1.0 + c) - 1.0);
    std::printf("strain %.4f: %.4g N per yarn, straight yarns have %.4g\n", eps, per_yarn,
                straight);
    EXPECT_NEAR(per_yarn, straight, 0.01 * straight + 1e-3 * 46000.0 * eps);
  }
}

/// A strain that straightens yarns does not make them longer: with softened yarns nothing is said
/// of it, but of one that goes on from there.
TEST(Crimp, WhatStraightensAYarnIsNoElongation) {
  for (const double eps : {0.008, 0.0105}) {
    Case data = biaxial(eps, std::nan(""));
    data.solver.fibre_softening = 2.0;
    const RunResult run = run_case(data, 1, {});
    ASSERT_TRUE(ended(run.summary.status)) << run.summary.message;
    const std::vector<std::string>& missing = run.summary.work.missing;
    const bool told = std::any_of(missing.begin(), missing.end(), [](const std::string& line) {
      return line.find("tensile stiffness") != std::string::npos;
    });
    EXPECT_EQ(told, eps > 0.01) << eps;
  }
}

/// Energy, threads, kills, with yarns that bear compression beside the cells, over a ball.
TEST(Crimp, RunsToTheSameBits) {
  Case data = coarse_hemisphere({0.0, 0.25 * std::numbers::pi});
  data.fabrics = {crimped()};
  stiffen_yarns(data.fabrics[0]);
  data.tools[0].stroke = 25.0;
  data.solver.duration = 0.02;
  const Energies last = expect_sound_and_repeatable(data, 2);
  EXPECT_GT(last.fibre, 0.0);
}

} // namespace
} // namespace plyform::crimp_test
