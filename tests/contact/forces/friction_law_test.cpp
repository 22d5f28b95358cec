// SPDX-License-Identifier: GPL-3.0-or-later
// Friction that depends on more than the pressure: (L) and (I) of contact/forces/friction_law.hpp
// against numbers by hand, and the contact of a node with a tool under it.
#include "contact/forces/friction_law.hpp"
#include "contact/forces/tool_ply.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace plyform::friction_law_test {
namespace {

using Kind = FrictionLawSpec::Kind;

constexpr double k = 5.0; // N/mm^3

/// A place that would be stretched that far (mm), from `held`.
SlidingPlace place_of(double stretch, double held, double pressure, double slip = 0.0) {
  return {stretch, held, k, pressure, slip, 1.0, 1.0, std::nan("")};
}

FrictionLawSpec film_of(double viscosity, double film, double yield = 0.0) {
  FrictionLawSpec spec;
  spec.kind = Kind::film;
  spec.viscosity = viscosity, spec.film = film, spec.yield = yield;
  return spec;
}

/// mu over H as pull-out tests give it.
FrictionLawSpec curve_of(std::vector<CurvePoint> curve) {
  FrictionLawSpec spec;
  spec.kind = Kind::hersey;
  spec.viscosity = 3e-4; // N s/mm^2: 300 Pa s
  spec.curve = std::move(curve);
  return spec;
}

TEST(FrictionLaw, AFilmBearsViscosityTimesSpeedOverThicknessWhateverPresses) {
  const FrictionLaw law(film_of(4e-4, 0.05, 0.002));
  for (const double pressure : {0.0, 0.1, 3.0})
    EXPECT_NEAR(law.traction(place_of(1.0, 0.0, pressure), 2.0, 1.0).value,
                0.002 + 4e-4 * 2.0 / 0.05, 1e-12);
  EXPECT_NEAR(law.traction(place_of(1.0, 0.0, 0.1), 2.0, 0.5).value, 0.002 + 2e-4 * 2.0 / 0.05,
              1e-12); // a hotter matrix
}

TEST(FrictionLaw, ACurveOverTheHerseyNumberIsOneForAllPressuresSpeedsAndViscosities) {
  const FrictionLaw law(curve_of({{1e-4, 0.3}, {1e-3, 0.1}, {1e-1, 1.0}}));
  for (const double pressure : {0.01, 0.1, 1.0})
    for (const double speed : {0.1, 1.0, 10.0})
      for (const double viscosity : {0.2, 1.0, 5.0}) {
        const double number = 3e-4 * viscosity * speed / pressure;
        const double mu = number <= 1e-4   ? 0.3
                          : number <= 1e-3 ? 0.3 * std::pow(number / 1e-4, std::log10(1.0 / 3.0))
                          : number <= 0.1  ? 0.1 * std::sqrt(number / 1e-3)
                                           : 1.0;
        EXPECT_NEAR(law.traction(place_of(1.0, 0.0, pressure), speed, viscosity).value / pressure,
                    mu, 3e-4 * mu)
            << number;
      }
}

TEST(FrictionLaw, BeyondACurveIsCoulombOrAFilmWithoutPressure) {
  FrictionLawSpec spec = curve_of({{1e-3, 0.1}, {1e-2, 0.4}});
  const double speed = 50.0;
  for (const double pressure : {0.1, 0.01, 1e-4}) {
    EXPECT_NEAR(FrictionLaw(spec).traction(place_of(1.0, 0.0, pressure), speed, 1.0).value,
                0.4 * pressure, 1e-12);
  }
  spec.film_beyond = true; // of a thickness of 1e-2 mm / 0.4
  for (const double pressure : {0.1, 0.01, 1e-4, 0.0})
    EXPECT_NEAR(FrictionLaw(spec).traction(place_of(1.0, 0.0, pressure), speed, 1.0).value,
                3e-4 * speed / 0.025, 1e-3 * 3e-4 * speed / 0.025);
}

TEST(FrictionLaw, AFormulaIsStribecks) {
  FrictionLawSpec spec = curve_of({});
  spec.boundary = 0.25, spec.transition = 2e-3, spec.hydrodynamic = 3.0, spec.exponent = 0.6;
  const double number = 3e-4 * 4.0 / 0.3;
  EXPECT_NEAR(FrictionLaw(spec).traction(place_of(1.0, 0.0, 0.3), 4.0, 1.0).value,
              0.3 * (0.25 * std::exp(-number / 2e-3) + 3.0 * std::pow(number, 0.6)), 1e-4);
  EXPECT_NEAR(FrictionLaw(spec).traction(place_of(1.0, 0.0, 0.3), 0.0, 1.0).value, 0.3 * 0.25,
              1e-12);
}

TEST(FrictionLaw, AMatrixThatThinsHasTheViscosityOfItsRateInTheFilm) {
  FrictionLawSpec spec = film_of(0.0, 0.1);
  spec.viscosity_curve = {{1.0, 1e-3}, {100.0, 1e-4}}; // eta falls with the root of the rate
  const FrictionLaw law(spec);
  for (const double rate : {0.01, 1.0, 7.0, 100.0, 1e4}) {
    const double eta = rate <= 1.0 ? 1e-3 : rate >= 100.0 ? 1e-4 : 1e-3 / std::sqrt(rate);
    EXPECT_NEAR(law.traction(place_of(1.0, 0.0, 1.0), 0.1 * rate, 1.0).value, eta * rate,
                3e-4 * eta * rate);
  }
}

TEST(FrictionLaw, StartAndTackGoByTheWaySlid) {
  FrictionLawSpec spec;
  spec.coefficient = 0.2;
  spec.over_slip = {{0.0, 2.0}, {1.0, 1.0}};
  spec.tack = {{0.0, 0.05}, {0.5, 0.0}};
  const FrictionLaw law(spec);
  const auto bound = [&](double slip) {
    return law.traction(place_of(1.0, 0.0, 0.1, slip), 0.0, 1.0).value;
  };
  EXPECT_NEAR(bound(0.0), 0.04 + 0.05, 1e-15);
  EXPECT_NEAR(bound(0.25), 0.2 * 0.1 * 1.75 + 0.025, 1e-15);
  EXPECT_NEAR(bound(3.0), 0.02, 1e-15);
}

TEST(FrictionLaw, HoldsTillItsBoundAndSlipsBeyond) {
  const FrictionLaw law(film_of(4e-4, 0.05, 0.002));
  EXPECT_EQ(law.stuck(place_of(0.0003, 0.0, 0.0), 1e6, 1.0), 0.0003); // below tau_0 / k
  // k (S - y) = tau_0 + eta y / (h dt)
  const double per_dt = 1e4, stretch = 0.01;
  const double y = (k * stretch - 0.002) / (k + 4e-4 / 0.05 * per_dt);
  EXPECT_NEAR(law.stuck(place_of(stretch, 0.0, 0.0), per_dt, 1.0), stretch - y, 1e-12);
  EXPECT_EQ(law.stuck(place_of(stretch, 0.0, 0.0), 0.0, 1.0), stretch); // no time has passed
}

TEST(FrictionLaw, SolvesForTheSlipOfAStepOverManyDecades) {
  FrictionLawSpec formula = curve_of({});
  formula.boundary = 0.3, formula.transition = 1e-3, formula.hydrodynamic = 2.0,
  formula.exponent = 0.5;
  std::vector<FrictionLaw> laws{FrictionLaw(film_of(4e-4, 0.05, 0.002)), FrictionLaw(formula),
                                FrictionLaw(curve_of({{1e-4, 0.3}, {1e-3, 0.1}, {1e-1, 1.0}}))};
  for (const FrictionLaw& law : laws)
    for (double per_dt = 1e-2; per_dt < 1e10; per_dt *= 30.0)
      for (double stretch = 1e-9; stretch < 10.0; stretch *= 20.0)
        for (const double held : {0.0, 0.5 * stretch, stretch})
          for (const double pressure : {0.0, 1e-4, 0.1, 10.0}) {
            const SlidingPlace place = place_of(stretch, held, pressure);
            const double left = law.stuck(place, per_dt, 1.0);
            ASSERT_GE(left, 0.0);
            ASSERT_LE(left, stretch);
            const double bound = law.traction(place, (stretch - left) * per_dt, 1.0).value;
            if (left < stretch) {
              ASSERT_NEAR(k * left, bound, 1e-6 * k * stretch);
            } else {
              ASSERT_LE(k * left, bound * (1.0 + 1e-12));
            }
          }
}

/// Left of its minimum mu falls.
FrictionLawSpec falling() {
  FrictionLawSpec formula = curve_of({});
  formula.boundary = 0.18, formula.transition = 3e-3, formula.hydrodynamic = 0.9,
  formula.exponent = 0.6;
  return formula;
}

TEST(FrictionLaw, AsksHowFastAPlaceSlidLatelyOnlyWhereFrictionFallsWithTheSpeed) {
  EXPECT_TRUE(FrictionLaw(falling()).falls());
  EXPECT_TRUE(FrictionLaw(curve_of({{1e-4, 0.3}, {1e-3, 0.1}, {1e-1, 1.0}})).falls());
  EXPECT_FALSE(FrictionLaw(curve_of({{1e-3, 0.1}, {1e-2, 0.4}})).falls());
  EXPECT_FALSE(FrictionLaw(film_of(4e-4, 0.05, 0.002)).falls());
}

TEST(FrictionLaw, IsThatOfSteadySlidingAtTheSpeedOfLateAndRisesFromThere) {
  const FrictionLaw law(falling());
  for (const double pressure : {0.02, 0.5})
    for (double speed = 1e-3; speed < 1e4; speed *= 3.0) {
      double lately = speed;
      SlidingPlace place = place_of(1.0, 1.0, pressure), steady = place;
      place.kept = &lately;
      EXPECT_DOUBLE_EQ(law.traction(place, speed, 1.0).value,
                       law.traction(steady, speed, 1.0).value);
      double before = 0.0;
      for (double v = 0.0; v < 1e4; v = 1.3 * v + 1e-4) {
        const double now = law.traction(place, v, 1.0).value;
        ASSERT_GE(now, before * (1.0 - 1e-12)) << v;
        before = now;
      }
    }
}

/// A spring that is drawn at a steady speed on the falling branch: with the friction of the moment
/// it stuck and jumped, here it slides steadily.
TEST(FrictionLaw, ASpringIsDrawnSteadilyWhereFrictionFallsWithTheSpeed) {
  const FrictionLaw law(falling());
  const double pressure = 0.05, memory = 0.04; // N/mm^2, s
  for (const double number : {0.002, 0.006, 0.05})
    for (const double dt : {1e-5, 1e-3}) {
      const double speed = number * pressure / 3e-4;
      double held = 0.0, slip = 0.0, lately = 0.0;
      const double wanted = pressure * falling().hersey(number);
      double least = 1e9, most = 0.0;
      const int steps = static_cast<int>(1.0 / dt);
      for (int i = 0; i < steps; ++i) {
        SlidingPlace place = place_of(held + speed * dt, held, pressure, slip);
        place.kept = &lately;
        if (i == 0) law.begin(place, 1.0 / dt);
        const double left = law.stuck(place, 1.0 / dt, 1.0), y = place.stretch - left;
        law.follow(place, y, 1.0 / dt, memory);
        held = left, slip += y;
        if (i > steps / 2) least = std::min(least, k * held), most = std::max(most, k * held);
      }
      EXPECT_NEAR(least, wanted, 2e-3 * wanted) << number << ' ' << dt;
      EXPECT_NEAR(most, wanted, 2e-3 * wanted) << number << ' ' << dt;
    }
}

/// Likewise drawn, a spring with k T below the fall of the friction with the speed cannot be
/// steady.
TEST(FrictionLaw, TellsWhatSlidUnsteadily) {
  const FrictionLaw law(falling());
  const double pressure = 0.05, memory = 0.04, dt = 1e-3, speed = 0.002 * pressure / 3e-4;
  const auto unsteady_share = [&](double stiffness) {
    SlidingSeen seen;
    double held = 0.0, slip = 0.0, lately = 0.0;
    for (int i = 0; i < 4000; ++i) {
      SlidingPlace place = place_of(held + speed * dt, held, pressure, slip);
      place.kept = &lately, place.stiffness = stiffness;
      if (i == 0) law.begin(place, 1.0 / dt);
      const double left = law.stuck(place, 1.0 / dt, 1.0), y = place.stretch - left;
      law.note(place, y, 1.0 / dt, 1.0, seen);
      law.follow(place, y, 1.0 / dt, memory);
      held = left, slip += y;
    }
    return seen.unsteady / seen.hersey.work;
  };
  EXPECT_GT(unsteady_share(0.1), 0.3);
  EXPECT_LT(unsteady_share(k), 0.02);
}

TEST(FrictionLaw, TellsWhereInItsCurveItWas) {
  const FrictionLaw law(curve_of({{1e-3, 0.1}, {1e-2, 0.4}}));
  SlidingSeen seen;
  const auto slide = [&](double number) {
    const double speed = number * 0.1 / 3e-4; // at 0.1 N/mm^2
    SlidingPlace place = place_of(1.0, 1.0, 0.1);
    place.stretch = 1.0 + speed / 1e3;
    law.note(place, speed / 1e3, 1e3, 1.0, seen);
  };
  slide(2e-4), slide(5e-3), slide(2e-2);
  EXPECT_NEAR(seen.hersey.least, 2e-4, 1e-8);
  EXPECT_NEAR(seen.hersey.most, 2e-2, 1e-6);
  EXPECT_NEAR(seen.hersey.below / seen.hersey.work, 2e-4 / 252e-4, 1e-6);
  EXPECT_NEAR(seen.hersey.above / seen.hersey.work, 200e-4 / 252e-4, 1e-6);
}

/// Nodes pressed against a plate, which drags them along at a speed.
struct Dragged {
  std::vector<Vec3> x, motion;
  std::vector<double> area;
  std::vector<ToolPlyContact> contacts{1};
  ToolBody tool;
  double force = 0.0, work = 0.0, normal = 0.0; ///< N, N mm, N

