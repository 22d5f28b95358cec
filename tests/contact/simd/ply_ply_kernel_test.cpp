// SPDX-License-Identifier: GPL-3.0-or-later
// The copies of the kernel of nodes and faces of plies against each other.
#include "base/cpu_features.hpp"
#include "contact/search/sheet_edges.hpp"
#include "contact/simd/ply_ply_kernel.hpp"
#include "support/contact_checks.hpp"

#include <algorithm>
#include <cstring>
#include <gtest/gtest.h>
#include <limits>
#include <utility>

namespace plyform::ply_ply_kernel_test {
namespace {

/// A call back of the kernel: the point, and the gap or distance that it tells.
using Call = std::pair<std::int32_t, double>;

void note(void* calls, std::int32_t point, double length) {
  static_cast<std::vector<Call>*>(calls)->emplace_back(point, length);
}

/// Nodes near an uneven sheet of 2 x 2 cells that slide over it, each with some of its faces. Runs
/// of up to twelve are pressed into it and know their face (so groups of four need no search), pass
/// by above it, are anywhere and have to search, or stay over an edge, where rounding decides
/// whether a foot is inside.
struct Sliding {
  static constexpr int cells = 2;
  enum class Kind { pressed, passing, anywhere, over_edge };
  std::vector<double> master_x, master_motion, slave_x, slave_motion, free_until, fold_bound;
  std::vector<double> slave_force, master_force;
  std::vector<std::int32_t> triangles, faces_across, faces, active;
  std::vector<float> face_distance;
  std::vector<PlyPlyPoint> points;
  std::vector<PlyPlyKernelTotals> totals; ///< of each step
  std::vector<Call> calls;

  Sliding(Random& random, std::int32_t nodes) {
    make_sheet(random);
    std::int32_t run_end = 0;
    Kind kind{};
    for (std::int32_t p = 0; p < nodes; ++p) {
      if (p == run_end) {
        kind = static_cast<Kind>(random() % 4);
        run_end += 1 + static_cast<std::int32_t>(random() % 12);
      }
      add_point(random, kind, p);
    }
    free_until.assign(points.size(), 0.0);
    slave_force.assign(slave_x.size(), 0.0), master_force.assign(master_x.size(), 0.0);
  }

  void make_sheet(Random& random) {
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
    fold_bound.assign(triangles.size() / 3, 0.1);
    std::vector<Triangle> sheet;
    for (std::size_t t = 0; t < triangles.size(); t += 3)
      sheet.push_back({triangles[t], triangles[t + 1], triangles[t + 2]});
    std::vector<Vec3> x;
    for (std::size_t n = 0; n < master_x.size(); n += 3)
      x.emplace_back(&master_x[n]);
    for (const auto& of : sheet_edges(sheet, x).faces_across)
      faces_across.insert(faces_across.end(), of.begin(), of.end());
    faces_across.front() = several_faces; // as where three faces share an edge
  }

  void add_point(Random& random, Kind kind, std::int32_t p) {
    const auto count = static_cast<std::int32_t>(triangles.size() / 3);
    PlyPlyPoint point{};
    point.area = 2.0, point.gap = std::numeric_limits<double>::infinity(), point.other = 0.0;
    const double x = 4.0 + 4.0 * signed_unit(random), y = 4.0 + 4.0 * signed_unit(random);
    const double z = 0.5 + 0.4 * signed_unit(random);
    const int i = std::min(int(x / 4.0), cells - 1), j = std::min(int(y / 4.0), cells - 1);
    point.node = p, point.face = 2 * (j * cells + i) + (y - 4.0 * j > x - 4.0 * i ? 1 : 0);
    if (kind == Kind::pressed) point.other = 10.0;
    Vec3 at(x, y, kind == Kind::pressed ? 0.1 : kind == Kind::passing ? 1.2 : z);
    Vec3 motion = 1e-2 * Vec3(signed_unit(random), signed_unit(random), signed_unit(random));
    if (kind == Kind::over_edge) {
      const Vec3 a = corner(point.face, 0), b = corner(point.face, 1), c = corner(point.face, 2);
      const double beside = random() % 8 == 0 ? -1e-9 : 1e-9; // outside or inside
      at = a + 0.125 * x * (b - a) + beside * (c - a) + 0.4 * (b - a).cross(c - a).normalized();
      motion.setZero();
    }
    slave_x.insert(slave_x.end(), at.begin(), at.end());
    slave_motion.insert(slave_motion.end(), motion.begin(), motion.end());
    point.first_face = static_cast<std::int32_t>(faces.size());
    double distance = 0.0; // ascending: points stop their search early or late
    for (std::int32_t f = 0; f < count - p % 3;
         ++f, distance += 0.1 * (1.0 + signed_unit(random))) {
      faces.push_back((point.face + f) % count);
      face_distance.push_back(static_cast<float>(distance));
    }
    point.end_face = static_cast<std::int32_t>(faces.size());
    points.push_back(point);
    active.push_back(p);
  }

