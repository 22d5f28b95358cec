// SPDX-License-Identifier: GPL-3.0-or-later
// The stress table: where methods fail, the element and the step are right or stop with a clear
// message. Longer rows: stress_long_test.cpp. The figures stand in
// docs/verification/closed_forms.md.
#include "core/identify/shear_tests.hpp"
#include "support/stress_scenes.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace plyform::stress_table_test {
namespace {

constexpr double side = 100.0; // mm

/// Meshes of a square: aspect ratio 20, slivers of 5 degrees, moved nodes.
std::vector<BlankMesh> bad_meshes() {
  Random random(21);
  return {stretched_cells(side, 2, 40), stretched_cells(side, 40, 2), slivers(side, 4),
          irregular_mesh(random)};
}

TEST(Stress, MeshesAreAsBadAsTheyClaim) {
  const double wanted = std::atan(1.0 / 20.0) / degree;
  EXPECT_NEAR(smallest_angle(stretched_cells(side, 2, 40)), wanted, 1e-9);
  EXPECT_NEAR(smallest_angle(stretched_cells(side, 40, 2)), wanted, 1e-9);
  EXPECT_NEAR(smallest_angle(slivers(side, 4)), 5.0, 1e-9);
}

/// Stretches and angles between the yarns (degrees): taut, sheared to 80 degrees and beyond a right
/// angle, both, pressed, folded.
const std::vector<YarnState> states{
    {1.003, 1.0, -1.0, 0.3},          {1.0, 1.002, -1.0, 0.3},
    {1.0, 1.0, 20.0 * degree, -0.7},  {1.0, 1.0, 10.0 * degree, 2.0},
    {1.0, 1.0, 165.0 * degree, 0.0},  {1.002, 1.003, 40.0 * degree, 1.0},
    {0.8, 1.001, 80.0 * degree, 0.5}, {0.4, 0.9, -1.0, 0.1}};

struct UniformErrors {
  double energy = 0.0, force = 0.0; ///< over the larger of the answer and 1 N mm, 1 N
};

void judge_uniform(const NamedFabric& f, const BlankMesh& mesh, ElementKind kind, double angle,
                   YarnState state, UniformErrors& worst) {
  if (state.omega < 0.0) state.omega = f.fabric.families[1].angle;
  Membrane m = make_membrane(mesh, f.fabric, angle, kind);
  const Eigen::Matrix2d map = map_to(state, angle, f.fabric.families[1].angle);
  const UniformAnswer answer = uniform_answer(f.fabric, angle, state);
  std::vector<Vec3> x;
  for (const Vec2& p : mesh.x)
    x.emplace_back((map * p).x(), (map * p).y(), 0.0);
  double area = 0.0;
  for (const double a : m.area)
    area += a;
  const MembraneEnergy e = membrane_energy(m, x);
  const double d = std::max(f.fabric.families[0].density, f.fabric.families[1].density);
  const double yarns =
      d * std::max(f.fabric.families[0].tension.stiffness, f.fabric.families[1].tension.stiffness);
  // Coordinates round to 1e-14 mm and strains, on sides down to 1 mm, to 1e-13.
  const double rounding = 1e-12 * yarns;
  EXPECT_NEAR(e.fibre, area * answer.fibre, 1e-9 * area * answer.fibre + rounding) << f.name;
  EXPECT_NEAR(e.shear, area * answer.shear, 1e-9 * area * answer.shear + 1e-15) << f.name;
  worst.energy =
      std::max(worst.energy, std::abs(e.fibre + e.shear - area * (answer.fibre + answer.shear)) /
                                 std::max(1.0, area * (answer.fibre + answer.shear)));
  const std::vector<Vec3> force = nodal_forces(m, x);
  const std::vector<Vec2> normal = outward(mesh);
  const double scale = answer.stress.norm() * side;
  for (std::size_t n = 0; n < x.size(); ++n) {
    const Vec2 wanted = -answer.stress * normal[n];
    const double off = (force[n].head<2>() - wanted).norm();
    EXPECT_LE(off, 1e-9 * scale + rounding * side) << f.name << ", node " << n;
    worst.force = std::max(worst.force, off / std::max(1.0, scale));
    EXPECT_EQ(force[n].z(), 0.0);
  }
}

TEST(Stress, UniformStatesAreExactOnEveryMeshWithEveryFabric) {
  UniformErrors worst;
  for (const NamedFabric& f : extreme_fabrics())
    for (const BlankMesh& mesh : bad_meshes())
      for (const ElementKind kind : {ElementKind::plain, ElementKind::averaged})
        for (const double angle : {0.0, 0.7})
          for (const YarnState& state : states)
            judge_uniform(f, mesh, kind, angle, state, worst);
  fmt::print("energy off by {:.1e}, nodal forces by {:.1e}\n", worst.energy, worst.force);
}

TEST(Stress, StiffYarnsDoNotStiffenWhatHoldsPairs) {
  const BlankMesh mesh = slivers(side, 4);
  for (const NamedFabric& f : extreme_fabrics()) {
    const Membrane m = make_membrane(mesh, f.fabric, 0.7, ElementKind::averaged);
    const double secant = f.fabric.crossings[0].shear.at(0.5).value / 0.5; // N mm
    const double of_shear = m.crossings[0].cells * 8.0 * secant / f.fabric.families[0].density;
    const double of_yarns = 1e-6 * f.fabric.families[0].tension.stiffness;
    const double wanted = secant > 0.0 ? std::min(0.1 * of_shear, of_yarns) : of_yarns;
    EXPECT_NEAR(m.families[0].side.stabilisation, wanted, 1e-12 * wanted) << f.name;
  }
}

// ---- picture frame, by the path of every case ----

struct FrameTest {
  Fabric fabric = glass_weave();
  double side = stress_side, to = 70.0 * degree; ///< mm, rad: shear angle at the end
  double softening = 1e4, duration = 4.5;        ///< -, s: hardly any inertia
  ElementKind element = ElementKind::automatic;
  static constexpr double stress_side = 100.0;
};

/// A rhombus of yarns along its bars, sheared by its frame; hinges 0 and 2 move apart.
Case frame_case(const FrameTest& t, const BlankSpec& blank) {
  Case data = stack_of({0.0}, blank);
  data.fabrics = {t.fabric};
  const double omega0 = t.fabric.families[1].angle, a = t.side;
  const Vec2 u(a, 0.0), v(a * std::cos(omega0), a * std::sin(omega0)), middle = 0.5 * (u + v);
  HingedFrame f;
  f.hinges = {Vec2(-middle), Vec2(u - middle), Vec2(u + v - middle), Vec2(v - middle)};
  f.stroke = 2.0 * a * (std::cos(0.5 * (omega0 - t.to)) - std::cos(0.5 * omega0));
  data.boundaries = {{"frame", -1, f}};
  set_friction(data, 0.0);
  data.solver.element = t.element;
  data.solver.fibre_softening = t.softening;
  data.solver.duration = t.duration;
  return data;
}

/// The rhombus in cells.
BlankSpec rhombus(const FrameTest& t, double size) {
  BlankSpec blank;
  const HingedFrame f = frame_case(t, blank).boundaries[0].as<HingedFrame>();
  blank.outline.boundary = {f.hinges.begin(), f.hinges.end()};
  blank.mesh = MeshKind::fibres;
  blank.element_size = size;
  return blank;
}

struct FrameFound {
  RunResult run;
  double load = 0.0, strain = 0.0, angle = 0.0, force = 0.0; ///< errors: relative, -, rad; N
  int judged = 0;
};

/// Runs it and judges each state past 10 degrees: load over A n_c Cs dgamma/dd, which is (41) for
/// yarns at a right angle; shear angle of every triangle; strain of yarns.
FrameFound run_frame(const FrameTest& t, const BlankSpec& blank) {
  const double omega0 = t.fabric.families[1].angle, a = t.side;
  FrameFound found;
  int judged = 0;
  RunHooks hooks;
  const auto worst = [](double& sum, double off) {
    if (!(std::abs(off) <= sum)) sum = std::abs(off); // NaN stays
  };
  hooks.frame = [&](const Frame& frame) {
    const double D = 2.0 * a * std::cos(0.5 * omega0) + frame.boundaries.at(0).stroke_mm;
    const double omega = 2.0 * std::acos(0.5 * D / a), gamma = omega0 - omega;
    const PlyFrame& ply = frame.plies[0];
    for (std::size_t e = 0; e < ply.triangles.size(); ++e) {
      worst(found.strain,
            std::max(std::abs(ply.families[0].strain[e]), std::abs(ply.families[1].strain[e])));
      worst(found.angle, ply.shear_deg[e] * degree - gamma);
    }
    worst(found.force, frame.boundaries[0].force_N);
    if (std::abs(gamma) < 10.0 * degree) return;
    ++judged;
    const double cells =
        t.fabric.families[0].density * t.fabric.families[1].density * std::sin(omega0);
    const double wanted = cells * a * a * std::sin(omega0) *
                          t.fabric.crossings[0].shear.at(gamma).value / (a * std::sin(0.5 * omega));
    if (wanted != 0.0) worst(found.load, frame.boundaries[0].force_N / wanted - 1.0);
  };
  found.run = run_case(frame_case(t, blank), 1, hooks);
  found.judged = judged;
  return found;
}

void expect_sound(const FrameFound& f, const std::string& what, double load = 0.01) {
  EXPECT_TRUE(ended(f.run.summary.status)) << what << ": " << f.run.summary.message;
  EXPECT_GE(f.judged, 5) << what;
  EXPECT_LT(f.load, load) << what;
  EXPECT_LT(f.strain, 1e-3) << what;
  EXPECT_LT(f.angle, 1e-3) << what;
  EXPECT_LE(imbalance(f.run.last.energy), 0.01) << what;
  fmt::print(
      "{}: load {:.1e}, strain {:.1e}, angle {:.1e} rad, balance {:.1e}, {} steps, {:.1f} s\n",
      what, f.load, f.strain, f.angle, f.run.last.energy.balance_error(), f.run.summary.steps,
      f.run.summary.wall_time_s);
}

TEST(Stress, FrameHasItsLoadAtSeventyAndEightyDegrees) {
  for (const ElementKind element : {ElementKind::plain, ElementKind::averaged})
    for (const double to : {70.0, 80.0, -80.0}) {
      FrameTest t;
      t.element = element;
      t.to = to * degree;
      const bool averaged = element == ElementKind::averaged;
      expect_sound(run_frame(t, rhombus(t, 25.0)),
                   fmt::format("{} degrees, {}", to, averaged ? "averaged" : "plain"));
    }
}

TEST(Stress, FrameHasItsLoadWithEveryFabric) {
  for (const NamedFabric& f : extreme_fabrics())
    for (const ElementKind element : {ElementKind::plain, ElementKind::averaged}) {
      FrameTest t;
      t.fabric = f.fabric;
      t.element = element;
      t.to = f.fabric.families[1].angle - 25.0 * degree;
      t.softening = 1e4 * std::max(1.0, f.fabric.families[0].tension.stiffness / 46000.0);
      if (t.to > 80.0 * degree) t.softening = 1000.0; // or the yarns are too soft for its torque
      const bool averaged = element == ElementKind::averaged;
      const FrameFound found = run_frame(t, rhombus(t, 25.0));
      expect_sound(found, f.name + (averaged ? ", averaged" : ", plain"));
      if (f.fabric.crossings[0].shear.k[0] == 0.0) {
        EXPECT_LT(found.force, 1e-4) << "N";
      }
    }
}

void judge_bad_mesh(const std::string& name, const BlankMesh& mesh) {
  const std::filesystem::path file = scratch("bad.obj");
  const BlankSpec blank = blank_of(mesh, file);
  for (const ElementKind element : {ElementKind::plain, ElementKind::averaged}) {
    FrameTest t;
    t.element = element;
    t.softening = 2000.0; // with 1e4 the yarns are too soft to keep a fine mesh from buckling
    t.duration = 0.4;
    expect_sound(run_frame(t, blank),
                 name + (element == ElementKind::averaged ? ", averaged" : ", plain"));
  }
  std::filesystem::remove(file);
}

TEST(Stress, FrameHasItsLoadAtAspectRatioTwenty) {
  judge_bad_mesh("aspect ratio 20", stretched_cells(side, 2, 40));
}

TEST(Stress, FrameHasItsLoadOnSlivers) {
  judge_bad_mesh("slivers", slivers(side, 4));
}

// ---- where a triangle loses its meaning ----

TEST(Stress, StopsWhenWarpAndWeftCoincide) {
  for (const double duration : {5.0, 0.02})
    for (const double to : {89.9, -89.9}) {
      FrameTest t;
      t.to = to * degree;
      t.duration = duration;
      expect_collapse(run_frame(t, rhombus(t, 25.0)).run, fmt::format("{} in {} s", to, duration));
    }
  FrameTest t;
  t.fabric.families[1].angle = 120.0 * degree;
  t.to = -59.9 * degree; // to 180 degrees between them
  expect_collapse(run_frame(t, rhombus(t, 25.0)).run, "yarns that come to point at each other");
}

/// One square; three corners held, the fourth driven across the diagonal between its neighbours to
/// near the first: one triangle ends upside down, with its yarns nearly as before.
Case turned_over(double size, double duration) {
  BlankMesh mesh;
  const double h = 0.5 * size;
  mesh.x = {{-h, -h}, {h, -h}, {h, h}, {-h, h}};
  mesh.triangles = {{0, 1, 3}, {1, 2, 3}};
  Case data = stack_of({0.0}, blank_of(mesh, scratch("square.obj")));
  data.boundaries = {hold("first", {-h, -h}, {-h, -h}, Vec3::UnitX(), 0.0),
                     hold("second", {h, -h}, {h, -h}, Vec3::UnitX(), 0.0),
                     hold("third", {-h, h}, {-h, h}, Vec3::UnitX(), 0.0),
                     hold("fourth", {h, h}, {h, h}, Vec3(-0.6, -0.8, 0.0), 1.3 * size)};
  set_friction(data, 0.0);
  data.solver.fibre_softening = 1e4;
  data.solver.duration = duration;
  data.solver.max_balance_error = 1.0; // is not what is to stop it
  return data;
}

TEST(Stress, StopsWhenATriangleTurnsOver) {
  for (const double size : {10.0, 1.0, 0.1}) // mm; small ones are thin for few steps
    for (const double duration : {1.0, 0.02})
      expect_collapse(run_case(turned_over(size, duration), 1, {}),
                      fmt::format("{} mm in {} s", size, duration));
  std::filesystem::remove(scratch("square.obj"));
}

TEST(Stress, StopsWhenAStripIsPushedThroughItself) {
  for (const double duration : {1.0, 0.02}) {
    Case data = stack_of({0.0}, rectangle(10.0, 10.0, 10.0));
    data.boundaries = {hold("left", {-5, -5}, {-5, 5}, Vec3::UnitX(), 0.0),
                       hold("right", {5, -5}, {5, 5}, -Vec3::UnitX(), 20.0)};
    set_friction(data, 0.0);
    data.solver.fibre_softening = 1e4;
    data.solver.duration = duration;
    data.solver.max_balance_error = 1.0; // the guard alone makes up the ledger, from nothing
    expect_collapse(run_case(data, 1, {}), fmt::format("in {} s", duration));
  }
}

} // namespace
} // namespace plyform::stress_table_test
