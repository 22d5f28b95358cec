// SPDX-License-Identifier: GPL-3.0-or-later
// Lanczos' iteration, against eigenvalues of matrices that are small enough to have them all.
#include "base/lanczos.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <gtest/gtest.h>
#include <utility>

namespace plyform::lanczos_test {
namespace {

TEST(Lanczos, ResidualSaysHowFarTheNearestEigenvalueIs) {
  constexpr Eigen::Index size = 60;
  RandomNumbers scatter;
  Eigen::MatrixXd half(size, size);
  for (Eigen::Index i = 0; i < half.size(); ++i)
    half(i) = scatter.next();
  const Eigen::MatrixXd k = half * half.transpose();
  const Eigen::VectorXd all = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k).eigenvalues();
  double before = 0.0;
  for (const int steps : {2, 5, 10, 20, 30, 60}) {
    const RitzValue found = largest_ritz_value([&](const Eigen::VectorXd& v) { return k * v; },
                                               Eigen::VectorXd::Ones(size), steps);
    EXPECT_GE(found.value, before);
    EXPECT_LE(found.value, all.maxCoeff() * (1.0 + 1e-12));
    EXPECT_LE((all.array() - found.value).abs().minCoeff(), found.residual + 1e-9);
    before = found.value;
  }
  EXPECT_NEAR(before, all.maxCoeff(), 1e-9 * all.maxCoeff());
}

TEST(Lanczos, HoldsWithMoreStepsThanThereAreDirections) {
  for (const auto& [size, rank] : {std::pair<Eigen::Index, Eigen::Index>{10, 9}, {60, 9}, {3, 2}}) {
    RandomNumbers scatter;
    Eigen::MatrixXd half(size, rank);
    for (Eigen::Index i = 0; i < half.size(); ++i)
      half(i) = scatter.next();
    for (Eigen::Index j = 0; j < rank; ++j)
      half.col(j) *= std::pow(10.0, -0.3 * static_cast<double>(j));
    const Eigen::MatrixXd k = 1e7 * half * half.transpose();
    const double largest =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k).eigenvalues().maxCoeff();
    Eigen::VectorXd start(size);
    for (double& value : start)
      value = scatter.next();
    for (const int steps : {10, 20, 30}) {
      const RitzValue found =
          largest_ritz_value([&](const Eigen::VectorXd& v) { return k * v; }, start, steps);
      EXPECT_NEAR(found.value, largest, 1e-9 * largest) << size << " " << rank << " " << steps;
    }
  }
}

TEST(Lanczos, OfAVectorThatIsAnEigenvectorIsExact) {
  const RitzValue found = largest_ritz_value([](const Eigen::VectorXd& v) { return 3.0 * v; },
                                             Eigen::VectorXd::Ones(5), 4);
  EXPECT_DOUBLE_EQ(found.value, 3.0);
  EXPECT_LE(found.residual, 1e-12);
}

} // namespace
} // namespace plyform::lanczos_test
