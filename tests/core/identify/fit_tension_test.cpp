// SPDX-License-Identifier: GPL-3.0-or-later
// Tension of yarns: stiffness or table found again from the curves that they make; what is refused.
#include "core/identify/fit_tension.hpp"
#include "support/fit_curves.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <stdexcept>

namespace plyform::fit_tension_test {
namespace {

template <class Law>
Curve tension_curve(const Law& law, double to, int rows) {
  Curve curve{.file = "yarn.csv", .x_name = "e", .y_name = "N", .x = {}, .y = {}, .line = {}};
  for (int i = 0; i <= rows; ++i) {
    curve.x.push_back(to * i / rows);
    curve.y.push_back(law(curve.x.back()));
    curve.line.push_back(i + 1);
  }
  return curve;
}

TensionFit tension(const Curve& curve, const Strip& scale = {}) {
  Diagnostics diagnostics;
  FitOptions options;
  options.corrections.compliance = 0.0;
  const auto fit = identify_tension(curve, scale, options, diagnostics);
  EXPECT_TRUE(fit) << texts(diagnostics);
  EXPECT_TRUE(diagnostics.warnings.empty()) << texts(diagnostics);
  return fit ? *fit : TensionFit{};
}

double crimped(double e) { // soft until the crimp is gone
  return e < 0.004 ? 4000.0 * e + 2.1e6 * e * e : 49.6 + 20800.0 * (e - 0.004);
}

void expect_fabric_law(const TensionLaw& law) { // what core/input/parts/fabric_file.cpp asks for
  ASSERT_GE(law.strain.size(), 2u);
  ASSERT_EQ(law.strain.size(), law.tension.size());
  EXPECT_LE(law.strain.size(), 20u);
  EXPECT_EQ(law.strain[0], 0.0);
  EXPECT_EQ(law.tension[0], 0.0);
  for (std::size_t i = 1; i < law.strain.size(); ++i) {
    EXPECT_GT(law.strain[i], law.strain[i - 1]);
    EXPECT_GE(law.tension[i], law.tension[i - 1]);
  }
}

TEST(IdentifyTension, FindsAStiffnessWhereALineFits) {
  const auto line = [](double e) { return 46000.0 * e; };
  const TensionFit fit = tension(tension_curve(line, 0.01, 40));
  EXPECT_TRUE(fit.law.strain.empty());
  EXPECT_NEAR(fit.law.stiffness, 46000.0, 1e-6);
  const TensionFit noisy = tension(noisy_curve(tension_curve(line, 0.01, 40), 0.01, 0.0, 7));
  EXPECT_TRUE(noisy.law.strain.empty());
  EXPECT_NEAR(noisy.law.stiffness / 46000.0, 1.0, 0.006); // 1 % / sqrt(40), times 4
}

TEST(IdentifyTension, DividesByYarnsAndGaugeLength) {
  const auto strip_of_25 = [](double mm) { return 25.0 * 46000.0 * mm / 200.0; };
  const TensionFit fit =
      tension(tension_curve(strip_of_25, 2.0, 40), {.yarns = 25.0, .gauge_length = 200.0});
  EXPECT_NEAR(fit.law.stiffness, 46000.0, 1e-6);
  EXPECT_NEAR(fit.strain.back(), 0.01, 1e-12);
  EXPECT_NEAR(fit.measured.back(), 460.0, 1e-9);
}

TEST(IdentifyTension, MakesATableOfACrimpedYarn) {
  for (const int rows : {8, 19, 20, 200, 3000}) {
    const TensionFit fit = tension(tension_curve(crimped, 0.01, rows));
    expect_fabric_law(fit.law);
    for (double e = 0.002; e < 0.0101; e += 0.0001) // 8 rows: chords of a parabola, 1.25 mm/m long
      EXPECT_NEAR(fit.law.at(e).value / crimped(e), 1.0, rows == 8 ? 0.07 : 0.02)
          << rows << " " << e;
  }
}

TEST(IdentifyTension, KeepsTheRowsOfAShortCurve) {
  const TensionFit fit = tension(tension_curve(crimped, 0.01, 8));
  ASSERT_EQ(fit.law.strain.size(), 9u);
  for (std::size_t i = 0; i < 9; ++i)
    EXPECT_NEAR(fit.law.tension[i], crimped(0.01 * static_cast<double>(i) / 8.0), 1e-9);
}

TEST(IdentifyTension, NoiseMakesNoStepsInTheTable) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const TensionFit fit =
        tension(noisy_curve(tension_curve(crimped, 0.01, 400), 0.01, 0.0005, seed));
    expect_fabric_law(fit.law);
    EXPECT_LT(fit.law.largest_slope(), 1.5 * 20800.0) << seed; // it sets the stable step
    for (double e = 0.002; e < 0.0101; e += 0.0001)
      EXPECT_NEAR(fit.law.at(e).value / crimped(e), 1.0, 0.04) << seed << " " << e;
  }
}

TEST(IdentifyTension, RefusesWithOneMessage) {
  struct Wrong {
    Curve curve;
    Strip scale;
    const char* message;
  };
  const auto broken = [](double e) { return e < 0.008 ? 46000.0 * e : 100.0; };
  const auto line = [](double e) { return 46000.0 * e; };
  const Wrong wrong[] = {
      {tension_curve(broken, 0.01, 40),
       {},
       "yarn.csv:32:1: error: N = 356.5: the tension falls "
       "with rising strain, by more than 2 %"},
      {tension_curve(line, 2.0, 40),
       {},
       "e = 2: is a strain of 2, it must be less than 0.5; give "
       "--gauge-length if the column is a displacement"},
      {tension_curve(line, 0.01, 1), {}, "yarn.csv:1:1: error: 1 row with a strain above 0"}};
  for (const Wrong& w : wrong) {
    Diagnostics diagnostics;
    EXPECT_FALSE(identify_tension(w.curve, w.scale, {}, diagnostics)) << w.message;
    EXPECT_EQ(diagnostics.errors.size(), 1u) << texts(diagnostics);
    EXPECT_NE(texts(diagnostics).find(w.message), std::string::npos)
        << "expected: " << w.message << "\nfound: " << texts(diagnostics);
  }
  Diagnostics diagnostics;
  EXPECT_TRUE(identify_tension(tension_curve(broken, 0.01, 40), {},
                               {.coefficients = 3, .from = 0.0, .to = 0.0079}, diagnostics));
  EXPECT_TRUE(identify_tension(tension_curve(line, 0.2, 40), {}, {}, diagnostics));
  EXPECT_NE(texts(diagnostics).find("a strain of 0.2 is much for a yarn"), std::string::npos);
  EXPECT_THROW(identify_tension(tension_curve(line, 0.2, 40), {.yarns = 0.0}, {}, diagnostics),
               std::invalid_argument);
}

} // namespace
} // namespace plyform::fit_tension_test
