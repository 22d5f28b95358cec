// SPDX-License-Identifier: GPL-3.0-or-later
// The crimped cell against closed forms and against its own equation, solved here by halving in
// long double.
#include "core/model/crimp.hpp"
#include "core/model/fabric.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace plyform::crimp_test {
namespace {

constexpr double warp = 46000.0, weft = 31000.0; // N

TensionLaw yarn(double stiffness) {
  TensionLaw law;
  law.stiffness = stiffness;
  return law;
}

TensionLaw stiffening() {
  TensionLaw law;
  law.strain = {0.0, 0.002, 0.01};
  law.tension = {0.0, 20.0, 400.0};
  law.compression = 60.0;
  return law;
}

constexpr CrimpedCell balanced{{4.0, 4.0}, {0.0028, 0.0028}};
constexpr CrimpedCell uneven{{4.0, 2.5}, {0.02, 0.006}};

struct Tensions {
  long double first, second;
};

/// N_a of linear yarns by halving the bracket of h_1 down to the last bit of long double.
Tensions by_halving(const CrimpedCell& cell, long double eps1, long double eps2,
                    long double stiffness1, long double stiffness2) {
  using std::sqrt;
  const auto height = [&](std::size_t a) {
    const long double p = cell.half_wave[a], length = p * (1.0L + cell.crimp[a]);
    return sqrt(length * length - p * p);
  };
  const long double heights = height(0) + height(1);
  struct Yarn {
    long double tension, sine, cosine;
  };
  const auto at = [&](std::size_t a, long double eps, long double k, long double h) {
    const long double p = cell.half_wave[a], rest = p * (1.0L + cell.crimp[a]);
    const long double span = p * (1.0L + eps), length = sqrt(span * span + h * h);
    return Yarn{k * std::max(0.0L, length / rest - 1.0L), h / length, span / length};
  };
  long double low = 0.0L, high = heights;
  for (int i = 0; i < 200; ++i) {
    const long double h = 0.5L * (low + high);
    const Yarn a = at(0, eps1, stiffness1, h), b = at(1, eps2, stiffness2, heights - h);
    const long double force = a.tension * a.sine - b.tension * b.sine;
    (force > 0.0L ? high : low) = h;
  }
  const Yarn a = at(0, eps1, stiffness1, low), b = at(1, eps2, stiffness2, heights - low);
  return {a.tension * a.cosine, b.tension * b.cosine};
}

/// Curves for strain ratios 0, 0.5, 1, 2 (and the other family alone), as biaxial tests have them.
TEST(Crimp, FollowsItsOwnEquationAtEveryStrainRatio) {
  double worst = 0.0;
  for (const CrimpedCell& cell : {balanced, uneven})
    for (const auto& [r1, r2] :
         {std::pair(1.0, 0.0), {1.0, 0.5}, {1.0, 1.0}, {1.0, 2.0}, {0.0, 1.0}, {1.0, -0.4}})
      for (const double eps : {1e-5, 1e-4, 1e-3, 3e-3, 1e-2, 5e-2}) {
        const CellAnswer found = answer_of(cell, {r1 * eps, r2 * eps}, yarn(warp), yarn(weft));
        const Tensions expected = by_halving(cell, r1 * eps, r2 * eps, warp, weft);
        const double scale = warp * eps;
        worst =
            std::max({worst, std::abs(found.pull[0] - static_cast<double>(expected.first)) / scale,
                      std::abs(found.pull[1] - static_cast<double>(expected.second)) / scale});
      }
  std::printf("largest difference %.2g of stiffness times strain\n", worst);
  EXPECT_LE(worst, 1e-10);
}

/// At equal strains of equal yarns the heights stay: two bars, T = k (L / L_0 - 1).
TEST(Crimp, IsTwoInclinedBarsAtEqualStrains) {
  const double p = balanced.half_wave[0], h = balanced.height(0), rest = balanced.length(0);
  for (const double eps : {1e-4, 1e-3, 1e-2}) {
    const CellAnswer found = answer_of(balanced, {eps, eps}, yarn(warp), yarn(warp));
    const double length = std::hypot(p * (1.0 + eps), h);
    const double bar = warp * (length / rest - 1.0) * p * (1.0 + eps) / length;
    EXPECT_NEAR(found.pull[0], bar, 1e-10 * warp * eps);
    EXPECT_NEAR(found.pull[1], bar, 1e-10 * warp * eps);
    EXPECT_NEAR(found.height, h, 1e-10 * h);
  }
}

/// Free to shorten, the other family takes all of the height without force; from then on the
/// family is a straight yarn, N = k ((1 + eps) / (1 + c) - 1).
TEST(Crimp, StraightensWithoutForceWhereTheOtherFamilyIsFree) {
  const CrimpedCell& cell = uneven;
  const double all = cell.heights(), rest = cell.length(1);
  const double shortest = std::sqrt(rest * rest - all * all) / cell.half_wave[1] - 1.0;
  ASSERT_LT(shortest, -0.01);
  for (const double share : {0.1, 0.5, 0.999999}) {
    const CellAnswer slack =
        answer_of(cell, {share * cell.crimp[0], shortest}, yarn(warp), yarn(weft));
    EXPECT_EQ(slack.pull[0], 0.0);
    EXPECT_EQ(slack.pull[1], 0.0);
    EXPECT_EQ(slack.stored[0] + slack.stored[1], 0.0);
  }
  for (const double eps : {0.021, 0.03}) {
    const CellAnswer taut = answer_of(cell, {eps, shortest - 1e-9}, yarn(warp), yarn(weft));
    EXPECT_NEAR(taut.pull[0], warp * ((1.0 + eps) / (1.0 + cell.crimp[0]) - 1.0), 1e-9);
    EXPECT_EQ(taut.pull[1], 0.0);
    EXPECT_EQ(taut.height, 0.0);
  }
}

/// A cell without waves is two straight yarns that do not know of each other.
TEST(Crimp, WithoutCrimpIsTwoYarns) {
  const CrimpedCell straight{{4.0, 4.0}, {0.0, 0.0}};
  const CellAnswer found = answer_of(straight, {0.003, -0.01}, stiffening(), yarn(weft));
  EXPECT_NEAR(found.pull[0], stiffening().at(0.003).value, 1e-9);
  EXPECT_NEAR(found.stored[0], stiffening().at(0.003).energy, 1e-12);
  EXPECT_EQ(found.pull[1], 0.0);
}

double energy(const CrimpedCell& cell, double eps1, double eps2, const TensionLaw& a,
              const TensionLaw& b) {
  const CellAnswer found = answer_of(cell, {eps1, eps2}, a, b);
  return cell.half_wave[0] * found.stored[0] + cell.half_wave[1] * found.stored[1];
}

/// Tensions are the derivatives of the energy, stiffnesses those of the tensions; the stiffness has
/// no negative eigenvalue and none above that of straight yarns, on which the stable step relies.
TEST(Crimp, TensionsAndStiffnessAreDerivativesWithinTheBound) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> strain(-0.01, 0.03);
  const TensionLaw a = yarn(warp), b = stiffening();
  int taut = 0;
  for (int i = 0; i < 2000; ++i) {
    const CrimpedCell& cell = i % 2 ? uneven : balanced;
    const double e1 = strain(random), e2 = strain(random), d = 1e-6;
    const CellAnswer at = answer_of(cell, {e1, e2}, a, b);
    if (at.pull[0] + at.pull[1] < 1.0) continue;
    ++taut;
    const double n1 = (energy(cell, e1 + d, e2, a, b) - energy(cell, e1 - d, e2, a, b)) / (2.0 * d);
    const double n2 = (energy(cell, e1, e2 + d, a, b) - energy(cell, e1, e2 - d, a, b)) / (2.0 * d);
    EXPECT_NEAR(at.pull[0] * cell.half_wave[0], n1, 1e-6 * warp * 0.01) << e1 << " " << e2;
    EXPECT_NEAR(at.pull[1] * cell.half_wave[1], n2, 1e-6 * warp * 0.01) << e1 << " " << e2;
    // per strain in units of each family's straight yarn: eigenvalues in [0, 1]
    const double s1 = cell.half_wave[0] * a.largest_slope(),
                 s2 = cell.half_wave[1] * b.largest_slope();
    Eigen::Matrix2d hessian;
    hessian << cell.half_wave[0] * at.slope[0] / s1, at.cross / std::sqrt(s1 * s2),
        at.cross / std::sqrt(s1 * s2), cell.half_wave[1] * at.slope[1] / s2;
    const Eigen::Vector2d values =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(hessian).eigenvalues();
    EXPECT_GE(values[0], -1e-9);
    EXPECT_LE(values[1], 1.0);
    // the table has a kink at which a difference across it is none of either side
    const auto pull = [&](double x, double y) { return answer_of(cell, {x, y}, a, a).pull[0]; };
    const CellAnswer smooth = answer_of(cell, {e1, e2}, a, a);
    const double h = 1e-7, by1 = (pull(e1 + h, e2) - pull(e1 - h, e2)) / (2.0 * h),
                 by2 = (pull(e1, e2 + h) - pull(e1, e2 - h)) / (2.0 * h);
    if (smooth.pull[0] < 1.0 || smooth.pull[1] < 1.0) continue; // at the end of a toe
    EXPECT_NEAR(smooth.slope[0], by1, 1e-4 * warp) << e1 << " " << e2;
    EXPECT_NEAR(smooth.cross, by2 * cell.half_wave[0], 1e-4 * warp * cell.half_wave[0]);
  }
  EXPECT_GT(taut, 500);
}

} // namespace
} // namespace plyform::crimp_test
