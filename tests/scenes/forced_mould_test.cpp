// SPDX-License-Identifier: GPL-3.0-or-later
// Moulds that close by a force, and what a closed mould leaves of its gap, on cloth that gives way
// through its thickness.
//
//   n plies under a force F on the area A come to rest at n t(F / A)
#include "core/run/run.hpp"
#include "support/packing_weave.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace plyform::forced_mould_test {
namespace {

constexpr double area = packing_side * packing_side; // mm^2

/// Three plies under a press that is pushed by a force (N).
Case under_force(double force, const Fabric& fabric = packing_weave()) {
  Case data = between_plates({fabric, fabric, fabric}, 1.0);
  Tool& press = data.tools[1];
  press.motion = Motion::force, press.stroke = 0.0, press.force = force;
  data.solver.mass_damping = 2000.0; // 1/s: at rest long before the end
  return data;
}

/// The share of the ply's area before forming at which `value` is in a range.
double share_where(const PlyFrame& ply, const std::vector<double>& values, double from, double to) {
  const std::vector<double> areas = areas_before(ply);
  double sum = 0.0, all = 0.0;
  for (std::size_t e = 0; e < areas.size(); ++e) {
    all += areas[e];
    if (values[e] >= from && values[e] <= to) sum += areas[e];
  }
  return sum / all;
}

TEST(ForcedMould, AFlatStackClosesToTheThicknessOfItsCurve) {
  for (const double force : {130.0, 260.0}) {
    const RunResult run = run_case(under_force(force), 1, {});
    const double room = 1.8 - run.last.tools[1].stroke_mm, t = thickness_at(force / area);
    fmt::print("{} N: {}, {:.4f} mm, theory {:.4f}; {:.3g} mm/s\n", force, run.summary.status, room,
               3.0 * t, run.summary.pushed.at(0).speed_mm_s);
    EXPECT_EQ(run.summary.status, "done");
    EXPECT_NEAR(room / (3.0 * t), 1.0, 0.01);
    ASSERT_EQ(run.summary.pushed.size(), 1u);
    EXPECT_EQ(run.summary.pushed[0].name, "press");
    EXPECT_TRUE(run.summary.pushed[0].at_rest);
    EXPECT_NEAR(run.last.tools[1].force_N / force, 1.0, 0.01);
    for (std::size_t p = 0; p < 3; ++p) {
      const MouldFill& mould = run.summary.plies[p].mould.value();
      const FibreVolume& v = run.summary.plies[p].fibre_volume.value();
      EXPECT_NEAR(mould.area / area, 1.0, 1e-9);
      EXPECT_NEAR(mould.mean_gap, room, 1e-6);
      EXPECT_NEAR(v.mean, packing_weight / t, 0.005);
      EXPECT_LT(v.largest - v.least, 0.01);
      EXPECT_EQ(mould.wider, 0.0);
      EXPECT_EQ(mould.packed, 0.0);
      EXPECT_NEAR(share_where(run.last.plies[p], run.last.plies[p].mould.left, -0.01, 0.01), 1.0,
                  1e-9);
    }
  }
}

/// More than the densest packing bears: it closes no further, and that is told by its area.
TEST(ForcedMould, WhereTheStackIsPackedItCannotCloseFurther) {
  const double force = 1.5 * pressure_at(packing_densest) * area;
  const RunResult run = run_case(under_force(force), 1, {});
  const double room = 1.8 - run.last.tools[1].stroke_mm;
  const MouldFill& mould = run.summary.plies[1].mould.value();
  fmt::print("{:.0f} N: {}, {:.4f} mm, densest {:.4f}; packed on {:.3f}\n", force,
             run.summary.status, room, 3.0 * packing_densest, mould.packed / mould.area);
  EXPECT_LT(room, 3.0 * packing_densest);
  EXPECT_GT(room, 0.97 * 3.0 * packing_densest);
  EXPECT_GT(mould.packed / mould.area, 0.99);
  EXPECT_EQ(mould.wider, 0.0);
}

/// A mould that stands on a step (mm) from `edge` on.
Case on_step_from(double edge, double step, double force) {
  Case data = under_force(force);
  Tool high = data.tools[0];
  high.name = "step";
  high.position = {100.0 + edge, 0.0, step - 5.0};
  data.tools.push_back(high);
  data.tools[1].position.z() += step;
  for (Ply& ply : data.plies)
    ply.z += step;
  set_friction(data, 0.2);
  return data;
}

/// Where the edge of the step is not midway between nodes, the force at its rim is not what it
/// covers.
TEST(ForcedMould, OverAnEdgeThatCutsCellsUnevenlyTheForceIsDoubted) {
  const RunResult run = run_case(on_step_from(-5.5, 1.0, 130.0), 1, {});
  EXPECT_EQ(run.summary.status, "doubtful");
  EXPECT_NE(run.summary.message.find("on step: nodes at its rim"), std::string::npos)
      << run.summary.message;
}

/// A step of 1 mm, its edge midway between nodes: the mould stands on it, and the rest stays open.
TEST(ForcedMould, OnAStepItStandsAndLeavesTheRestOpen) {
  constexpr double step = 1.0, force = 130.0, edge = -3.0, share = 33.0 / 60.0;
  const RunResult run = run_case(on_step_from(edge, step, force), 1, {});
  const double on_step = 1.8 - run.last.tools[1].stroke_mm,
               t = thickness_at(force / (share * area));
  const PlyFrame& ply = run.last.plies[1];
  const MouldFill& mould = run.summary.plies[1].mould.value();
  fmt::print("{}: on the step {:.4f} mm, theory {:.4f}; beside it {:.3f} mm left, of {:.3f}; wider "
             "on {:.3f} of the area\n",
             run.summary.status, on_step, 3.0 * t, mould.widest, on_step + step - 1.8,
             mould.wider / mould.area);
  EXPECT_EQ(run.summary.status, "done");
  EXPECT_TRUE(run.summary.pushed.at(0).at_rest);
  EXPECT_NEAR(on_step / (3.0 * t), 1.0, 0.01);
  const double open = on_step + step - 1.8; // mm
  EXPECT_GE(mould.widest, open - 1e-6);
  EXPECT_NEAR(mould.area / area, 1.0, 1e-9);
  EXPECT_NEAR(mould.wider / mould.area, 1.0 - share, 0.03);
  // triangles that have nodes on both sides of the edge are between the two
  EXPECT_NEAR(share_where(ply, ply.mould.left, -0.01, 0.01), share, 0.06);
  EXPECT_NEAR(share_where(ply, ply.mould.left, open - 0.01, open + 0.01), 1.0 - share, 0.06);
}

/// By what a mould leaves of its gap plies share it as contact does.
TEST(ForcedMould, TheStackHasTheFibreVolumeOfItsGap) {
  const double gap = 1.4, nested = 0.02;
  Fabric fabric = packing_weave();
  fabric.compaction->nesting = nested;
  Case data = between_plates({fabric, fabric, fabric}, gap);
  data.plies[1].z -= nested, data.plies[2].z -= 2.0 * nested;
  data.tools[1].position.z() -= 2.0 * nested, data.tools[1].stroke -= 2.0 * nested;
  const RunResult run = run_case(data, 1, {});
  for (const PlyFrame& ply : run.last.plies) {
    const GapFrame& mould = ply.mould;
    ASSERT_EQ(mould.gap.size(), ply.triangles.size());
    for (std::size_t e = 0; e < ply.triangles.size(); e += 11) {
      EXPECT_NEAR(ply.areal_weight[e], 600.0, 1.0);
      EXPECT_NEAR(mould.gap[e], gap, 1e-6);
      EXPECT_NEAR(mould.left[e], 0.0, 0.005);
      EXPECT_NEAR(mould.fibre_volume[e], 3.0 * packing_weight / gap, 0.002);
      EXPECT_NEAR(mould.packing[e], (3.0 * packing_densest - 2.0 * nested) / gap, 0.002);
    }
  }
}

/// Two plies that nest are thinner than the sum at every pressure.
TEST(ForcedMould, PliesThatNestAreThinnerThanTheSum) {
  constexpr double nested = 0.04, thickness = 0.5; // mm
  Fabric fabric = packing_weave();
  fabric.compaction->nesting = nested;
  const double gap = 2.0 * thickness - nested;
  Case data = between_plates({fabric, fabric}, gap);
  data.plies[1].z -= nested;
  data.tools[1].position.z() -= nested, data.tools[1].stroke -= nested;
  const RunResult run = run_case(data, 1, {});
  const double theory = pressure_at(thickness) * area, force = std::abs(run.last.tools[1].force_N);
  fmt::print("{}: {:.2f} N, theory {:.2f}; without nesting {:.2f}\n", run.summary.status, force,
             theory, pressure_at(0.5 * gap) * area);
  EXPECT_EQ(run.summary.status, "done");
  EXPECT_NEAR(force / theory, 1.0, 0.01);
}

} // namespace
} // namespace plyform::forced_mould_test
