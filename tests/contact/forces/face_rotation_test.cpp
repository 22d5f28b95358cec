// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/forces/face_rotation.hpp"
#include "support/contact_checks.hpp"

#include <gtest/gtest.h>

namespace plyform::face_rotation_test {
namespace {

struct RandomFace {
  std::array<Vec3, 3> x;
  FaceFrame frame;
  explicit RandomFace(Random& random)
      : x{random_vector(random), random_vector(random), random_vector(random)},
        frame(face_frame(x[0], x[1], x[2])) {}
  /// Rounding of sums over g_j grows with g_j.
  double rounding() const {
    double steepest = 1.0;
    for (const Vec3& g : frame.gradient)
      steepest = std::max(steepest, g.norm());
    return 1e-14 * steepest;
  }
};

TEST(FaceTurn, IsThatOfARigidMotion) {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const RandomFace face(random);
    const Vec3 turn = random_vector(random), shift = random_vector(random);
    std::array<Vec3, 3> u;
    for (std::size_t j = 0; j < 3; ++j)
      u[j] = shift + turn.cross(face.x[j]);
    EXPECT_LE((face_turn(face.frame, u) - turn).norm(), face.rounding());
  }
}

TEST(FaceTurn, ForcesOfACoupleHaveItsMomentAndNoSum) {
  Random random(2);
  for (int i = 0; i < 1000; ++i) {
    const RandomFace face(random);
    const Vec3 couple = random_vector(random);
    const std::array<Vec3, 3> force = forces_of_couple(face.frame, couple);
    Vec3 sum = Vec3::Zero(), moment = Vec3::Zero();
    for (std::size_t j = 0; j < 3; ++j) {
      sum += force[j];
      moment += face.x[j].cross(force[j]);
    }
    EXPECT_LE(sum.norm(), face.rounding());
    EXPECT_LE((moment - couple).norm(), face.rounding());
  }
}

TEST(FaceTurn, ForcesOfACoupleDoItsWork) {
  Random random(3);
  for (int i = 0; i < 1000; ++i) {
    const RandomFace face(random);
    const Vec3 couple = random_vector(random);
    const std::array<Vec3, 3> force = forces_of_couple(face.frame, couple),
                              u{random_vector(random), random_vector(random),
                                random_vector(random)};
    const double work = force[0].dot(u[0]) + force[1].dot(u[1]) + force[2].dot(u[2]);
    EXPECT_NEAR(work, couple.dot(face_turn(face.frame, u)), 10.0 * face.rounding());
  }
}

} // namespace
} // namespace plyform::face_rotation_test
