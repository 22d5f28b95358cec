// SPDX-License-Identifier: GPL-3.0-or-later
// Flat stacks of cloth that gives way through its thickness, closed to a gap, against closed forms.
//
//   n plies of thickness t at pressure p, sheared by gamma: t(p) / cos(gamma) each, in series
//   gap = sum t(p) / cos(gamma);  F = p A0 cos(gamma)                                         (F)
#include "core/run/densest_packing.hpp"
#include "core/run/run.hpp"
#include "core/solver/force_kinds.hpp"
#include "core/solver/scene.hpp"
#include "core/solver/step.hpp"
#include "support/packing_weave.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace plyform::closed_mould_test {
namespace {

constexpr double side = packing_side, weight = packing_weight;

/// The scene with all plies sheared by gamma (rad), evenly spaced in a closed gap (mm), and its
/// forces computed.
struct ClosedStack {
  Scene scene;
  ThreadPool pool{1};

  ClosedStack(std::size_t plies, double gamma, double gap)
      : scene(make_scene(between_plates(std::vector<Fabric>(plies, packing_weave()), gap))) {
    start(scene, pool);
    for (std::size_t p = 0; p < plies; ++p)
      for (Vec3& x : scene.plies[p].x) {
        x = {x.x() + std::sin(gamma) * x.y(), std::cos(gamma) * x.y(),
             gap * (static_cast<double>(p) + 0.5) / static_cast<double>(plies)};
      }
    scene.time = scene.data.solver.duration;
    compute();
  }
  /// With a search: places were changed by hand.
  void compute() {
    for (PlyBody& ply : scene.plies)
      ply.max_displacement = 1e3;
    const auto stop = compute_forces(scene, pool);
    ASSERT_FALSE(stop) << stop->message;
  }
};

TEST(ClosedMould, FlatStacksBearTheCurveOfTheirClothShearedOrNot) {
  for (const std::size_t plies : {1, 3, 10})
    for (const double degrees : {0.0, 20.0, 40.0}) {
      const double gamma = degrees * degree, t = 0.5 / std::cos(gamma);
      ClosedStack stack(plies, gamma, t * static_cast<double>(plies));
      const double theory = pressure_at(0.5) * side * side * std::cos(gamma);
      const double force = stack.scene.tools[1].force.z();
      fmt::print("{} plies sheared by {}: {:.2f} N, theory {:.2f}\n", plies, degrees, force,
                 theory);
      EXPECT_NEAR(force / theory, 1.0, 1e-3);
    }
}

/// Sheared cloth under pressure resists shear: forces in the plane, too, are slopes of the energy.
/// Not counted is that the place on a face at which a node presses moves over its slope of
/// thickness.
TEST(ClosedMould, ForcesOfAShearedStackAreTheSlopeOfItsEnergy) {
  ClosedStack stack(2, 35.0 * degree, 1.15);
  for (std::size_t p = 0; p < 2; ++p) // waves, in which each node has one closest place
    for (Vec3& x : stack.scene.plies[p].x) {
      const double u = 0.07 * x.x() + 2.0 * static_cast<double>(p), v = 0.09 * x.y();
      x += 0.02 * Vec3(std::sin(u + v), std::cos(v - u), std::sin(v));
    }
  stack.compute();
  const auto energy = [&] {
    stack.compute();
    double sum = 0.0;
    each_contact(stack.scene,
                 [&](const auto& contact, const auto&) { sum += contact.sums.elastic; });
    return sum;
  };
  std::vector<Vec3>& x = stack.scene.plies[0].x;
  const auto contact_force = [&](std::size_t n) {
    const PlyBody& ply = stack.scene.plies[0];
    Vec3 f = stack.scene.ply_pairs[0].force_a[n] + ply.thickness_force[n];
    for (const ToolState& tool : stack.scene.tools)
      if (!tool.contacts[0].force.empty()) f += tool.contacts[0].force[n];
    return f;
  };
  constexpr double neglected = 1e-3;
  double widest = 0.0;
  for (std::size_t n = 0; n < x.size(); n += 7) {
    stack.compute();
    const Vec3 f = contact_force(n), at = x[n];
    widest = std::max(widest, stack.scene.plies[0].thickness_force[n].norm());
    for (int k = 0; k < 3; ++k) {
      constexpr double h = 1e-5; // mm
      x[n][k] = at[k] + h;
      const double up = energy();
      x[n][k] = at[k] - h;
      const double down = energy();
      x[n] = at;
      EXPECT_NEAR(f[k], -(up - down) / (2.0 * h), neglected * (1.0 + f.norm())) << n << ' ' << k;
    }
  }
  EXPECT_GT(widest, 0.01); // N
}

TEST(ClosedMould, TwoFabricsInSeriesShareTheGap) {
  const Fabric soft = packing_weave(5.0, 6.0), hard = packing_weave();
  const double p = 0.03; // N/mm^2, at which both have some thickness
  const double gap = 2.0 * thickness_at(p, 5.0, 6.0) + thickness_at(p, 20.0, 8.0);
  const RunResult run = run_case(between_plates({soft, hard, soft}, gap), 1, {});
  fmt::print("{}: {:.2f} N, theory {:.2f}\n", run.summary.status, -run.last.tools[1].force_N,
             p * side * side);
  EXPECT_NEAR(std::abs(run.last.tools[1].force_N) / (p * side * side), 1.0, 0.01);
  EXPECT_LT(std::abs(run.last.energy.balance_error()), 1e-3);
  for (const KnownForce& known : run.summary.known_forces)
    EXPECT_TRUE(known.to_end());
}

/// A weave that loses its thickness (mm) in proportion to the pressure, down to `packed` under
/// `most` (N/mm^2); none if that is 0.
Fabric spring_weave(double thickness, double packed, double most) {
  Fabric fabric = packing_weave();
  fabric.thickness = thickness;
  fabric.compaction.reset();
  if (most > 0.0) fabric.compaction = Compaction{{{thickness, packed}, {0.0, most}}, {}, 0.0};
  return fabric;
}

/// Largest error of the thickness of plies, and of their fibre volume, from those wanted, over
/// these.
double worst_thickness(const RunResult& run, const std::vector<double>& wanted) {
  double error = 0.0;
  for (std::size_t p = 0; p < wanted.size(); ++p) {
    const PlyFrame& ply = run.last.plies[p];
    for (const double t : ply.thickness)
      error = std::max(error, std::abs(t / wanted[p] - 1.0));
    for (const double v : ply.fibre_volume)
      error = std::max(error, std::abs(v * wanted[p] / weight - 1.0));
  }
  return error;
}

TEST(ClosedMould, PliesOfSeveralFabricsShareTheGapAtEqualPressure) {
  const Fabric soft = spring_weave(0.6, 0.3, 0.1), hard = spring_weave(0.4, 0.35, 0.1),
               stiff = spring_weave(0.5, 0.5, 0.0);
  const double p = 0.0714, s = 0.6 - 3.0 * p, h = 0.4 - 0.5 * p; // N/mm^2, mm
  struct Stack {
    std::vector<Fabric> fabrics;
    std::vector<double> wanted;
  };
  for (const Stack& stack :
       {Stack{{soft, hard}, {s, h}}, Stack{{hard, soft, hard}, {h, s, h}},
        Stack{{soft, stiff, soft}, {s, 0.5, s}}, Stack{{soft, stiff, hard}, {s, 0.5, h}}})
    for (const double element : {6.0, 10.0})
      for (const double duration : {0.02, 0.01}) {
        double gap = 0.0;
        for (const double t : stack.wanted)
          gap += t;
        Case data = between_plates(stack.fabrics, gap, element);
        data.solver.duration = duration, data.solver.fibre_softening = 100.0;
        const RunResult run = run_case(data, 1, {});
        EXPECT_TRUE(ended(run.summary.status)) << run.summary.message;
        const double error = worst_thickness(run, stack.wanted);
        fmt::print("{} plies, elements of {} mm, {} s: {:.4f} off\n", stack.wanted.size(), element,
                   duration, error);
        EXPECT_LT(error, 0.01);
      }
}

/// Pressed to p_1 and let go to p_2: the one that keeps a set has kept it, and pressures are equal.
TEST(ClosedMould, PliesOfTwoFabricsPartTheWayBackToo) {
  Fabric soft = spring_weave(0.6, 0.3, 0.1), hard = spring_weave(0.4, 0.35, 0.1);
  soft.compaction->unloading = {{0.4, 0.3}, {0.0, 0.1}}; // back along 1 mm per N/mm^2
  const double most = 0.08, now = 0.03;                  // N/mm^2
  const double least_s = 0.6 - 3.0 * most, least_h = 0.4 - 0.5 * most;
  const double s = least_s + 1.0 * (most - now), h = 0.4 - 0.5 * now;
  Case data = between_plates({soft, hard}, least_s + least_h);
  data.tools[1].programme = {{0.5, 1.0 - least_s - least_h}, {1.0, 1.0 - s - h}};
  data.tools[1].stroke = 0.0;
  data.solver.fibre_softening = 100.0;
  const RunResult run = run_case(data, 1, {});
  EXPECT_TRUE(ended(run.summary.status)) << run.summary.message;
  const double error = worst_thickness(run, {s, h});
  fmt::print("{:.3f} and {:.3f} mm: {:.4f} off\n", s, h, error);
  EXPECT_LT(error, 0.01);
}

/// All work goes through the thickness, none into shear: inertia is judged by that.
TEST(ClosedMould, InertiaIsJudgedByTheWorkOfCompaction) {
  for (const double element : {6.0, 10.0})
    for (const double duration : {0.02, 0.01}) {
      Case data = between_plates({packing_weave(), packing_weave()}, 0.9, element);
      data.solver.duration = duration, data.solver.fibre_softening = 100.0;
      const RunResult run = run_case(data, 1, {});
      const double free = std::pow(weight / packing_free, 8.0);
      double theory = 0.0; // N/mm, of p over the way of one ply
      constexpr int parts = 1000;
      for (int i = 0; i < parts; ++i)
        theory +=
            (packing_free - 0.45) / parts * 20.0 *
            (std::pow(weight / (0.45 + (packing_free - 0.45) * (i + 0.5) / parts), 8.0) - free);
      theory *= 2.0 * side * side;
      const Energies& e = run.last.energy;
      fmt::print("{} mm, {} s: work {:.3f} of {:.3f} mJ, kinetic {:.2g}, shear {:.2g}\n", element,
                 duration, e.deformation(), theory, e.kinetic, e.shear);
      EXPECT_NEAR(e.deformation() / theory, 1.0, 0.01);
      EXPECT_NEAR(e.kinetic_over_deformation(), e.kinetic / std::max(theory, e.floor),
                  0.01 * e.kinetic_over_deformation());
      for (const std::string& told : run.summary.work.missing)
        EXPECT_EQ(told.find("inertia"), std::string::npos) << told;
    }
}

/// Loaded to 0.48 mm a ply and let go to 0.52, by a curve that keeps a set.
TEST(ClosedMould, UnloadingGoesItsOwnWayAndWhatIsLostIsCounted) {
  Fabric fabric = packing_weave();
  const double end = fabric.compaction->densest(),
               most = fabric.compaction->loading.pressure.back();
  for (int i = 0; i <= 40; ++i) { // p = most s^3 over the way back, which ends at 0.55 mm
    const double s = i / 40.0;
    fabric.compaction->unloading.thickness.push_back(0.55 + (end - 0.55) * s);
    fabric.compaction->unloading.pressure.push_back(most * s * s * s);
  }
  Case data = between_plates({fabric, fabric}, 0.96);
  data.tools[1].programme = {{0.5, 1.2 - 0.96}, {1.0, 1.2 - 1.04}};
  data.tools[1].stroke = 0.0;
  const RunResult run = run_case(data, 1, {});
  const double reached = pressure_at(0.48);
  const double s = std::cbrt(reached / most) + (0.52 - 0.48) / (end - 0.55);
  const double theory = s > 0.0 ? most * s * s * s * side * side : 0.0;
  fmt::print("{}: {:.2f} N, theory {:.2f}, loading {:.2f}; lost {:.3f} of {:.3f} mJ\n",
             run.summary.status, std::abs(run.last.tools[1].force_N), theory,
             pressure_at(0.52) * side * side, run.last.energy.compaction, run.last.energy.external);
  EXPECT_NEAR(std::abs(run.last.tools[1].force_N) / theory, 1.0, 0.01);
  EXPECT_GT(run.last.energy.compaction, 0.0);
  EXPECT_LT(std::abs(run.last.energy.balance_error()), 5e-3);
}

TEST(ClosedMould, BeyondTheDensestPackingForcesAreNotKnown) {
  const double densest = weight / 0.62;
  const RunResult run =
      run_case(between_plates({packing_weave(), packing_weave()}, 2.0 * densest - 0.04), 1, {});
  fmt::print("{}\n", run.summary.message);
  EXPECT_EQ(run.summary.status, "doubtful");
  for (const KnownForce& known : run.summary.known_forces)
    EXPECT_FALSE(known.to_end());
  EXPECT_NE(run.summary.message.find("the fibre volume and thickness of ply1"), std::string::npos);
  EXPECT_NE(run.summary.message.find("beyond its densest packing of 62.0 %"), std::string::npos);
}

/// Nothing is said of stacks that stay within their curves; what has been beyond and is no more is
/// told by its stroke; and so are triangles that are crushed in their plane, and yarns that
/// pressing has stretched.
TEST(ClosedMould, FibreVolumesBeyondTheDensestPackingAreDoubted) {
  Scene scene = make_scene(between_plates({packing_weave()}, 0.5));
  ThreadPool pool{1};
  start(scene, pool);
  const auto frame = [&](double volume, double stroke, double strain = 0.0) {
    Frame f;
    PlyFrame& ply = f.plies.emplace_back();
    ply.x = scene.plies[0].x, ply.triangles = scene.plies[0].membrane.triangles;
    ply.fibre_volume.assign(ply.triangles.size(), 0.5);
    ply.thickness.assign(ply.triangles.size(), 0.5);
    ply.families.resize(2);
    for (FamilyFrame& family : ply.families)
      family.strain.assign(ply.triangles.size(), strain);
    ply.fibre_volume[3] = volume, f.stroke_mm = stroke;
    return f;
  };
  std::vector<Overpacked> plies;
  follow_packing(scene, frame(0.62, 0.1), plies);
  EXPECT_TRUE(doubts_of_packing(scene, frame(0.62, 0.1), plies).empty());
  follow_packing(scene, frame(0.65, 0.2), plies);
  follow_packing(scene, frame(0.60, 0.3), plies);
  std::vector<std::string> told = doubts_of_packing(scene, frame(0.60, 0.3), plies);
  ASSERT_EQ(told.size(), 1u);
  for (const char* part : {"ply1: 65.0 % at (", "after 0.2 mm", "pressed beyond"})
    EXPECT_NE(told[0].find(part), std::string::npos) << told[0];
  told = doubts_of_packing(scene, frame(0.60, 0.3, 0.03), {}); // its yarns by 3 % each
  ASSERT_EQ(told.size(), 1u);
  EXPECT_NE(told[0].find("its volume balance is off by 6.1 %, as its yarns are stretched"),
            std::string::npos)
      << told[0];
  EXPECT_TRUE(doubts_of_packing(scene, frame(0.60, 0.3, 0.005), {}).empty());
  Frame crushed = frame(1.056, 0.4);
  const Triangle t = crushed.plies[0].triangles[3];
  Vec3& corner = crushed.plies[0].x[at(t[2])];
  corner = 0.55 * crushed.plies[0].x[at(t[0])] + 0.45 * corner;
  follow_packing(scene, crushed, plies);
  told = doubts_of_packing(scene, crushed, plies);
  ASSERT_EQ(told.size(), 1u);
  for (const char* part : {"105.6 %", "crushed in their plane, there to 45 % of their area"})
    EXPECT_NE(told[0].find(part), std::string::npos) << told[0];
}

} // namespace
} // namespace plyform::closed_mould_test
