// SPDX-License-Identifier: GPL-3.0-or-later
// Pressures as a kind of force: forces, work, bound, what is kept.
#include "core/run/checkpoint.hpp"
#include "core/solver/force_kinds.hpp"
#include "core/solver/step.hpp"
#include "support/scene_checks.hpp"

#include <Eigen/Eigenvalues>
#include <functional>
#include <gtest/gtest.h>
#include <map>
#include <numbers>

namespace plyform::pressure_forces_test {
namespace {

/// Two plies, a pressure below the upper one; nodes are where `move` takes them.
Case pressed(MeshKind mesh, const std::vector<Stage>& programme = {}) {
  Case data = stack_of({0.0, 0.3}, rectangle(40.0, 30.0, 10.0, mesh));
  data.plies[1].z += 50.0;
  set_friction(data, 0.2);
  data.solver.duration = 0.01;
  data.loads = {{1, PlyFace::below, 0.02, programme}};
  return data;
}

/// Out of plane and in it, by millimetres.
void deform(PlyBody& ply) {
  for (Vec3& x : ply.x)
    x += Vec3(0.05 * x.y(), std::sin(0.1 * x.x()), 2.0 * std::cos(0.07 * x.x() + 0.1 * x.y()));
}

std::vector<Vec3> load_on(Scene& s, std::size_t ply) {
  for (int task = 0; task < s.PressureForces::tasks(s); ++task)
    s.PressureForces::run(s, task);
  return s.plies[ply].load;
}

/// Volume between a ply and the origin's plane, by cones.
double volume(const PlyBody& ply) {
  double sum = 0.0;
  for (const Triangle& t : ply.membrane.triangles)
    sum += ply.x[at(t[0])].dot(ply.x[at(t[1])].cross(ply.x[at(t[2])])) / 6.0;
  return sum;
}

TEST(PressureForces, AreUpwardsFromBelowOnMeshesOfAnyKind) {
  for (const MeshKind mesh : {MeshKind::diagonal, MeshKind::alternating, MeshKind::crossed,
                              MeshKind::fibres, MeshKind::free})
    for (const PlyFace side : {PlyFace::below, PlyFace::above}) {
      Case data = pressed(mesh);
      data.loads[0].side = side;
      Scene s = make_scene(data);
      s.time = 1.0; // long after the programme
      Vec3 sum = Vec3::Zero();
      for (const Vec3& f : load_on(s, 1))
        sum += f;
      const double whole = 0.02 * 40.0 * 30.0;
      EXPECT_NEAR(sum.z(), side == PlyFace::below ? whole : -whole, 1e-12 * whole);
      EXPECT_LT(sum.head<2>().norm(), 1e-12 * whole);
      EXPECT_TRUE(s.plies[0].load.empty()); // not the other ply
    }
}

TEST(PressureForces, AreTheSlopeOfPressureTimesVolumeInside) {
  Scene s = make_scene(pressed(MeshKind::free));
  s.time = 1.0;
  PlyBody& ply = s.plies[1];
  deform(ply);
  const std::vector<Vec3> force = load_on(s, 1);
  const double h = 1e-4;
  int inside = 0;
  for (std::size_t n = 0; n < ply.x.size(); ++n) {
    const Vec2 at0 = ply.x0[n].head<2>();
    if (std::abs(at0.x()) > 19.9 || std::abs(at0.y()) > 14.9) continue; // cones have sides
    ++inside;
    for (int k = 0; k < 3; ++k) {
      const double x = ply.x[n][k];
      ply.x[n][k] = x + h;
      const double more = volume(ply);
      ply.x[n][k] = x - h;
      const double less = volume(ply);
      ply.x[n][k] = x;
      EXPECT_NEAR(force[n][k], 0.02 * (more - less) / (2.0 * h), 1e-8);
    }
  }
  EXPECT_GT(inside, 3);
}

/// Integral of x cross dx / 2 along all sides that one triangle only has: outline and holes.
Vec3 area_in_rim(const PlyBody& ply) {
  std::map<std::pair<int, int>, int> sides;
  for (const Triangle& t : ply.membrane.triangles)
    for (std::size_t i = 0; i < 3; ++i)
      ++sides[{t[i], t[(i + 1) % 3]}];
  Vec3 sum = Vec3::Zero();
  for (const auto& [side, count] : sides)
    if (!sides.contains({side.second, side.first}))
      sum += 0.5 * ply.x[at(side.first)].cross(ply.x[at(side.second)]);
  return sum;
}

/// Cut out, with a round and a square hole.
BlankSpec perforated() {
  BlankSpec blank = rectangle(80.0, 60.0, 5.0, MeshKind::free);
  blank.outline.boundary = {{-40, -30}, {40, -30}, {40, 5}, {10, 5}, {10, 30}, {-40, 30}};
  blank.outline.holes.resize(2);
  for (int i = 0; i < 16; ++i) {
    const double turn = std::numbers::pi / 8.0 * i;
    blank.outline.holes[0].emplace_back(8.0 * std::cos(turn) - 20.0, 8.0 * std::sin(turn));
  }
  blank.outline.holes[1] = {{20, -20}, {30, -20}, {30, -10}, {20, -10}};
  return blank;
}

TEST(PressureForces, SumToTheAreaInTheRimOfAnySheet) {
  const std::map<std::string, std::function<Vec3(const Vec3&)>> shapes{
      {"flat", [](const Vec3& x) { return x; }},
      {"bent", [](const Vec3& x) { return Vec3(x.x(), x.y(), 0.02 * x.x() * x.y()); }},
      {"rolled up",
       [](const Vec3& x) {
         const double r = 6.0 + 0.05 * x.x(), a = x.x() / 6.0;
         return Vec3(r * std::sin(a), x.y(), r * std::cos(a));
       }},
      {"folded over",
       [](const Vec3& x) {
         return Vec3(std::abs(x.x() + 0.3 * x.y()), x.y(), x.x() < 0.0 ? 0.0 : 1.0);
       }},
      {"crumpled",
       [](const Vec3& x) {
         return Vec3(
             x + 4.0 * Vec3(std::sin(x.y()), std::sin(2.0 * x.x()), std::sin(x.x() + 3.0 * x.y())));
       }},
      {"far from the origin and upside down", [](const Vec3& x) {
         const Eigen::AngleAxisd turn(std::numbers::pi, Vec3(1, 0.2, 0).normalized());
         return Vec3(turn * Vec3(x.x(), x.y(), std::sin(0.1 * x.x())) + Vec3(50, -70, 30));
       }}};
  for (const auto& [name, shape] : shapes) {
    Case data = pressed(MeshKind::free);
    data.blanks = {perforated()};
    Scene s = make_scene(data);
    s.time = 1.0;
    PlyBody& ply = s.plies[1];
    for (std::size_t n = 0; n < ply.x.size(); ++n)
      ply.x[n] = shape(ply.x0[n] - Vec3::UnitZ() * ply.x0[n].z());
    Vec3 sum = Vec3::Zero();
    double all = 0.0;
    for (const Vec3& f : load_on(s, 1))
      sum += f, all += f.norm();
    const Vec3 exact = 0.02 * area_in_rim(ply);
    EXPECT_LT((sum - exact).norm(), 1e-12 * all) << name;
    EXPECT_GT(exact.norm(), 1e-3 * all) << name; // not a sum of nothing
  }
}

TEST(PressureForces, FollowTheirProgrammeAndAddUpOverBothFaces) {
  Case data = pressed(MeshKind::diagonal, {{0.5, 0.02}, {1.0, 0.01}});
  data.loads.push_back({1, PlyFace::above, 0.004, {}}); // rises over the duration
  Scene s = make_scene(data);
  const auto up = [&](double share) {
    s.time = share * s.data.solver.duration;
    double sum = 0.0;
    for (const Vec3& f : load_on(s, 1))
      sum += f.z();
    return sum / (40.0 * 30.0);
  };
  EXPECT_EQ(up(0.0), 0.0);
  EXPECT_NEAR(up(0.25), 0.01 - 0.004 * (0.25 - 0.125) / 0.75, 1e-12);
  EXPECT_NEAR(up(0.5), 0.02 - 0.002, 1e-12);
  EXPECT_NEAR(up(1.0), 0.01 - 0.004, 1e-12);
  EXPECT_NEAR(up(5.0), 0.01 - 0.004, 1e-12);
}

/// K of the pressure by differences of its forces, N/mm.
Eigen::MatrixXd stiffness(Scene& s, std::size_t p) {
  PlyBody& ply = s.plies[p];
  const auto size = static_cast<Eigen::Index>(3 * ply.x.size());
  Eigen::MatrixXd k(size, size);
  const double h = 1e-3; // forces are quadratic: central differences are exact
  for (Eigen::Index j = 0; j < size; ++j) {
    double& x = ply.x[static_cast<std::size_t>(j / 3)][j % 3];
    const double before = x;
    x = before + h;
    const std::vector<Vec3> more = load_on(s, p);
    x = before - h;
    const std::vector<Vec3> less = load_on(s, p);
    x = before;
    for (Eigen::Index i = 0; i < size; ++i) {
      const auto n = static_cast<std::size_t>(i / 3);
      k(i, j) = -(more[n][i % 3] - less[n][i % 3]) / (2.0 * h);
    }
  }
  return k;
}

TEST(PressureForces, BoundHoldsForTheirStiffness) {
  Scene s = make_scene(pressed(MeshKind::alternating));
  s.time = 1.0;
  deform(s.plies[1]);
  const PlyBody& ply = s.plies[1];
  Eigen::MatrixXd k = stiffness(s, 1);
  for (Eigen::Index i = 0; i < k.rows(); ++i)
    k.row(i) /= ply.mass[static_cast<std::size_t>(i / 3)];
  const double radius = k.eigenvalues().cwiseAbs().maxCoeff();
  std::vector<ContactRow> rows(ply.x.size());
  s.PressureForces::add_rows(s, 1, rows);
  double bound = 0.0;
  for (std::size_t n = 0; n < rows.size(); ++n)
    bound = std::max(bound, rows[n].stiffness / ply.mass[n]);
  EXPECT_GT(radius, 0.0);
  EXPECT_LE(radius, bound);
  EXPECT_LT(bound, 10.0 * radius); // no bound of anything
  s.time = 0.0;                    // of what comes, too
  std::vector<ContactRow> ahead(ply.x.size());
  s.PressureForces::add_rows(s, 1, ahead);
  EXPECT_EQ(ahead[0].stiffness, rows[0].stiffness);
  // the product with K has the bound in its place
  PressureProduct product(s, s, {2.0, 0.0});
  PerPly y(2), f(2);
  y[1].assign(ply.x.size(), Vec3(1.0, -2.0, 3.0));
  f[0].assign(s.plies[0].x.size(), Vec3::Zero()), f[1].assign(ply.x.size(), Vec3::Zero());
  y[0] = f[0];
  product.add_on_ply(0, y, f), product.add_on_ply(1, y, f);
  EXPECT_TRUE(f[0][0].isZero(0.0));
  EXPECT_LT((f[1][2] - 2.0 * rows[2].stiffness * y[1][2]).norm(), 1e-12 * f[1][2].norm());
}

/// Steps a scene to its end; work of the pressure.
double work_at_end(Scene& s, ThreadPool& pool, double end) {
  while (s.time < end) {
    EXPECT_FALSE(compute_forces(s, pool));
    move_plies(s, pool);
  }
  EXPECT_FALSE(compute_forces(s, pool));
  return current_energies(s, pool).external;
}

TEST(PressureForces, WorkIsWhatThePlyGains) {
  Case data = pressed(MeshKind::alternating, {{0.3, 0.02}});
  data.loads[0].pressure = data.loads[0].programme[0].value = 1e-4;
  Scene s = make_scene(data);
  ThreadPool pool(1);
  start(s, pool);
  const double work = work_at_end(s, pool, 0.01);
  const Energies e = current_energies(s, pool);
  EXPECT_GT(work, 0.0);
  EXPECT_NEAR(e.residual(), 0.0, 1e-6 * work); // all plies are free: it is kinetic
  EXPECT_NEAR(e.kinetic, work, 1e-2 * work);
  EXPECT_EQ(s.plies[0].x, s.plies[0].x0);
  s.PressureForces::run(s, 1); // asked twice it is the same
  EXPECT_EQ(current_energies(s, pool).external, work);
}

TEST(PressureForces, GoOnFromACheckpointAndGoBack) {
  const Case data = pressed(MeshKind::alternating);
  ThreadPool pool(1);
  Scene scene = make_scene(data);
  start(scene, pool);
  work_at_end(scene, pool, 0.004);
  move_plies(scene, pool);
  RunState run;
  Snapshot good;
  keep(scene, current_energies(scene, pool), good);
  const std::string saved = save_state(scene, run);
  const double then = scene.plies[1].load_work;
  EXPECT_GT(then, 0.0);
  Scene loaded = make_scene(data);
  load_state(saved, loaded, run);
  EXPECT_EQ(work_at_end(loaded, pool, 0.008), work_at_end(scene, pool, 0.008));
  EXPECT_EQ(loaded.plies[1].x, scene.plies[1].x);
  EXPECT_EQ(state_hash(loaded), state_hash(scene));
  EXPECT_GT(scene.plies[1].load_work, then);
  restore(scene, good);
  EXPECT_EQ(scene.plies[1].load_work, then);
}

TEST(PressureForces, SayWhatTheyAreBeforeARun) {
  const Scene s = make_scene(pressed(MeshKind::diagonal, {{0.5, 0.02}}));
  std::vector<std::string> lines;
  s.PressureForces::describe(s, lines);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0], "pressure below ply ply2: 0.02 N/mm2 at most, 24 N on it as it lies");
}

TEST(PressureForces, MoveAPlyThatNothingElseWould) {
  Case data = pressed(MeshKind::diagonal);
  data.plies[1].z = 5000.0; // far from the other, which a grip draws
  Grip grip;
  grip.place = {false, {Vec2(-20.0, -15.0), Vec2(-20.0, 15.0)}}, grip.stroke = 1.0;
  data.boundaries = {{"grip", 0, grip}};
  data.loads[0].pressure = 1e-6;
  Scene s = make_scene(data);
  EXPECT_FALSE(s.plies[1].left_alone);
  data.loads.clear();
  EXPECT_TRUE(make_scene(data).plies[1].left_alone);
}

} // namespace
} // namespace plyform::pressure_forces_test
