// SPDX-License-Identifier: GPL-3.0-or-later
// The copies of the kernel of nodes and faces of plies against each other.
#include "contact/simd/cpu_features.hpp"
#include "contact/simd/ply_ply_kernel.hpp"
#include "support/contact_checks.hpp"

#include <cstring>
#include <gtest/gtest.h>
#include <limits>

namespace plyform {
namespace {

void ignore_opening(void*, std::int32_t, double) {}
void ignore_fault(void*, std::int32_t, double) {}

/// Nodes near an uneven sheet of 2 x 2 cells, each with all of its faces, that slide over it.
struct Sliding {
  static constexpr int nodes = 103, cells = 2; // no multiple of four
  std::vector<double> master_x, master_motion, slave_x, slave_motion, free_until, fold_bound;
  std::vector<double> slave_force, master_force;
  std::vector<std::int32_t> triangles, faces, active;
  std::vector<float> face_distance;
  std::vector<PlyPlyPoint> points;
  std::vector<PlyPlyKernelTotals> totals; ///< of each step

  explicit Sliding(Random& random) {
    constexpr int across = cells + 1;
    for (int j = 0; j < across; ++j)
      for (int i = 0; i < across; ++i) {
        for (const double at : {4.0 * i, 4.0 * j, 0.3 * signed_unit(random)})
          master_x.push_back(at);
        for (int k = 0; k < 3; ++k)
          master_motion.push_back(1e-3 * signed_unit(random));
      }
    for (int j = 0; j < cells; ++j)
      for (int i = 0; i < cells; ++i) {
        const int n = j * across + i;
        for (const int corner : {n, n + 1, n + across + 1, n, n + across + 1, n + across})
          triangles.push_back(corner);
      }
    const auto count = static_cast<std::int32_t>(triangles.size() / 3);
    fold_bound.assign(triangles.size() / 3, 0.1);
    for (std::int32_t p = 0; p < nodes; ++p) {
      for (const double at : {4.0 + 4.0 * signed_unit(random), 4.0 + 4.0 * signed_unit(random),
                              0.5 + 0.4 * signed_unit(random)})
        slave_x.push_back(at);
      for (int k = 0; k < 3; ++k)
        slave_motion.push_back(1e-2 * signed_unit(random));
      PlyPlyPoint point{};
      point.area = 2.0, point.gap = std::numeric_limits<double>::infinity(), point.other = 0.0;
      point.node = p, point.face = p % count;
      point.first_face = p * count, point.end_face = (p + 1) * count;
      points.push_back(point);
      active.push_back(p);
      for (std::int32_t f = 0; f < count; ++f)
        faces.push_back(f), face_distance.push_back(0.0F);
    }
    free_until.assign(nodes, 0.0);
    slave_force.assign(slave_x.size(), 0.0), master_force.assign(master_x.size(), 0.0);
  }

  template <class Kernel>
  void step(const Kernel& kernel) {
    for (std::size_t i = 0; i < slave_x.size(); ++i)
      slave_x[i] += slave_motion[i];
    PlyPlyKernelContact k{};
    k.points = points.data(), k.active = active.data(), k.active_count = nodes;
    k.free_until = free_until.data();
    k.slave_x = slave_x.data(), k.slave_motion = slave_motion.data();
    k.master_x = master_x.data(), k.master_motion = master_motion.data();
    k.fold_bound = fold_bound.data(), k.triangles = triangles.data(), k.faces = faces.data();
    k.face_distance = face_distance.data();
    k.slave_force = slave_force.data(), k.master_force = master_force.data();
    k.max_displacement = 0.1, k.path_length = 0.1;
    k.distance = 0.6, k.stiffness = 5.0, k.tangential = 1.0, k.friction = 0.2;
    k.max_depth = 0.15, k.per_depth2 = 1.0 / (0.15 * 0.15), k.damping_per_dt = 0.5;
    k.open = ignore_opening, k.fault = ignore_fault;
    totals.push_back(kernel(k));
  }
};

template <class T>
bool same(const std::vector<T>& a, const std::vector<T>& b) {
  return std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

void expect_same(const Sliding& one, const Sliding& other) {
  EXPECT_TRUE(same(one.points, other.points));
  EXPECT_TRUE(same(one.slave_force, other.slave_force));
  EXPECT_TRUE(same(one.master_force, other.master_force));
  EXPECT_TRUE(same(one.free_until, other.free_until));
  for (std::size_t i = 0; i < one.totals.size(); ++i) {
    const PlyPlyKernelTotals &a = one.totals[i], &b = other.totals[i];
    EXPECT_EQ(a.elastic, b.elastic);
    EXPECT_EQ(a.friction, b.friction);
    EXPECT_EQ(a.damping, b.damping);
    EXPECT_EQ(a.penetration, b.penetration);
    EXPECT_EQ(a.slip, b.slip);
    EXPECT_EQ(a.step_ratio, b.step_ratio);
    EXPECT_EQ(a.touching, b.touching);
  }
}

TEST(PlyPlyKernel, AllCopiesGiveTheSameBits) {
  Random random(13);
  Sliding one(random);
  Sliding avx2 = one, avx512 = one;
  for (int i = 0; i < 20; ++i) {
    one.step(ply_ply_kernel_generic);
    if (has_avx2()) avx2.step(ply_ply_kernel_avx2);
    if (has_avx512()) avx512.step(ply_ply_kernel_avx512);
  }
  EXPECT_GT(one.totals.back().touching, 20);
  EXPECT_LT(one.totals.back().touching, Sliding::nodes);
  EXPECT_GT(one.totals.back().friction, 0.0);
  if (has_avx2()) expect_same(one, avx2);
  if (has_avx512()) expect_same(one, avx512);
}

} // namespace
} // namespace plyform
