// SPDX-License-Identifier: GPL-3.0-or-later
// Faces that slide on a film, against what follows from its law (contact/forces/friction_law.hpp):
//   pull-out: a ply between two others under a force F on its area A, drawn at a speed v of the
//     process: 2 F mu(eta v A / F), at any pressure and speed on one curve
//   a ply on a table that gravity g drives along it: v = v_e (1 - exp(-t / theta)), with
//     theta = rho_A h / eta and v_e = g theta (Couette)
#include "core/model/motion.hpp"
#include "core/model/temperature.hpp"
#include "support/kill_checks.hpp"
#include "support/stress_scenes.hpp"

#include <cmath>
#include <numbers>

namespace plyform::film_friction_test {
namespace {

using Kind = FrictionLawSpec::Kind;

constexpr double length = 40.0, width = 20.0, cell = 5.0; // mm
constexpr double area = length * width;

FrictionLawSpec curve() {
  FrictionLawSpec spec;
  spec.name = "melt", spec.kind = Kind::hersey;
  spec.viscosity = 6e-4; // 600 Pa s
  spec.curve = {{1e-3, 0.08}, {1e-2, 0.2}, {1e-1, 0.5}, {1.0, 1.2}};
  return spec;
}

FrictionLawSpec film(double viscosity, double thickness) {
  FrictionLawSpec spec;
  spec.name = "film", spec.kind = Kind::film;
  spec.viscosity = viscosity, spec.film = thickness;
  return spec;
}

/// A melt that is half as stiff at 200 degC as at 180.
constexpr double reference = 180.0; // degC
FilmFlow melt() {
  const TemperatureFactor law = WlfFactor{3.0, 179.3, reference};
  const TemperatureRange known = law.range();
  return {[law](double celsius) { return law.at(celsius); }, known.least, known.most};
}

/// Gives all plies that friction on each other, and tools none; or to a single ply on tools.
void slide_on(Case& data, FrictionLawSpec spec) {
  set_friction(data, 0.0);
  const int plies = static_cast<int>(data.plies.size()), n = data.friction.bodies;
  data.friction_laws = {std::make_shared<FrictionLaw>(std::move(spec))};
  data.friction.law.assign(static_cast<std::size_t>(n * n), -1);
  for (int a = 0; a < n; ++a)
    for (int b = 0; b < n; ++b)
      if (plies == 1 || (a < plies && b < plies))
        data.friction.law[static_cast<std::size_t>(a * n + b)] = 0;
}

Boundary grip(int ply, double x, double half_width, double stroke) {
  Boundary b =
      hold("grip" + std::to_string(ply), {x, -half_width}, {x, half_width}, Vec3::UnitX(), stroke);
  b.ply = ply;
  b.as<Grip>().held = {true, true, false};
  return b;
}

/// The middle one of three plies, the others larger, drawn 12 mm under a plate.
Case pull_out(double pressure, double process_s) {
  Case data = stack_of({0.0, 0.0, 0.0}, rectangle(80.0, 30.0, cell));
  data.blanks.push_back(rectangle(length, width, cell));
  data.plies[1].blank = 1;
  press_by_plate(data);
  data.tools[1].force = pressure * area;
  data.boundaries = {grip(1, 0.5 * length, 0.5 * width, 12.0), grip(0, -40.0, 15.0, 0.0),
                     grip(2, -40.0, 15.0, 0.0)};
  slide_on(data, curve());
  data.process.duration = process_s;
  data.solver.mass_damping = 0.0;
  data.solver.fibre_damping = 0.5;
  data.solver.duration = 0.06;
  data.solver.outputs = 80;
  return data;
}

/// A ply between a table and a plate, drawn likewise.
Case between_plates(double pressure, double process_s) {
  Case data = pull_out(pressure, process_s);
  const Case one = stack_of({0.0}, rectangle(length, width, cell));
  data.plies = one.plies, data.blanks = one.blanks;
  const double force = data.tools[1].force;
  press_by_plate(data);
  data.tools[1].force = force;
  data.boundaries = {grip(0, 0.5 * length, 0.5 * width, 12.0)};
  slide_on(data, curve());
  data.solver.mass_damping = 0.0;
  data.solver.duration = 0.06;
  return data;
}

/// N, mean and largest deviation from it while the speed is constant.
struct Pull {
  double mean = 0.0, off = 0.0;
  Energies energy;
};

Pull pull_of(const Case& data) {
  std::vector<double> force;
  RunHooks hooks;
  hooks.frame = [&](const Frame& f) {
    const double share = f.time / data.solver.duration;
    if (share > 0.4 && share < 0.72) force.push_back(f.boundaries.at(0).force_N);
  };
  Scene scene = make_scene(data);
  const RunResult run = run_scene(scene, 1, hooks);
  EXPECT_TRUE(ended(run.summary.status)) << run.summary.message;
  Pull pull;
  for (const double f : force)
    pull.mean += f / static_cast<double>(force.size());
  for (const double f : force)
    pull.off = std::max(pull.off, std::abs(f - pull.mean));
  pull.energy = run.last.energy;
  EXPECT_LE(imbalance(pull.energy), 0.01);
  const bool viscous = data.friction_laws[0]->has_rates();
  EXPECT_GT(viscous ? pull.energy.film : pull.energy.friction, 0.5 * pull.energy.external);
  EXPECT_EQ(viscous ? pull.energy.friction : pull.energy.film, 0.0);
  return pull;
}

TEST(FilmFriction, PullOutAtAnyPressureAndSpeedLiesOnOneCurve) {
  for (const double pressure : {0.02, 0.1, 0.5})
    for (const double process_s : {1.0, 10.0, 100.0}) {
      const Pull pull = pull_of(between_plates(pressure, process_s));
      const double speed = peak_speed_ratio * 12.0 / process_s;
      const double number = 6e-4 * speed / pressure;
      const double wanted = 2.0 * pressure * area * curve().hersey(number);
      EXPECT_NEAR(pull.mean, wanted, 0.01 * wanted) << pressure << " " << process_s;
      fmt::print("{} N/mm2, {:.3g} mm/s: H {:.3g} mm, mu {:.4f}, pull {:+.2f} % off, scatter "
                 "{:.2f} %, balance {:.2f} %\n",
                 pressure, speed, number, pull.mean / (2.0 * pressure * area),
                 100.0 * (pull.mean / wanted - 1.0), 100.0 * pull.off / pull.mean,
                 100.0 * imbalance(pull.energy));
    }
}

/// A ply on a table, driven by gravity along x and pressed by it.
Case driven_ply(const FrictionLawSpec& spec, double gravity) {
  Case data = stack_of({0.0}, rectangle(length, width, cell));
  Tool table;
  table.name = "table", table.shape = Plane{};
  data.tools = {table};
  slide_on(data, spec);
  data.gravity = {gravity, 0.0, -2e5};
  data.solver.fibre_softening = 100.0;
  data.solver.duration = 0.05;
  data.solver.outputs = 50;
  data.process.duration = data.solver.duration;
  return data;
}

TEST(FilmFriction, APlyOnATableSlidesAsCouetteSays) {
  const double h = 0.1, theta = 0.01, gravity = 9810.0;
  const double density = glass_weave().surface_density;
  const Case data = driven_ply(film(density * h / theta, h), gravity);
  double worst = 0.0, last = 0.0;
  RunHooks hooks;
  hooks.frame = [&](const Frame& f) {
    double way = 0.0;
    for (const Vec3& x : f.plies[0].x)
      way += x.x() / static_cast<double>(f.plies[0].x.size());
    const double wanted = gravity * theta * (f.time - theta * (1.0 - std::exp(-f.time / theta)));
    if (f.time > theta) worst = std::max(worst, std::abs(way / wanted - 1.0));
    last = way / wanted - 1.0;
  };
  const EndedRun run = run_on_any_threads([&] { return make_scene(data); }, hooks);
  ASSERT_TRUE(ended(run.result.summary.status)) << run.result.summary.message;
  EXPECT_LE(worst, 0.02);
  EXPECT_LE(imbalance(run.result.last.energy), 0.01);
  fmt::print("way {:.3f} % off at most, {:.3f} % at the end\n", 100.0 * worst, 100.0 * last);
}

/// The upper of two plies, smaller and on a mesh of its own, driven by gravity over one held in its
/// plane; the largest share by which its way is off.
double laminate_off(double upper_cell, double lower_cell, double upper_length) {
  const double h = 0.1, theta = 0.01, gravity = 9810.0;
  const double density = glass_weave().surface_density;
  Case data = stack_of({0.0, 0.0}, rectangle(140.0, 40.0, lower_cell));
  data.blanks.push_back(rectangle(upper_length, 20.0, upper_cell));
  data.plies[1].blank = 1;
  Boundary held = hold("all", {-71.0, -21.0}, {71.0, 21.0}, Vec3::UnitX(), 0.0);
  held.ply = 0;
  data.boundaries = {held};
  slide_on(data, film(density * h / theta, h));
  data.gravity = {gravity, 0.0, -2e5};
  data.solver.fibre_softening = 100.0;
  data.solver.duration = data.process.duration.emplace(0.05);
  data.solver.outputs = 50;
  double worst = 0.0;
  RunHooks hooks;
  hooks.frame = [&](const Frame& f) {
    double way = 0.0;
    for (const Vec3& x : f.plies[1].x)
      way += x.x() / static_cast<double>(f.plies[1].x.size());
    const double wanted = gravity * theta * (f.time - theta * (1.0 - std::exp(-f.time / theta)));
    if (f.time > theta) worst = std::max(worst, std::abs(way / wanted - 1.0));
  };
  const EndedRun run = run_on_any_threads([&] { return make_scene(data); }, hooks);
  EXPECT_TRUE(ended(run.result.summary.status)) << run.result.summary.message;
  return worst;
}

TEST(FilmFriction, ALaminateOfTwoPliesSlidesAsCouetteSays) {
  for (const auto& [upper, lower, upper_length] : {std::array{5.0, 5.0, 120.0}, // mm
                                                   {4.0, 5.0, 116.0},
                                                   {5.0, 4.0, 117.0},
                                                   {2.5, 5.0, 123.0}}) {
    const double worst = laminate_off(upper, lower, upper_length);
    EXPECT_LE(worst, 0.02) << upper << " on " << lower;
    fmt::print("{} on {} mm: way {:.2f} % off at most\n", upper, lower, 100.0 * worst);
  }
}

TEST(FilmFriction, AStiffFilmNeedsNoSmallerStepAndHolds) {
  const auto coulomb = [](double coefficient) {
    FrictionLawSpec spec;
    spec.coefficient = coefficient;
    return spec;
  };
  const auto run_on = [](const FrictionLawSpec& spec) {
    Case data = driven_ply(spec, 9810.0);
    data.solver.duration = data.process.duration.emplace(0.02);
    Scene scene = make_scene(data);
    const RunResult run = run_scene(scene, 1, {});
    EXPECT_TRUE(ended(run.summary.status)) << run.summary.message;
    return std::pair(scene.step, imbalance(run.last.energy));
  };
  const auto [dry_steps, dry_error] = run_on(coulomb(0.01));
  EXPECT_LE(dry_error, 0.01);
  // Where all sticks nothing but the start is in the ledger, whose error of the contact's springs
  // dry friction that holds has, too.
  const double start = run_on(coulomb(10.0)).second;
  for (const double viscosity : {1e-8, 1e-5, 1e-2, 1.0}) { // N s/mm^2: to a million Pa s
    const auto [steps, error] = run_on(film(viscosity, 0.1));
    EXPECT_LE(steps, 1.02 * static_cast<double>(dry_steps)) << viscosity;
    EXPECT_LE(error, std::max(0.01, 1.01 * start)) << viscosity;
    fmt::print("{:g} Pa s: {} steps, balance {:.2f} %; {:.2f} % where dry friction holds\n",
               1e6 * viscosity, steps, 100.0 * error, 100.0 * start);
  }
}

TEST(FilmFriction, AnswersDoNotDependOnTheSimulatedTime) {
  double first = 0.0;
  for (const double duration : {0.12, 0.06, 0.03}) {
    Case data = pull_out(0.1, 10.0);
    data.solver.duration = duration;
    const Pull pull = pull_of(data);
    if (first == 0.0) first = pull.mean;
    EXPECT_NEAR(pull.mean, first, 0.01 * first) << duration;
  }
}

TEST(FilmFriction, ForcesOfAFilmScaleWithTheSpeedOfTheProcess) {
  double first = 0.0;
  for (const double process_s : {1.0, 10.0, 100.0}) {
    Case data = between_plates(0.1, process_s);
    slide_on(data, film(2e-4, 0.1));
    const double pull = pull_of(data).mean * process_s;
    if (first == 0.0) first = pull;
    EXPECT_NEAR(pull, first, 0.01 * first) << process_s;
    EXPECT_NEAR(pull, 2.0 * area * 2e-4 / 0.1 * peak_speed_ratio * 12.0, 0.01 * first);
  }
}

TEST(FilmFriction, DryFrictionGoesByTheAngleBetweenTheFibres) {
  FrictionLawSpec spec;
  spec.coefficient = 0.3;
  spec.over_angle = {{0.0, 1.0}, {0.25 * std::numbers::pi, 0.8}, {0.5 * std::numbers::pi, 0.5}};
  for (const auto& [middle, others, factor] : // rad
       {std::array{0.0, 0.0, 1.0}, std::array{0.5 * std::numbers::pi, 0.0, 0.5},
        std::array{0.0, 0.5 * std::numbers::pi, 0.5}}) {
    Case data = pull_out(0.1, 10.0);
    slide_on(data, spec);
    data.plies[1].angle = middle;
    data.plies[0].angle = data.plies[2].angle = others;
    const double wanted = 2.0 * 0.3 * factor * 0.1 * area;
    EXPECT_NEAR(pull_of(data).mean, wanted, 0.01 * wanted) << middle << " " << others;
  }
}

TEST(FilmFriction, ItsViscosityIsThatOfTheMeanTemperatureOfBothFaces) {
  FrictionLawSpec at_reference = curve(), by_temperature = curve();
  by_temperature.flow = melt();
  struct Place {
    std::string what;
    Case data;
    double middle, outer; // degC
  };
  for (auto& [what, data, middle, outer] : {Place{"tools", between_plates(0.1, 10.0), 200.0, 200.0},
                                            Place{"tools", between_plates(0.1, 10.0), 205.0, 165.0},
                                            Place{"plies", pull_out(0.1, 10.0), 190.0, 210.0}}) {
    const double factor = melt().factor(0.5 * (middle + outer));
    Case warm = data, plain = data;
    slide_on(warm, by_temperature);
    at_reference.viscosity = factor * by_temperature.viscosity;
    slide_on(plain, at_reference);
    warm.process.temperature = outer;
    warm.plies[what == "tools" ? 0 : 1].temperature = middle;
    const double with = pull_of(warm).mean, without = pull_of(plain).mean;
    // 1e-6, but where outer plies touch beyond the middle one, at their own temperature
    EXPECT_NEAR(with, without, (what == "tools" ? 1e-6 : 1e-4) * without) << what;
    fmt::print("{} at {} and {} degC, factor {:.4f}: {:.4f} N for {:.4f} N\n", what, middle, outer,
               factor, with, without);
  }
}

/// A ply drawn on films between tools that cool it from 200 degC.
Case cooling_film(double process_s) {
  constexpr double hot = 200.0, cold = 160.0; // degC
  Case data = between_plates(0.1, process_s);
  FrictionLawSpec spec = film(2e-4, 0.1);
  spec.flow = melt();
  slide_on(data, spec);
  data.fabrics[0].surface_density = 1e-9;
  data.fabrics[0].heat_capacity = 1.2e9;
  data.process.temperature = cold;
  data.plies[0].temperature = hot;
  data.process.cooling = Cooling{0.1, 0.1, 0.02, {{0.0, cold}}};
  return data;
}

TEST(FilmFriction, CoolsAndStiffensAsItsFactorSays) {
  // T = T_c + (T_0 - T_c) e^(-2 h t / C) of the ply; the film is half way to the tools
  const double process_s = 10.0, v = peak_speed_ratio * 12.0 / process_s;
  double worst = 0.0, first = 0.0, last = 0.0;
  for (const double duration : {0.06, 0.03}) {
    Case data = cooling_film(process_s);
    data.solver.duration = duration;
    RunHooks hooks;
    worst = first = 0.0;
    hooks.frame = [&](const Frame& f) {
      const double share = f.time / duration, t = share * process_s;
      if (share < 0.4 || share > 0.72) return;
      const double ply = 160.0 + 40.0 * std::exp(-2.0 * 0.1 * t / 1.2);
      const double wanted = 2.0 * area * 2e-4 / 0.1 * v * melt().factor(0.5 * (160.0 + ply));
      last = f.boundaries.at(0).force_N;
      if (first == 0.0) first = last;
      worst = std::max(worst, std::abs(last / wanted - 1.0));
    };
    const RunResult run = run_case(data, 1, hooks);
    ASSERT_TRUE(ended(run.summary.status)) << run.summary.message;
    EXPECT_LE(worst, 0.01) << duration;
    EXPECT_GT(last, 1.1 * first);
    EXPECT_LE(imbalance(run.last.energy), 0.01);
    fmt::print("{} s simulated: {:.3f} to {:.3f} N, {:.3f} % off at most\n", duration, first, last,
               100.0 * worst);
    ASSERT_FALSE(run.summary.work.pairs.empty());
    for (const PairReport& pair : run.summary.work.pairs)
      if (pair.touched()) {
        ASSERT_TRUE(pair.film_temperature);
        EXPECT_LE(pair.film_temperature->most, 180.0);
        EXPECT_GT(pair.film_temperature->least, 160.0);
      }
  }
}

TEST(FilmFriction, CoolingHasTheSameBitsOnAnyThreadsAndAfterKills) {
  Case data = cooling_film(10.0);
  data.tools[1].temperature = {{0.0, 160.0}, {10.0, 190.0}};
  data.solver.duration = 0.02;
  data.solver.outputs = 10;
  const Energies e = expect_sound_and_repeatable(data, 3);
  EXPECT_GT(e.film, 0.0);
}

TEST(FilmFriction, GoesOnFromACheckpointWithTheSameBits) {
  Case data = pull_out(0.1, 10.0);
  FrictionLawSpec spec = curve();
  spec.over_slip = {{0.0, 1.5}, {3.0, 1.0}};
  spec.over_angle = {{0.0, 1.0}, {1.5, 0.5}};
  slide_on(data, spec);
  data.plies[1].angle = 0.5;
  data.solver.duration = 0.02;
  data.solver.outputs = 10;
  const Energies e = expect_sound_and_repeatable(data, 3);
  EXPECT_GT(e.film, 0.0);
}

} // namespace
} // namespace plyform::film_friction_test
