// SPDX-License-Identifier: GPL-3.0-or-later
// The kernel that measures pairs of edges against the routine that measures one, and its copies
// against each other.
#include "base/cpu_features.hpp"
#include "contact/forces/edge_edge.hpp"
#include "support/contact_checks.hpp"

#include <cstring>
#include <gtest/gtest.h>

namespace plyform::edge_edge_kernel_test {
namespace {

/// Edges at random, some of them exactly or nearly parallel, some without length.
struct RandomEdges {
  std::vector<Vec3> a, b;
  std::vector<std::array<std::int32_t, 4>> nodes;

  explicit RandomEdges(Random& random) {
    for (int i = 0; i < 1003; ++i) { // no multiple of four
      const int first = 2 * i;
      nodes.push_back({first, first + 1, first, first + 1});
      const Vec3 along = 4.0 * random_vector(random);
      a.push_back(2.0 * random_vector(random));
      a.push_back(a.back() + along);
      b.push_back(2.0 * random_vector(random));
      const double off = i % 5 == 0 ? 0.0 : i % 5 == 1 ? 1e-7 : 4.0;
      b.push_back(b.back() + (i % 5 > 1 ? 0.0 : 1.5) * along + off * random_vector(random));
      if (i % 97 == 3) a.back() = a[a.size() - 2];
    }
  }
};

TEST(EdgeEdgeKernel, MeasuresPairsSideBySideAsThePlainRoutineDoesOne) {
  Random random(11);
  const RandomEdges edges(random);
  std::vector<EdgeEdgeDistance> found;
  measure_edges(edges.nodes, edges.a, edges.b, found);
  int interior = 0;
  for (std::size_t i = 0; i < edges.nodes.size(); ++i) {
    const auto& n = edges.nodes[i];
    const Vec3 &x1 = edges.a[n[0]], &x2 = edges.a[n[1]], &x3 = edges.b[n[2]], &x4 = edges.b[n[3]];
    const EdgeEdgeDistance& d = found[i];
    if ((x2 - x1).norm() > 0.0)
      EXPECT_NEAR(d.distance, edge_distance({n[0], n[1]}, edges.a, {n[2], n[3]}, edges.b), 1e-9);
    else
      EXPECT_LE(d.distance, (x1 - x3).norm());
    if (d.side == 0) continue;
    ++interior;
    const Vec3 apart = x1 + d.s * (x2 - x1) - x3 - d.t * (x4 - x3);
    EXPECT_NEAR(apart.norm(), d.distance, 1e-12);
    EXPECT_NEAR(apart.dot(x2 - x1), 0.0, 1e-9);
    EXPECT_NEAR(apart.dot(x4 - x3), 0.0, 1e-9);
    EXPECT_GT(static_cast<double>(d.side) * (x2 - x1).cross(x4 - x3).dot(apart), 0.0);
  }
  EXPECT_GT(interior, 100);
}

TEST(EdgeEdgeKernel, AllCopiesGiveTheSameBits) {
  if (!has_avx2()) GTEST_SKIP() << "this processor has no AVX2";
  Random random(12);
  const RandomEdges edges(random);
  const EdgeEdgeKernelPairs pairs{edges.nodes.data()->data(), static_cast<int>(edges.nodes.size()),
                                  edges.a.data()->data(), edges.b.data()->data()};
  std::vector<EdgeEdgeDistance> one(edges.nodes.size()), other = one;
  edge_edge_kernel_generic(pairs, one.data());
  const auto same = [&] {
    return std::memcmp(one.data(), other.data(), one.size() * sizeof(one[0])) == 0;
  };
  edge_edge_kernel_avx2(pairs, other.data());
  EXPECT_TRUE(same()) << "AVX2";
  if (!has_avx512()) return;
  other.assign(other.size(), {});
  edge_edge_kernel_avx512(pairs, other.data());
  EXPECT_TRUE(same()) << "AVX-512";
}

} // namespace
} // namespace plyform::edge_edge_kernel_test
