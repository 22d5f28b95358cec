// SPDX-License-Identifier: GPL-3.0-or-later
// The kernel of contacts with tools against the law one contact after the other, and its compiled
// copies against each other.
#include "base/cpu_features.hpp"
#include "contact/forces/tool_ply.hpp"
#include "contact/simd/tool_ply_kernel.hpp"
#include "support/contact_checks.hpp"
#include "support/contact_oracles.hpp"

#include <cstring>
#include <gtest/gtest.h>
#include <numeric>

namespace plyform::tool_ply_kernel_test {
namespace {

/// A step of contacts with random memories and gaps up to 0.05 mm either way, every third four of
/// them 1 mm further away and free before; nodes are points.
struct RandomStep {
  std::vector<ToolPlyPoint> points;
  std::vector<std::int32_t> near;
  OwnedSheet nodes;
  std::vector<Vec3> force;
  ToolPlyKernelContact contact{};

  RandomStep(int count, const ContactLaw& law, double dt, Random& random)
      : near(static_cast<std::size_t>(count)),
        nodes(points_only(std::vector<Vec3>(near.size(), Vec3::Zero()), 0.0)),
        force(near.size(), Vec3::Zero()) {
    std::iota(near.begin(), near.end(), 0);
    for (const std::int32_t n : near) {
      const auto i = static_cast<std::size_t>(n);
      nodes.area[i] = 2.0 + signed_unit(random);
      nodes.motion[i] = 0.01 * random_vector(random);
      ToolPlyPoint p{};
      const bool far = n / 4 % 3 == 2;
      if (n % 3 != 0 && !far) { // it touched
        s_of(p.memory) = 0.01 * random_vector(random);
        p.memory.damping_force = 0.1 * signed_unit(random);
        p.memory.normal_force = 1.0 + signed_unit(random);
        p.memory.slip = 0.01 * (1.0 + signed_unit(random));
      }
      normal_of(p) = random_vector(random).normalized();
      p.gap = (far ? 1.0 : 0.0) + 0.05 * signed_unit(random);
      p.last_gap = p.gap + 0.01 * signed_unit(random);
      p.node = n;
      points.push_back(p);
    }
    contact.active_count = count;
    Eigen::Map<Vec3>(contact.tool_motion) = 0.01 * random_vector(random);
    Eigen::Map<Vec3>(contact.advance) = 0.01 * random_vector(random);
    contact.stiffness = law.stiffness;
    contact.max_depth = law.max_depth;
    contact.per_depth2 = 1.0 / (law.max_depth * law.max_depth);
    contact.tangential = law.tangential();
    contact.friction = law.friction;
    contact.damping_per_dt = dt > 0.0 ? law.damping / dt : 0.0;
  }