  Vec3 corner(std::int32_t face, std::size_t number) const {
    return Vec3(&master_x[3 * triangles[3 * std::size_t(face) + number]]);
  }

  template <class Kernel>
  void step(const Kernel& kernel) {
    for (std::size_t i = 0; i < slave_x.size(); ++i)
      slave_x[i] += slave_motion[i];
    PlyPlyKernelContact k{};
    k.points = points.data(), k.active = active.data(), k.active_count = int(active.size());
    k.free_until = free_until.data();
    k.slave_x = slave_x.data(), k.slave_motion = slave_motion.data();
    k.master_x = master_x.data(), k.master_motion = master_motion.data();
    k.fold_bound = fold_bound.data(), k.triangles = triangles.data(), k.faces = faces.data();
    k.faces_across = faces_across.data();
    k.face_distance = face_distance.data();
    k.slave_force = slave_force.data(), k.master_force = master_force.data();
    k.max_displacement = 0.1, k.path_length = 0.1;
    k.distance = 0.6, k.stiffness = 5.0, k.tangential = 1.0, k.friction = 0.2;
    k.max_depth = 0.15, k.per_depth2 = 1.0 / (0.15 * 0.15), k.damping_per_dt = 0.5;
    k.self = &calls, k.open = note, k.fault = note;
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
  EXPECT_EQ(one.calls, other.calls);
  ASSERT_EQ(one.totals.size(), other.totals.size());
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

void expect_same_bits(Sliding& one, int steps) {
  Sliding avx2 = one, avx512 = one;
  for (int i = 0; i < steps; ++i) {
    one.step(ply_ply_kernel_generic);
    if (has_avx2()) avx2.step(ply_ply_kernel_avx2);
    if (has_avx512()) avx512.step(ply_ply_kernel_avx512);
  }
  if (has_avx2()) expect_same(one, avx2);
  if (has_avx512()) expect_same(one, avx512);
}

TEST(PlyPlyKernel, AllCopiesGiveTheSameBits) {
  Random random(13);
  constexpr std::int32_t nodes = 301; // several chunks, no multiple of four
  Sliding sheet(random, nodes);
  expect_same_bits(sheet, 20);
  EXPECT_GT(sheet.totals.back().touching, 100);
  EXPECT_LT(sheet.totals.back().touching, nodes);
  EXPECT_GT(sheet.totals.back().friction, 0.0);
  EXPECT_FALSE(sheet.calls.empty());
}

TEST(PlyPlyKernel, AllCopiesGiveTheSameBitsWithAnyNumberOfPoints) {
  Random random(14);
  for (const std::int32_t nodes : {1,  2,  3,  4,  5,  7,  8,  9,  11, 12, 13, 15,  16,  17, 31,
                                   60, 61, 63, 64, 65, 67, 68, 69, 71, 72, 73, 127, 128, 129})
    for (int i = 0; i < 10; ++i) {
      SCOPED_TRACE(nodes);
      Sliding sheet(random, nodes);
      expect_same_bits(sheet, 4);
      if (HasFailure()) return;
    }
}

} // namespace
} // namespace plyform::ply_ply_kernel_test
