// SPDX-License-Identifier: GPL-3.0-or-later
// Bending stiffnesses and compression found again: cantilevers against the elastica integrated
// another way, beams and zones against their closed forms.
#include "core/identify/bending_tests.hpp"
#include "core/identify/fit_tension.hpp"
#include "support/fit_curves.hpp"
#include "support/heavy_elastica.hpp"
#include "support/membrane_checks.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace plyform::bending_tests_test {
namespace {

Fabric glass() {
  Fabric fabric = glass_weave();
  fabric.surface_density = 600e-12; // t/mm^2
  return fabric;
}

Curve curve_of(const std::vector<double>& x, const std::vector<double>& y) {
  Curve curve{.file = "test.csv", .x_name = "x", .y_name = "y", .x = x, .y = y, .line = {}};
  for (std::size_t i = 0; i < x.size(); ++i)
    curve.line.push_back(static_cast<int>(i) + 1);
  return curve;
}

TEST(Cantilever, SagIsTheHeavyElasticas) {
  for (const double length : {30.0, 100.0, 200.0}) // c = 70 mm
    for (const double stiffness : {0.5, 2.0}) {
      const double w = glass().weight();
      const double sag = elastica_sag(length, w, stiffness);
      const double c = std::cbrt(stiffness / w);
      EXPECT_NEAR(overhang_at_sag(sag / length) * c / length, 1.0, 2e-6) << length;
    }
}

TEST(Cantilever, ShortOneIsTheBeams) {
  // sag = w L^4 / 8 B, chord's angle (L/c)^3 / 8
  EXPECT_NEAR(std::pow(overhang_at_sag(1e-3), 3), 8e-3, 1e-7);
  EXPECT_NEAR(std::pow(overhang_at_chord(1e-3), 3), 8e-3, 1e-7);
}

TEST(Cantilever, PeircesFormulaIsNear) {
  for (double angle = 5.0; angle <= 60.0; angle += 5.0) { // Peirce's c is larger
    const double phi = angle * degree;
    const double peirce = std::cbrt(8.0 * std::tan(phi) / std::cos(0.5 * phi));
    EXPECT_NEAR(overhang_at_chord(phi) / peirce, 1.0, angle < 42.0 ? 0.02 : 0.045) << angle;
  }
  EXPECT_NEAR(overhang_at_chord(41.5 * degree), 2.0, 1e-3); // ASTM D1388: c = L/2
}

TEST(Cantilever, GivesTheStiffnessThatTheStripHas) {
  const double w = glass().weight();
  std::vector<double> length, sag;
  for (const double l : {90.0, 110.0, 130.0, 150.0}) {
    length.push_back(l);
    sag.push_back(elastica_sag(l, w, 1.5));
  }
  Diagnostics diagnostics;
  const auto fit = identify_cantilever({curve_of(length, sag)}, CantileverReading::sag, glass(), {},
                                       diagnostics);
  ASSERT_TRUE(fit) << texts(diagnostics);
  EXPECT_NEAR(fit->stiffness, 1.5, 1e-5);
  EXPECT_EQ(texts(diagnostics), "");
}

TEST(Cantilever, SpecimensScatterAndLimitsFollow) {
  const auto readings = [](double c) {
    return curve_of({2.0 * c, 2.0 * c}, {41.5 * degree, 41.5 * degree});
  };
  Diagnostics diagnostics;
  const auto fit = identify_cantilever({readings(68.0), readings(70.0), readings(72.0)},
                                       CantileverReading::chord_angle, glass(), {}, diagnostics);
  ASSERT_TRUE(fit) << texts(diagnostics);
  const double unit = 2.0 / overhang_at_chord(41.5 * degree); // c over L/2
  EXPECT_NEAR(fit->bending_length, 70.0 * unit, 1e-9);
  const double deviation = 2.0 * unit; // of c: 68, 70, 72
  EXPECT_NEAR(fit->limits / fit->stiffness,
              3.0 * student_95(2.0) * deviation / std::sqrt(3.0) / fit->bending_length, 1e-9);
}

TEST(Cantilever, RefusesAndWarns) {
  Diagnostics diagnostics;
  const auto go = [&](const Curve& curve, CantileverReading reading) {
    diagnostics = {};
    return identify_cantilever({curve}, reading, glass(), {}, diagnostics).has_value();
  };
  EXPECT_FALSE(go(curve_of({100.0}, {89.0 * degree}), CantileverReading::chord_angle));
  EXPECT_NE(texts(diagnostics).find("at most 85 degrees"), std::string::npos);
  EXPECT_FALSE(go(curve_of({100.0}, {99.0}), CantileverReading::sag));
  EXPECT_FALSE(go(curve_of({0.0}, {1.0}), CantileverReading::sag));
  EXPECT_FALSE(go(curve_of({0.14}, {41.5 * degree}), CantileverReading::chord_angle)); // in m
  EXPECT_NE(texts(diagnostics).find("bending length = "), std::string::npos) << texts(diagnostics);
  const double w = glass().weight();
  std::vector<double> length, sag; // softer the more it bends
  for (const double l : {80.0, 100.0, 120.0, 140.0, 160.0}) {
    length.push_back(l);
    sag.push_back(elastica_sag(l, w, 2.0 * 80.0 / l));
  }
  EXPECT_TRUE(go(curve_of(length, sag), CantileverReading::sag));
  EXPECT_NE(texts(diagnostics).find("the longest overhang has 0.5 times"), std::string::npos)
      << texts(diagnostics);
}

TEST(ThreePoint, IsTheBeamsAndItsDisturbancesAreSeen) {
  std::vector<double> d, force; // F = 48 B b d / S^3, B = 2 N mm, 50 mm wide, 60 mm span
  for (int i = 0; i <= 40; ++i) {
    d.push_back(0.2 * i);
    force.push_back(48.0 * 2.0 * 50.0 * d.back() / std::pow(60.0, 3));
  }
  FitOptions options;
  options.corrections.compliance = 0.0;
  Diagnostics diagnostics;
  const Curve curve = noisy_curve(curve_of(d, force), 0.005, 0.001, 1);
  const auto fit = identify_three_point({curve}, {60.0, 50.0}, glass(), options, diagnostics);
  ASSERT_TRUE(fit) << texts(diagnostics);
  EXPECT_NEAR(fit->stiffness, 2.0, 0.02);
  EXPECT_EQ(fit->x.size(), 31u); // up to a tenth of the span
  EXPECT_LE(std::abs(fit->stiffness - 2.0), 1.5 * fit->limits);
  Curve preloaded = curve;
  for (double& y : preloaded.y)
    y += 0.02;
  diagnostics = {};
  EXPECT_FALSE(identify_three_point({preloaded}, {60.0, 50.0}, glass(), options, diagnostics));
  EXPECT_NE(texts(diagnostics).find("a load zero off by"), std::string::npos) << texts(diagnostics);
  options.corrections.fit_load_zero = true;
  diagnostics = {};
  const auto found = identify_three_point({preloaded}, {60.0, 50.0}, glass(), options, diagnostics);
  ASSERT_TRUE(found) << texts(diagnostics);
  EXPECT_NEAR(found->stiffness, 2.0, 0.04);
}

TEST(ThreePoint, GivesATableOfAFabricThatSoftens) {
  // kappa(M) = M / 4 + 125 M^3 (1/mm, M in N): the integral of kappa M dM is M^3 / 12 + 25 M^5
  const double span = 60.0, width = 50.0;
  std::vector<double> d, force;
  for (int i = 0; i <= 60; ++i) {
    const double moment = 0.05 * i / 60.0;
    force.push_back(4.0 * width * moment / span);
    d.push_back(0.25 * span * span * (moment / 12.0 + 25.0 * std::pow(moment, 3)));
  }
  FitOptions options;
  options.corrections.compliance = 0.0;
  Diagnostics diagnostics;
  const auto fit =
      identify_three_point({curve_of(d, force)}, {span, width}, glass(), options, diagnostics);
  ASSERT_TRUE(fit) << texts(diagnostics);
  ASSERT_EQ(fit->table.curvature.size(), 7u);
  for (const double moment : {0.01, 0.02, 0.03, 0.04}) {
    const double kappa = 0.25 * moment + 125.0 * std::pow(moment, 3);
    EXPECT_NEAR(fit->table.at(kappa).value / moment, 1.0, 0.03) << moment; // chords of a curve
  }
}

TEST(TransitionZone, GivesTheWidthAndTheStiffness) {
  for (const double l : {9.0, 20.0})
    for (const double step : {6.0, -6.0}) { // degrees
      std::vector<double> s, angle;
      for (int i = 0; i <= 40; ++i) {
        s.push_back(30.0 + 2.0 * i); // the origin does not matter
        angle.push_back((8.0 + step * std::exp(-2.0 * i / l)) * degree);
      }
      Diagnostics diagnostics;
      const auto fit = identify_zone({curve_of(s, angle)}, glass(), {}, diagnostics);
      ASSERT_TRUE(fit) << texts(diagnostics);
      EXPECT_NEAR(fit->length, l, 1e-3 * l);
      const double rigidity = 0.0625 * glass().crossings[0].shear.at(8.0 * degree).slope;
      EXPECT_NEAR(fit->stiffness, rigidity * l * l, 3e-3 * rigidity * l * l);
    }
}

TEST(TransitionZone, RefusesProfilesThatDoNotShowIt) {
  std::vector<double> s, angle, line;
  for (int i = 0; i <= 20; ++i) {
    s.push_back(i);
    angle.push_back((8.0 - 6.0 * std::exp(-i / 40.0)) * degree); // far from its end
    line.push_back((2.0 + 0.2 * i) * degree);
  }
  for (const auto& profile : {angle, line}) {
    Diagnostics diagnostics;
    EXPECT_FALSE(identify_zone({curve_of(s, profile)}, glass(), {}, diagnostics));
    EXPECT_NE(texts(diagnostics).find("nothing sure follows"), std::string::npos)
        << texts(diagnostics);
  }
}

TEST(Compression, IsALineAndAPlateau) {
  for (const bool buckles : {true, false}) {
    std::vector<double> e, force;
    for (int i = 0; i <= 60; ++i) {
      e.push_back(0.01 * i / 60.0);
      const double line = 460.0 * e.back();
      force.push_back(buckles && line > 2.0 ? 2.0 + 0.01 * (line - 2.0) : line);
    }
    FitOptions options;
    options.corrections.compliance = 0.0;
    Diagnostics diagnostics;
    const auto fit = identify_compression(noisy_curve(curve_of(e, force), 0.005, 0.0, 2), {},
                                          options, diagnostics);
    ASSERT_TRUE(fit) << texts(diagnostics);
    EXPECT_NEAR(fit->stiffness, 460.0, 5.0);
    EXPECT_EQ(fit->buckling_force.has_value(), buckles);
    EXPECT_NEAR(fit->buckling_force.value_or(2.0), 2.0, 0.02);
  }
}

} // namespace
} // namespace plyform::bending_tests_test