  Dragged(FrictionLawSpec spec, std::size_t nodes) {
    for (std::size_t n = 0; n < nodes; ++n)
      x.emplace_back(static_cast<double>(n), 0.0, 0.19), area.push_back(2.0);
    motion.assign(nodes, Vec3::Zero());
    tool.shape = Box{{200.0, 20.0, 10.0}};
    tool.position = Vec3(50.0, 0.0, -5.0);
    ToolPlyContact& c = contacts[0];
    c.half_thickness = 0.2;
    c.law.stiffness = 2.0 * k, c.law.max_depth = 0.1;
    c.law.sliding = std::make_shared<FrictionLaw>(std::move(spec));
    const SurfaceKinematics state{x, motion, area, {}};
    find_tool_ply_points(c, tool, state, 1.0, 0.0);
  }

  /// A step of dt (s) at a speed (mm/s) along x.
  void step(double speed, double dt) {
    tool.motion = Vec3(speed * dt, 0.0, 0.0);
    tool.displacement += tool.motion;
    const SurfaceKinematics state{x, motion, area, {}};
    const double path = std::numeric_limits<double>::infinity();
    const Vec3 on_tool =
        tool_ply_forces(tool, contacts, std::span(&state, 1), std::span(&path, 1), dt);
    work += 0.5 * (force - on_tool.x()) * tool.motion.x();
    force = -on_tool.x(), normal = -on_tool.z();
  }
};

TEST(FrictionLaw, APlateDragsNodesByTheLawAndAllItsWorkIsStoredOrLost) {
  FrictionLawSpec spec = curve_of({{1e-4, 0.3}, {1e-3, 0.1}, {1e-1, 1.0}});
  for (const std::size_t nodes : {1u, 3u, 8u, 13u}) {
    Dragged d(spec, nodes);
    const double speed = 20.0, dt = 1e-5;
    d.step(0.0, 0.0);
    for (int i = 0; i < 3000; ++i)
      d.step(speed, dt);
    const double area = 2.0 * static_cast<double>(nodes), pressure = d.normal / area;
    const double mu = 0.1 * std::sqrt(3e-4 * speed / pressure / 1e-3);
    EXPECT_NEAR(d.force, mu * pressure * area, 1e-3 * d.force) << nodes;
    const ContactTotals& sums = d.contacts[0].sums;
    const double spring = 0.5 * area * 2.0 * k * 1e-4 / (1.0 - 0.01); // of the depth, 0.01 mm
    EXPECT_NEAR(d.work, sums.friction + sums.elastic - spring, 1e-9 * d.work);
    EXPECT_NEAR(sums.sliding.hersey.most, 3e-4 * speed / pressure, 1e-3 * 3e-4 * speed / pressure);
  }
}

/// f_w goes by all the way that a place has slid, f_s by that since it touched: after lifting off
/// the first goes on, the second begins anew. The work is that of mu p f over the way.
TEST(FrictionLaw, FacesThatWearInStayWornWhenTheyPart) {
  for (const std::size_t nodes : {1u, 9u}) {
    FrictionLawSpec wears, peaks;
    wears.coefficient = peaks.coefficient = 0.4;
    wears.over_wear = peaks.over_slip = {{0.0, 1.0}, {10.0, 0.5}};
    const auto mu = [](double way) { return 0.4 * (1.0 - 0.05 * std::min(way, 10.0)); };
    for (const bool wear : {true, false}) {
      Dragged d(wear ? wears : peaks, nodes);
      double way = 0.0;
      const auto slide = [&](double by) {
        d.step(0.0, 0.0); // touches, without a way
        for (int i = 0; i < 400; ++i)
          d.step(by / 4e-3, 1e-5);
        way += by;
      };
      const auto held = [&] { return d.force / d.normal; };
      slide(4.0);
      const double stretch = 0.4 * d.normal / (2.0 * static_cast<double>(nodes)) / k; // at most
      EXPECT_NEAR(held(), mu(way), 0.4 * 0.05 * (stretch + 0.01));
      const double worn = way;
      for (Vec3& x : d.x)
        x.z() += 0.05; // lifts off
      d.step(0.0, 1e-5);
      EXPECT_EQ(d.force, 0.0);
      for (Vec3& x : d.x)
        x.z() -= 0.05;
      if (!wear) way = 0.0;
      slide(3.0);
      EXPECT_NEAR(held(), mu(way), 0.4 * 0.05 * (2.0 * stretch + 0.01)) << wear;
      slide(20.0);
      EXPECT_NEAR(held(), 0.2, 1e-12) << "beyond the curve it stays";
      if (wear) {
        EXPECT_NEAR(d.contacts[0].kept[0], worn + 23.0, 3.0 * stretch);
      }
    }
  }
}

TEST(FrictionLaw, AFilmRelaxesAndItsSpeedIsThatOfTheProcess) {
  Dragged d(film_of(4e-4, 0.05), 5);
  d.contacts[0].law.process_time = 100.0; // a simulated second is 100 s
  d.step(0.0, 0.0);
  for (int i = 0; i < 4000; ++i)
    d.step(200.0, 1e-6);
  EXPECT_NEAR(d.force, 10.0 * 4e-4 * 2.0 / 0.05, 1e-6); // 2 mm/s
  const double before = d.force, dt = 1e-6;
  for (int i = 0; i < 100; ++i)
    d.step(0.0, dt);
  // a spring k and a dashpot eta / h in series, by the time of the process and Euler's rule
  const double theta = 4e-4 / 0.05 / k, wanted = before * std::pow(1.0 + 100.0 * dt / theta, -100);
  EXPECT_NEAR(d.force, wanted, 1e-6 * wanted);
}

} // namespace
} // namespace plyform::friction_law_test