  ToolPlyKernelTotals run(ToolPlyKernelTotals (*kernel)(const ToolPlyKernelContact&)) {
    contact.points = points.data();
    contact.active = near.data();
    contact.area = nodes.area.data();
    contact.motion = nodes.motion.data()->data();
    contact.force = force.data()->data();
    return kernel(contact);
  }
};

/// The force (N) on the node of one point; m: its memory, which is updated.
Vec3 force_by_law(const ContactLaw& law, double dt, const RandomStep& step, const ToolPlyPoint& p,
                  ContactHistory& m, ContactTotals& sums) {
  const auto n = static_cast<std::size_t>(p.node);
  const Vec3 normal = normal_of(p);
  const double area = step.nodes.area[n];
  const double depth = -p.gap + normal.dot(Eigen::Map<const Vec3>(step.contact.advance));
  const double dp = p.last_gap + depth;
  if (depth <= 0.0) {
    sums.damping += 0.5 * m.damping_force * dp;
    release(law, area, m, sums);
    return Vec3::Zero();
  }
  const NormalForce pressed = normal_force(law, area, depth, depth + std::min(p.last_gap, 0.0), dt);
  sums.damping += 0.5 * (pressed.damping + m.damping_force) * dp;
  m.damping_force = pressed.damping;
  m.normal_force = pressed.total;
  const Vec3 slip = step.nodes.motion[n] - Eigen::Map<const Vec3>(step.contact.tool_motion);
  const Vec3 f =
      pressed.total * normal + friction_force(law, area, pressed.total, normal, slip, m, sums);
  sums.elastic += tangent_energy(law, area, depth, m);
  sums.penetration = std::max(sums.penetration, depth);
  ++sums.touching;
  return f;
}

TEST(ToolKernelOracle, FollowsTheLawOfOneContact) {
  Random random(3);
  for (const double dt : {0.0, 1e-6})
    for (const int count : {1, 3, 4, 130}) {
      const ContactLaw law{3.0, 1e-6, 0.2, 0.08}; // gaps of up to 0.07 mm
      RandomStep step(count, law, dt, random);
      const RandomStep before = step;
      const ToolPlyKernelTotals sums = step.run(tool_ply_kernel_generic);
      ContactTotals expected;
      Vec3 on_nodes = Vec3::Zero();
      for (std::size_t i = 0; i < before.points.size(); ++i) {
        ContactHistory m = before.points[i].memory;
        const Vec3 f = force_by_law(law, dt, before, before.points[i], m, expected);
        on_nodes += f;
        const ContactHistory& found = step.points[i].memory;
        EXPECT_LE((step.force[i] - f).norm(), 1e-14) << i;
        EXPECT_LE((s_of(found) - s_of(m)).norm(), 1e-16) << i;
        EXPECT_NEAR(found.damping_force, m.damping_force, 1e-15) << i;
        EXPECT_NEAR(found.normal_force, m.normal_force, 1e-15) << i;
        EXPECT_NEAR(found.slip, m.slip, 1e-16) << i;
      }
      EXPECT_EQ(sums.touching, expected.touching);
      EXPECT_NEAR(sums.elastic, expected.elastic, 1e-13 * expected.elastic);
      EXPECT_NEAR(sums.friction, expected.friction, 1e-13);
      EXPECT_NEAR(sums.damping, expected.damping, 1e-13);
      EXPECT_NEAR(sums.penetration, expected.penetration, 1e-16);
      EXPECT_NEAR(sums.slip, expected.slip, 1e-16);
      EXPECT_LE((Eigen::Map<const Vec3>(sums.on_nodes) - on_nodes).norm(), 1e-13);
    }
}

TEST(ToolKernelOracle, GivesTheSameBitsOnEveryProcessor) {
  if (!has_avx2()) GTEST_SKIP() << "this processor has no AVX2";
  Random random(4);
  for (int count = 1; count < 40; ++count) {
    const RandomStep before(count, {3.0, 1e-6, 0.2, 0.08}, 1e-6, random);
    RandomStep a = before;
    const ToolPlyKernelTotals sums = a.run(tool_ply_kernel_generic);
    const auto expect_same = [&](auto* kernel) {
      RandomStep b = before;
      const ToolPlyKernelTotals other = b.run(kernel);
      ASSERT_EQ(std::memcmp(a.force.data(), b.force.data(), a.force.size() * sizeof(Vec3)), 0);
      ASSERT_EQ(
          std::memcmp(a.points.data(), b.points.data(), a.points.size() * sizeof(ToolPlyPoint)), 0);
      ASSERT_EQ(sums.elastic, other.elastic);
      ASSERT_EQ(sums.friction, other.friction);
      ASSERT_EQ(sums.damping, other.damping);
      ASSERT_EQ(sums.slip, other.slip);
      ASSERT_EQ(sums.penetration, other.penetration);
      ASSERT_EQ(sums.step_ratio, other.step_ratio);
      ASSERT_EQ(sums.touching, other.touching);
      ASSERT_EQ(std::memcmp(sums.on_nodes, other.on_nodes, sizeof sums.on_nodes), 0);
    };
    expect_same(tool_ply_kernel_avx2);
    if (has_avx512()) expect_same(tool_ply_kernel_avx512);
  }
}

} // namespace
} // namespace plyform::tool_ply_kernel_test
