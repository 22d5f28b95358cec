// SPDX-License-Identifier: GPL-3.0-or-later
// The kernel that measures points and triangles against the routine that measures one, and its
// copies against each other.
#include "base/cpu_features.hpp"
#include "contact/point_triangle.hpp"
#include "contact/simd/point_face_kernel.hpp"
#include "support/contact_checks.hpp"

#include <cstring>
#include <gtest/gtest.h>

namespace plyform::point_face_kernel_test {
namespace {

/// Points and triangles at random: near all corners and edges and inside, some of the points on
/// them, some of the triangles slivers or without area.
struct RandomPairs {
  std::vector<Vec3> points, nodes;
  std::vector<Triangle> triangles;
  std::vector<std::array<std::int32_t, 2>> numbers;

  explicit RandomPairs(Random& random) {
    for (int i = 0; i < 3001; ++i) { // no multiple of four
      const Vec3 a = 5.0 * random_vector(random), b = a + 4.0 * random_vector(random);
      Vec3 c = a + 4.0 * random_vector(random);
      if (i % 97 == 1) c = 0.5 * (a + b);
      if (i % 97 == 2) c = b + 0.01 * random_vector(random);
      const Vec3 w = random_vector(random); // of b and c
      Vec3 p = a + w.x() * (b - a) + w.y() * (c - a) + random_vector(random);
      if (i % 11 == 0) p = a;
      if (i % 11 == 1) p = 0.5 * (b + c);
      triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
      nodes.insert(nodes.end(), {a, b, c});
      points.push_back(p);
      numbers.push_back({i, i});
    }
  }
  PointFaceKernelPairs view() const {
    return {numbers.data()->data(), static_cast<int>(numbers.size()), points.data()->data(),
            nodes.data()->data(), triangles.data()->data()};
  }
};

TEST(PointFaceKernel, MeasuresPairsSideBySideInTheBitsOfOne) {
  Random random(21);
  const RandomPairs pairs(random);
  std::vector<PointFaceDistance> found(pairs.numbers.size());
  fastest(point_face_kernel_generic, point_face_kernel_avx2,
          point_face_kernel_avx512)(pairs.view(), found.data());
  std::array<int, 7> regions{};
  int left = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Vec3 *a = &pairs.nodes[3 * i], *b = a + 1, *c = a + 2;
    const ClosestPoint one = closest_point_on_triangle(pairs.points[i], *a, *b, *c);
    if (std::isnan(found[i].distance2)) {
      const double bb = (*b - *a).squaredNorm(), cc = (*c - *a).squaredNorm();
      const double bc = (*b - *a).dot(*c - *a);
      EXPECT_LT(bb * cc - bc * bc, 0.011 * bb * cc) << i; // a sliver
      ++left;
      continue;
    }
    ++regions[static_cast<std::size_t>(one.feature)];
    EXPECT_EQ(found[i].distance2, one.distance2) << i << " region " << one.feature;
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_EQ(found[i].w[k], one.w[k]) << i << " region " << one.feature;
  }
  for (const int count : regions)
    EXPECT_GT(count, 50);
  EXPECT_GT(left, 30);
  EXPECT_LT(left, 150);
}

TEST(PointFaceKernel, AllCopiesGiveTheSameBits) {
  if (!has_avx2()) GTEST_SKIP() << "this processor has no AVX2";
  Random random(22);
  const RandomPairs pairs(random);
  std::vector<PointFaceDistance> one(pairs.numbers.size()), other = one;
  point_face_kernel_generic(pairs.view(), one.data());
  const auto same = [&] {
    return std::memcmp(one.data(), other.data(), one.size() * sizeof(one[0])) == 0;
  };
  point_face_kernel_avx2(pairs.view(), other.data());
  EXPECT_TRUE(same()) << "AVX2";
  if (!has_avx512()) return;
  other.assign(other.size(), {});
  point_face_kernel_avx512(pairs.view(), other.data());
  EXPECT_TRUE(same()) << "AVX-512";
}

} // namespace
} // namespace plyform::point_face_kernel_test
