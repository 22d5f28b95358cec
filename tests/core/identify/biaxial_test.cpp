// SPDX-License-Identifier: GPL-3.0-or-later
// Yarns and crimps found again from biaxial curves of known cells.
#include "core/identify/fit_biaxial.hpp"
#include "support/fit_curves.hpp"
#include "support/membrane_checks.hpp"

#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <random>
#include <set>

namespace plyform::biaxial_test {
namespace {

struct Known {
  std::array<double, 2> stiffness{46000.0, 40000.0}, crimp{0.005, 0.008};
};

CrimpedCell cell_of(const Known& known) {
  return {{4.0, 4.0}, known.crimp};
}

/// Strain of weft over that of warp; below 0: weft free, above 10: warp free.
BiaxialCurve curve_of(const Known& known, double ratio, double most = 0.015, double noise = 0.0,
                      unsigned seed = 0, const std::array<TensionLaw, 2>* laws = nullptr) {
  std::array<TensionLaw, 2> lines;
  for (std::size_t a = 0; a < 2; ++a)
    lines[a].stiffness = known.stiffness[a];
  if (!laws) laws = &lines;
  BiaxialCurve curve;
  curve.file = fmt::format("ratio_{}.csv", ratio);
  curve.free = {ratio > 10.0, ratio < 0.0};
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  constexpr int rows = 40;
  for (int i = 0; i <= rows; ++i) {
    std::array<double, 2> strain{most * i / rows, most * i / rows * ratio};
    if (ratio > 1.0) strain = {most * i / rows / ratio, most * i / rows};
    if (curve.free[0]) strain = {-0.1, most * i / rows}; // far too short to pull
    if (curve.free[1]) strain = {most * i / rows, -0.1};
    const CellAnswer answer = answer_of(cell_of(known), strain, (*laws)[0], (*laws)[1]);
    for (std::size_t a = 0; a < 2; ++a) {
      curve.strain[a].push_back(curve.free[a] ? 0.0 : strain[a]);
      curve.load[a].push_back(answer.pull[a] * (1.0 + noise * normal(random)));
    }
    curve.line.push_back(i + 2);
  }
  return curve;
}

std::vector<BiaxialCurve> four(const Known& known, double noise = 0.0, unsigned seed = 0,
                               const std::array<TensionLaw, 2>* laws = nullptr) {
  std::vector<BiaxialCurve> curves;
  for (const double ratio : {0.5, 1.0, 2.0, -1.0, 99.0})
    curves.push_back(curve_of(known, ratio, 0.015, noise, ++seed * 17, laws));
  return curves;
}

std::optional<BiaxialFit> found(const std::vector<BiaxialCurve>& curves, Diagnostics& diagnostics,
                                BiaxialOptions options = {}) {
  return identify_biaxial(curves, glass_weave(), options, diagnostics);
}

TEST(Biaxial, FindsYarnsAndCrimpsAgain) {
  for (const Known& known : {Known{}, Known{{46000.0, 48000.0}, {0.005, 0.005}},
                             Known{{20000.0, 60000.0}, {0.002, 0.012}}}) {
    Diagnostics diagnostics;
    const auto fit = found(four(known), diagnostics);
    ASSERT_TRUE(fit) << texts(diagnostics);
    EXPECT_TRUE(diagnostics.warnings.empty()) << texts(diagnostics);
    EXPECT_TRUE(fit->line);
    for (std::size_t a = 0; a < 2; ++a) {
      EXPECT_NEAR(fit->yarn[a].stiffness / known.stiffness[a], 1.0, 1e-4);
      EXPECT_NEAR(fit->crimp[a] / known.crimp[a], 1.0, 1e-3);
    }
  }
}

TEST(Biaxial, StaysWithinItsLimitsWithNoise) {
  const Known known;
  int inside = 0;
  constexpr int trials = 15;
  double worst_stiffness = 0.0, worst_crimp = 0.0;
  for (unsigned seed = 0; seed < trials; ++seed) {
    Diagnostics diagnostics;
    const auto fit = found(four(known, 0.01, 100 * seed), diagnostics);
    ASSERT_TRUE(fit) << texts(diagnostics);
    for (std::size_t a = 0; a < 2; ++a) {
      const double k = fit->yarn[a].stiffness - known.stiffness[a],
                   c = fit->crimp[a] - known.crimp[a];
      inside += std::abs(k) < fit->stiffness_limits[a];
      inside += std::abs(c) < fit->crimp_limits[a];
      worst_stiffness = std::max(worst_stiffness, std::abs(k / known.stiffness[a]));
      worst_crimp = std::max(worst_crimp, std::abs(c / known.crimp[a]));
    }
  }
  fmt::print("noise of 1 %: stiffness within {:.2g} %, crimp within {:.2g} %, {} of {} inside\n",
             100.0 * worst_stiffness, 100.0 * worst_crimp, inside, 4 * trials);
  EXPECT_LT(worst_stiffness, 0.03);
  EXPECT_LT(worst_crimp, 0.05);
  EXPECT_GE(inside, 0.88 * 4 * trials);
}

TEST(Biaxial, TakesTablesWhereNoLineFits) {
  std::array<TensionLaw, 2> laws;
  laws[0].strain = laws[1].strain = {0.0, 0.004, 0.02};
  laws[0].tension = {0.0, 60.0, 800.0}, laws[1].tension = {0.0, 40.0, 700.0};
  Diagnostics diagnostics;
  const auto fit = found(four({}, 0.0, 0, &laws), diagnostics);
  ASSERT_TRUE(fit) << texts(diagnostics);
  EXPECT_FALSE(fit->line);
  fmt::print("tables: residuals {:.2g} %, crimps {:.3g} +- {:.1g}, {:.3g} +- {:.1g}\n",
             100.0 * fit->quality.rms, fit->crimp[0], fit->crimp_limits[0], fit->crimp[1],
             fit->crimp_limits[1]);
  EXPECT_LT(fit->quality.rms, 0.03);
  for (std::size_t a = 0; a < 2; ++a) // a soft beginning and crimp look alike: weaker than lines
    EXPECT_NEAR(fit->crimp[a], Known{}.crimp[a], std::min(fit->crimp_limits[a], 0.001));
}

TEST(Biaxial, TellsWhenCurvesDoNotShowTheCrimps) {
  const Known known{{46000.0, 46000.0}, {0.005, 0.005}};
  Diagnostics diagnostics;
  EXPECT_FALSE(found({curve_of(known, 1.0, 0.015, 0.01, 1)}, diagnostics));
  EXPECT_NE(texts(diagnostics).find("all of one strain ratio"), std::string::npos)
      << texts(diagnostics);
  Diagnostics slack;
  EXPECT_FALSE(found({curve_of(known, -1.0, 0.004)}, slack)); // within the toe
  EXPECT_NE(texts(slack).find("end within the toe"), std::string::npos) << texts(slack);
}

TEST(Biaxial, RefusesCurvesOfNoCrimpedCell) {
  std::vector<BiaxialCurve> curves = four({});
  for (BiaxialCurve& curve : curves) // two sheets glued together that contract each other
    for (std::size_t i = 0; i < curve.size(); ++i)
      for (std::size_t a = 0; a < 2; ++a)
        if (!curve.free[a])
          curve.load[a][i] = 46000.0 * std::sqrt(curve.strain[a][i]) *
                             (0.1 + (curve.strain[1 - a][i] > curve.strain[a][i] ? 0.0 : 0.2));
  Diagnostics diagnostics;
  EXPECT_FALSE(found(curves, diagnostics));
  EXPECT_FALSE(texts(diagnostics).empty());
}

TEST(Biaxial, FindsAWrongZeroOfStrain) {
  std::vector<BiaxialCurve> curves = four({}, 0.005, 3);
  for (double& strain : curves[1].strain[0])
    strain += 0.001;
  Diagnostics diagnostics;
  (void)found(curves, diagnostics);
  EXPECT_NE(texts(diagnostics).find("wrong zero of strain: warp strain of ratio_1.csv too large"),
            std::string::npos)
      << texts(diagnostics);
  Diagnostics taken;
  const auto fit = found(curves, taken, {.fit_zeros = true});
  ASSERT_TRUE(fit) << texts(taken);
  ASSERT_EQ(fit->zeros.size(), 1u);
  EXPECT_NEAR(fit->zeros[0].amount, 0.001, 0.0001);
  EXPECT_NEAR(fit->crimp[0], 0.005, 0.00025);
}

std::optional<BiaxialCurve> read(const std::string& text, Diagnostics& diagnostics) {
  const auto file = std::filesystem::path(testing::TempDir()) / "biaxial_test.csv";
  std::ofstream(file) << text;
  return read_biaxial(file.string(), {1.0, 2.0}, diagnostics);
}

/// Eight rows of which loads tell the number; cells of warp and weft loads may be empty.
std::string rows_without(const std::set<int>& warp, const std::set<int>& weft) {
  std::string text = "warp_strain,weft_strain,warp_load_N,weft_load_N\n";
  for (int i = 0; i < 8; ++i)
    text += fmt::format("{},{},{},{}\n", 0.001 * i, 0.002 * i,
                        warp.contains(i) ? "" : fmt::format("{}", i),
                        weft.contains(i) ? "" : fmt::format("{}", 20 * i));
  return text;
}

TEST(BiaxialFile, PairsRowsThatHaveBothDirections) {
  struct Case {
    std::set<int> warp, weft, left;
    std::string warning;
  };
  for (const Case& c :
       {Case{{}, {5, 6, 7}, {0, 1, 2, 3, 4}, "3 of 8 rows have an empty cell and are left out"},
        Case{{1, 2, 3}, {5, 6, 7}, {0, 4}, "6 of 8 rows"},
        Case{{}, {}, {0, 1, 2, 3, 4, 5, 6, 7}, ""}}) {
    Diagnostics diagnostics;
    const auto curve = read(rows_without(c.warp, c.weft), diagnostics);
    ASSERT_TRUE(curve) << texts(diagnostics);
    std::vector<double> strain[2], load[2];
    std::vector<int> line;
    for (const int i : c.left) {
      line.push_back(i + 2);
      strain[0].push_back(0.001 * i), strain[1].push_back(0.002 * i);
      load[0].push_back(i), load[1].push_back(10.0 * i);
    }
    EXPECT_EQ(curve->line, line);
    for (std::size_t a = 0; a < 2; ++a) {
      ASSERT_EQ(curve->strain[a].size(), line.size());
      for (std::size_t i = 0; i < line.size(); ++i)
        EXPECT_NEAR(curve->strain[a][i], strain[a][i], 1e-12);
      EXPECT_EQ(curve->load[a], load[a]);
    }
    EXPECT_EQ(diagnostics.warnings.size(), c.warning.empty() ? 0u : 1u);
    EXPECT_NE(texts(diagnostics).find(c.warning), std::string::npos) << texts(diagnostics);
  }
  Diagnostics none;
  EXPECT_FALSE(read(rows_without({0, 1, 2, 3}, {4, 5, 6, 7}), none));
  EXPECT_NE(texts(none).find("no row has strain and load of both"), std::string::npos)
      << texts(none);
}

TEST(BiaxialFile, RefusesColumnsThatDoNotNameTheirDirection) {
  for (const auto& [header, rule] : std::vector<std::pair<std::string, std::string>>{
           {"warp_strain,weft_strain,warp_load_N", "weft_strain: is the only column"},
           {"warp_strain,weft_strain,weft_load_N", "warp_strain: is the only column"},
           {"warp_strain,weft_strain,load_N", "warp_strain: is the only column"},
           {"warp_strain,warp_load_N,weft_load_N", "weft_load_N: is the only column"},
           {"warp_strain,warp_weft_N,weft_strain", "names both warp and weft"},
           {"strain,warp_strain,warp_angle_deg", "no column says by header or unit that it is the "
                                                 "warp load"}}) {
    Diagnostics diagnostics;
    EXPECT_FALSE(read(header + "\n0,0,0\n0.001,0.001,5\n0.002,0.002,9\n", diagnostics)) << header;
    EXPECT_NE(texts(diagnostics).find(rule), std::string::npos) << texts(diagnostics);
  }
  Diagnostics diagnostics;
  const auto free = read("time_s,weft_strain,weft_load_N\n0,0,0\n1,0.001,5\n", diagnostics);
  ASSERT_TRUE(free) << texts(diagnostics);
  EXPECT_TRUE(free->free[0]);
  EXPECT_FALSE(free->free[1]);
}

} // namespace
} // namespace plyform::biaxial_test
