// SPDX-License-Identifier: GPL-3.0-or-later
// Mass on small elements: how much, on which, what it does to the step, and what it leaves as it
// is.
#include "core/model/fabric_estimates.hpp"
#include "core/run/checkpoint.hpp"
#include "core/run/run.hpp"
#include "core/solver/element_mass_scaling.hpp"
#include "core/solver/nodal_forces.hpp"
#include "core/solver/omega_cap.hpp"
#include "core/solver/stable_time_step.hpp"
#include "core/solver/step.hpp"
#include "support/scene_checks.hpp"

#include <algorithm>
#include <gtest/gtest.h>

namespace plyform::element_mass_scaling_test {
namespace {

/// 50 x 50 mm in cells of 5 mm, but for a strip of 5 mm, a tenth of the mass, whose cells are
/// narrower by `parts`: omega^2 is up to the square of that as much.
BlankMesh graded_mesh(int parts = 4) {
  std::vector<double> across{-25, -20, -15, -10, -5};
  for (int i = 0; i < parts; ++i)
    across.push_back(5.0 * i / parts);
  across.insert(across.end(), {5, 10, 15, 20, 25});
  const int columns = static_cast<int>(across.size()), rows = 11;
  BlankMesh mesh;
  for (int j = 0; j < rows; ++j)
    for (const double x : across)
      mesh.x.emplace_back(x, 5.0 * j - 25.0);
  for (int j = 0; j + 1 < rows; ++j)
    for (int i = 0; i + 1 < columns; ++i) {
      const int a = j * columns + i, b = a + 1, c = a + columns, d = c + 1;
      mesh.triangles.push_back({a, b, d});
      mesh.triangles.push_back({a, d, c});
    }
  return mesh;
}

/// Plies at the plain element's angle and the averaged one's, without tools, softened so that
/// tension and compression are as stiff.
Case plies(double share) {
  Case data = stack_of({0.0, 0.8}, rectangle(50.0, 50.0, 5.0));
  for (TensionLaw* yarn :
       {&data.fabrics[0].families[0].tension, &data.fabrics[0].families[1].tension})
    yarn->compression = 0.01 * yarn->stiffness;
  data.fabrics[0].families[0].bending.stiffness = data.fabrics[0].families[1].bending.stiffness =
      2.0; // N mm
  data.fabrics[0].twist = 2.0;
  data.solver.fibre_softening = 100.0;
  data.solver.step_factor = 0.9;
  data.solver.duration = 0.01;
  data.solver.element_mass_scaling = share;
  set_friction(data, 0.2);
  return data;
}

Case pressed(double share, double plate_mass) {
  Case data = plies(share);
  press_by_plate(data);
  data.tools[1].mass = plate_mass;
  return data;
}

Scene graded(const Case& data, int parts = 4) {
  return make_scene(data, std::vector<BlankMesh>(data.plies.size(), graded_mesh(parts)));
}

double largest_share(const Scene& s) {
  double share = 0.0;
  for (const PlyBody& ply : s.plies)
    share = std::max(share, added_element_mass(ply.membrane));
  return share;
}

double stable_dt(Scene& s) {
  ThreadPool pool(1);
  start(s, pool);
  EXPECT_FALSE(compute_forces(s, pool));
  return s.stable_dt;
}

/// Energy balance error after some steps; the scene must have been started.
double balance_after(Scene& s, int steps) {
  ThreadPool pool(1);
  s.start_energy = current_energies(s, pool).residual();
  for (int step = 0; step < steps; ++step) {
    if (auto stop = compute_forces(s, pool)) {
      ADD_FAILURE() << stop->message;
      break;
    }
    move_plies(s, pool);
  }
  EXPECT_FALSE(compute_forces(s, pool));
  return current_energies(s, pool).balance_error();
}

TEST(OmegaCap, TakesItsBudgetAndNoMore) {
  // 16 and 4 times as stiff as 1: at a cap of 2 they take 7 + 1 times their mass
  const std::vector<StiffMass> stiff{{16.0, 1.0}, {4.0, 1.0}};
  const OmegaCap cap = lowest_cap(stiff, 1.0, 8.0);
  EXPECT_DOUBLE_EQ(cap.before, 16.0);
  EXPECT_DOUBLE_EQ(cap.omega2, 2.0);
  EXPECT_DOUBLE_EQ(lowest_cap(stiff, 1.0, 1.0).omega2, 8.0); // the first alone
  EXPECT_DOUBLE_EQ(lowest_cap(stiff, 1.0, 100.0).omega2, 1.0);
}

TEST(ElementMassScaling, AddsNoMoreThanItsShareToAnyPlyAndToSmallElementsOnly) {
  for (const double share : {0.02, 0.3}) {
    const Scene s = graded(plies(share));
    EXPECT_NEAR(largest_share(s), share, 1e-12);
    for (const PlyBody& ply : s.plies) {
      EXPECT_EQ(ply.mass, ply.membrane.node_mass);
      for (std::size_t n = 0; n < ply.x.size(); ++n) {
        const double cloth = ply.membrane.cloth_mass(n);
        const bool in_strip = ply.x0[n].x() >= 0.0 && ply.x0[n].x() <= 5.0;
        if (in_strip)
          EXPECT_GE(ply.mass[n], cloth * (1.0 - 1e-14));
        else
          EXPECT_EQ(ply.mass[n], cloth) << n;
      }
    }
  }
}

TEST(ElementMassScaling, StopsWhereElementsOfUsualSizeSetTheStep) {
  Scene all = graded(plies(1.0), 2), without = graded(plies(0.0), 2);
  Scene uniform = make_scene(plies(0.0));
  // a tenth of the mass up to four times as heavy, not all that it may
  EXPECT_GT(largest_share(all), 0.05);
  EXPECT_LT(largest_share(all), 0.3);
  const double usual = stable_dt(uniform);
  EXPECT_LT(stable_dt(without), 0.65 * usual);
  EXPECT_GT(stable_dt(all), 0.9 * usual);
}

TEST(ElementMassScaling, AddsNothingWhereTheStepWouldHardlyBeLonger) {
  // a tenth of the mass by a twentieth heavier
  EXPECT_EQ(largest_share(graded(plies(0.005))), 0.0);
}

TEST(ElementMassScaling, MakesTheStepOfAGradedMeshLonger) {
  Scene without = graded(plies(0.0)), with = graded(plies(0.3));
  const double before = stable_dt(without), after = stable_dt(with);
  // a tenth of the mass, made four times as heavy, were all of it equally stiff
  EXPECT_GT(after, 1.6 * before);
  EXPECT_LT(after, 2.1 * before);
}

TEST(ElementMassScaling, LeavesAUniformMeshAsItIs) {
  Scene with = make_scene(plies(1.0)), without = make_scene(plies(0.0));
  for (std::size_t p = 0; p < with.plies.size(); ++p) {
    EXPECT_TRUE(with.plies[p].membrane.density_factor.empty());
    EXPECT_EQ(with.plies[p].mass, without.plies[p].mass);
  }
  EXPECT_EQ(stable_dt(with), stable_dt(without));
}

TEST(ElementMassScaling, StaysStableAndKeepsTheEnergy) {
  Scene s = graded(plies(0.3));
  Random random(1);
  for (PlyBody& ply : s.plies)
    for (Vec3& v : ply.velocity)
      v = 100.0 * random_vector(random);
  ThreadPool pool(1);
  start(s, pool);
  EXPECT_LT(std::abs(balance_after(s, 500)), 0.02); // without mass scaling alike
}

TEST(ElementMassScaling, WeightStaysThatOfTheCloth) {
  const Scene s = graded(plies(0.3));
  const MassLoads loads{{0.0, 0.0, -9810.0}, 0.0};
  for (const PlyBody& ply : s.plies) {
    double weight = 0.0;
    for (std::size_t n = 0; n < ply.x.size(); ++n)
      weight -= ply.mass[n] * acceleration(ply, n, Vec3::Zero(), loads).z();
    const double cloth = ply.membrane.fabric.surface_density * 50.0 * 50.0 * 9810.0;
    EXPECT_NEAR(weight, cloth, 1e-12 * cloth);
  }
}

TEST(ElementMassScaling, CountsElementByElementInThePredictedInertia) {
  EXPECT_EQ(effective_mass_factor(graded(plies(0.0))), 1.0);
  const Scene s = graded(plies(0.3));
  double most = 1.0;
  for (const PlyBody& ply : s.plies)
    for (const double factor : ply.membrane.density_factor)
      most = std::max(most, factor);
  EXPECT_GT(effective_mass_factor(s), 1.3); // the mean
  EXPECT_LT(effective_mass_factor(s), most);
}

TEST(ElementMassScaling, WorksUnderAToolThatHasAMass) {
  constexpr double kilogram = 1e-3; // t
  Scene with = graded(pressed(0.3, kilogram)), without = graded(pressed(0.0, kilogram));
  EXPECT_GT(stable_dt(with), 1.3 * stable_dt(without));
  EXPECT_LT(std::abs(balance_after(with, 1500)), 0.005);
  EXPECT_EQ(with.largest_added_mass, 0.0); // contacts get none there
  EXPECT_NEAR(largest_share(with), 0.3, 1e-12);
  const auto told = [](const Case& data) { // that contacts get none
    const std::vector<std::string> lines = assumptions(data);
    return std::any_of(lines.begin(), lines.end(), [](const std::string& line) {
      return line.find("tool plate has a mass") != std::string::npos;
    });
  };
  EXPECT_TRUE(told(pressed(0.3, kilogram)));
  EXPECT_FALSE(told(pressed(0.3, 0.0)));
}

TEST(ElementMassScaling, LoadedSceneGoesOnTheSameWay) {
  const Case data = pressed(0.3, 0.0);
  Scene scene = graded(data), loaded = graded(data);
  ThreadPool pool(1);
  start(scene, pool);
  const auto go = [&pool](Scene& s) {
    for (int step = 0; step < 120; ++step) {
      ASSERT_FALSE(compute_forces(s, pool));
      move_plies(s, pool);
    }
  };
  go(scene);
  RunState run;
  load_state(save_state(scene, run), loaded, run);
  go(scene), go(loaded);
  for (std::size_t p = 0; p < scene.plies.size(); ++p)
    EXPECT_EQ(scene.plies[p].x, loaded.plies[p].x);
}

TEST(ElementMassScaling, ARunTellsTheShare) {
  Case data = plies(0.1);
  data.solver.duration = 1e-4;
  const RunResult run =
      run_case(data, 1, {}, std::vector<BlankMesh>(data.plies.size(), graded_mesh()));
  EXPECT_NEAR(run.summary.element_added_mass, 0.1, 1e-12);
}

} // namespace
} // namespace plyform::element_mass_scaling_test
