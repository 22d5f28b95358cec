// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes with elements of different sizes: conforming, nested in the uniform mesh, as small as
// zones and grid ask for, with angles no worse than half of the uniform mesh's.
#include "core/mesh/bisection.hpp"
#include "core/mesh/pairs.hpp"
#include "support/blank_checks.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace plyform::graded_mesh_test {
namespace {

using namespace blank_checks;
constexpr double pi = std::numbers::pi;
constexpr MeshKind bisected_kinds[] = {MeshKind::diagonal, MeshKind::alternating, MeshKind::crossed,
                                       MeshKind::fibres};

MeshZone disc_zone(const Vec2& centre, double radius, double size, double inner = 0.0) {
  MeshZone zone;
  zone.element_size = size, zone.centre = centre, zone.radius = radius, zone.inner_radius = inner;
  return zone;
}

MeshZone polygon_zone(std::vector<Vec2> outline, double size) {
  MeshZone zone;
  zone.kind = ZoneKind::polygon, zone.element_size = size, zone.outline = std::move(outline);
  return zone;
}

BlankSpec blank_with(const Outline& outline, MeshKind kind, double size,
                     std::vector<MeshZone> zones) {
  return {outline, kind, size, {}, {}, std::move(zones)};
}

BlankMesh meshed(const BlankSpec& spec) {
  return mesh_blank(spec, 0.0, 0.5 * pi);
}

BlankMesh uniform(BlankSpec spec) {
  spec.zones.clear(), spec.sizes.reset();
  return meshed(spec);
}

Outline plate() {
  return {rectangle(-30, -20, 30, 20), {}};
}

std::array<Vec2, 3> corners_of(const BlankMesh& mesh, const Triangle& t) {
  return {mesh.x[at(t[0])], mesh.x[at(t[1])], mesh.x[at(t[2])]};
}

double area(const std::array<Vec2, 3>& x) {
  return 0.5 * turn(x[1] - x[0], x[2] - x[0]);
}

/// Of a square of two triangles as large as this one, or of four, mm.
double size_of(const std::array<Vec2, 3>& x, MeshKind kind) {
  return std::sqrt((kind == MeshKind::crossed ? 4.0 : 2.0) * area(x));
}

/// Whether a point of a triangle, of many, is where inside(p) holds.
template <class Inside>
bool reaches(const std::array<Vec2, 3>& x, const Inside& inside) {
  constexpr int n = 12;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; i + j <= n; ++j)
      if (inside(Vec2((i * x[0] + j * x[1] + (n - i - j) * x[2]) / n))) return true;
  return false;
}

/// Most of size over `wanted` of the triangles with a point where inside(p) holds, and their mean.
template <class Inside>
std::pair<double, double> sizes_in(const BlankMesh& mesh, MeshKind kind, const Inside& inside) {
  double most = 0.0, sum = 0.0, count = 0.0;
  for (const Triangle& t : mesh.triangles) {
    const auto x = corners_of(mesh, t);
    if (!reaches(x, inside)) continue;
    most = std::max(most, size_of(x, kind));
    sum += size_of(x, kind), count += 1.0;
  }
  return {most, sum / count};
}

/// 2^(1/4), with rounding
const double limit = std::pow(2.0, 0.25) * (1.0 + 1e-5);

TEST(GradedMesh, IsConformingAndAsFineAsItsZonesAsk) {
  const auto in_ring = [](const Vec2& p) {
    const double r = (p - Vec2(5, 3)).norm();
    return r < 12.0 - 1e-6 && r > 6.0 + 1e-6;
  };
  const auto in_corner = [](const Vec2& p) { return p.x() < -20 - 1e-6 && p.y() < -8 - 1e-6; };
  for (const MeshKind kind : bisected_kinds) {
    const BlankSpec spec = blank_with(
        plate(), kind, 5.0,
        {disc_zone({5, 3}, 12, 1.1, 6.0), polygon_zone(rectangle(-40, -40, -20, -8), 2)});
    const BlankMesh mesh = meshed(spec);
    expect_sound(mesh, plate(), "kind");
    EXPECT_GE(measure(mesh).min_angle / degree, 45.0 - 1e-9); // squares: one shape only
    const auto [ring, mean] = sizes_in(mesh, kind, in_ring);
    EXPECT_LE(ring, limit * 1.1);
    EXPECT_GE(mean, 1.1 / limit); // not finer than it must be
    EXPECT_LE(sizes_in(mesh, kind, in_corner).first, limit * 2.0);
    double largest = 0.0; // far from the zones nothing is cut
    for (const Triangle& t : mesh.triangles)
      largest = std::max(largest, size_of(corners_of(mesh, t), kind));
    EXPECT_NEAR(largest, 5.0, 1e-9);
    BlankSpec fine = spec;
    fine.element_size = 1.1;
    EXPECT_LT(mesh.triangles.size(), uniform(fine).triangles.size() / 2);
  }
}

TEST(GradedMesh, IsNestedInTheUniformMeshWhoseNodesKeepTheirNumbers) {
  for (const MeshKind kind : bisected_kinds) {
    const BlankSpec spec = blank_with(pierced_l(), kind, 30.0, {disc_zone({100, 120}, 25, 4)});
    const BlankMesh coarse = uniform(spec), fine = meshed(spec);
    expect_sound(fine, pierced_l(), "L");
    ASSERT_GT(fine.triangles.size(), 2 * coarse.triangles.size());
    for (std::size_t n = 0; n < coarse.x.size(); ++n)
      EXPECT_EQ(fine.x[n], coarse.x[n]);
    // angles are those of bisected triangles: half of the smallest one at least
    EXPECT_GE(measure(fine).min_angle, 0.5 * measure(coarse).min_angle);
    const auto holds = [](const std::array<Vec2, 3>& x, const Vec2& p) {
      for (std::size_t k = 0; k < 3; ++k)
        if (turn(x[(k + 1) % 3] - x[k], p - x[k]) < -1e-9) return false;
      return true;
    };
    for (const Triangle& t : fine.triangles) {
      const auto x = corners_of(fine, t);
      const Vec2 middle = (x[0] + x[1] + x[2]) / 3.0;
      int in = 0;
      for (const Triangle& c : coarse.triangles) {
        const auto y = corners_of(coarse, c);
        if (!holds(y, middle)) continue;
        ++in;
        for (const Vec2& p : x)
          EXPECT_TRUE(holds(y, p));
      }
      EXPECT_EQ(in, 1);
    }
  }
}

/// The zone is a hundredth of the triangle that it lies in, away from its corners and middles.
TEST(GradedMesh, FindsZonesThatAreMuchSmallerThanATriangle) {
  const Vec2 p(3.1, 1.7);
  for (const MeshZone& zone :
       {disc_zone(p, 0.1, 0.3), polygon_zone({p, p + Vec2(0.1, 0), p + Vec2(0, 0.1)}, 0.3)})
    for (const MeshKind kind : {MeshKind::alternating, MeshKind::free}) {
      const BlankMesh mesh = meshed(blank_with(plate(), kind, 20.0, {zone}));
      expect_sound(mesh, plate(), "small");
      double there = 0.0;
      for (const Triangle& t : mesh.triangles) {
        const auto x = corners_of(mesh, t);
        if (reaches(x, [&](const Vec2& q) { return (q - p - Vec2(0.02, 0.02)).norm() < 0.03; }))
          there = std::max(there, size_of(x, kind));
      }
      EXPECT_GT(there, 0.0);
      EXPECT_LE(there, limit * 0.3);
      EXPECT_LT(mesh.triangles.size(), 700u);
    }
}

TEST(GradedMesh, FollowsAGridOfSizes) {
  BlankSpec spec = blank_with(plate(), MeshKind::alternating, 5.0, {});
  SizeGrid grid{{-30, -20}, 10.0, 7, 5, std::vector<double>(35, 4.0)};
  grid.size[2 * 7 + 5] = 0.8; // at (20, 0)
  spec.sizes = grid;
  const BlankMesh mesh = meshed(spec);
  expect_sound(mesh, plate(), "grid");
  const auto wanted = [](const Vec2& p) { // one hat of the bilinear interpolation
    const double u = std::max(0.0, 1.0 - std::abs(p.x() - 20.0) / 10.0),
                 v = std::max(0.0, 1.0 - std::abs(p.y()) / 10.0);
    return 4.0 - 3.2 * u * v;
  };
  for (const Triangle& t : mesh.triangles) {
    const auto x = corners_of(mesh, t);
    const Vec2 middle = (x[0] + x[1] + x[2]) / 3.0;
    for (const Vec2& p : {x[0], x[1], x[2], middle})
      EXPECT_LE(size_of(x, MeshKind::alternating), limit * wanted(p));
  }
  grid.size.assign(35, 1.25); // as element_size = 1.25 everywhere
  spec.sizes = grid;
  EXPECT_EQ(meshed(spec).triangles.size(), 2u * 48u * 32u);
  grid.size.pop_back();
  spec.sizes = grid;
  EXPECT_THROW(meshed(spec), std::invalid_argument);
}

TEST(GradedMesh, PutsNewNodesOfRoundRimsOnTheArc) {
  Outline ring;
  append_circle(ring, {3, -5}, 50.0);
  append_circle(ring, {0, 0}, 9.0);
  for (const MeshKind kind : {MeshKind::alternating, MeshKind::fibres, MeshKind::free}) {
    const BlankMesh mesh = meshed(
        blank_with(ring, kind, 7.0, {disc_zone({53, -5}, 20, 1.0), disc_zone({0, 9}, 6, 0.5)}));
    const Measures m = measure(mesh);
    EXPECT_GT(m.smallest_double_area, 0.0);
    EXPECT_EQ(m.rim_loops, 2u);
    EXPECT_EQ(m.bad_nodes, 0u);
    EXPECT_LE(m.most_triangles_on_edge, 2u);
    EXPECT_GE(m.min_angle / degree, 10.0); // half of the 20 degrees of the band
    std::map<std::pair<int, int>, int> uses;
    for (const Triangle& t : mesh.triangles)
      for (std::size_t k = 0; k < 3; ++k)
        ++uses[std::minmax(t[k], t[(k + 1) % 3])];
    std::size_t rim = 0;
    for (const auto& [side, count] : uses) {
      if (count != 1) continue;
      ++rim;
      const Vec2& p = mesh.x[at(side.first)];
      EXPECT_LE(std::min(std::abs((p - Vec2(3, -5)).norm() - 50.0), std::abs(p.norm() - 9.0)),
                1e-12);
    }
    EXPECT_GT(rim, 75u);
  }
}

TEST(GradedMesh, FreeMeshesHaveTheMeanEdgeThatIsAsked) {
  const BlankSpec spec =
      blank_with(plate(), MeshKind::free, 6.0, {polygon_zone(rectangle(-40, -40, 70, 70), 1.5)});
  const BlankMesh all = meshed(spec);
  expect_sound(all, plate(), "free");
  EXPECT_NEAR(measure(all).mean_edge / 1.5, 1.0, 0.05); // as uniform free meshes, to 5 %
  EXPECT_GE(measure(all).min_angle / degree, 20.0);
  const BlankSpec partly =
      blank_with(pierced_l(), MeshKind::free, 25.0, {disc_zone({150, 150}, 40, 4.0)});
  const BlankMesh mesh = meshed(partly);
  expect_sound(mesh, pierced_l(), "L");
  double sum = 0.0, count = 0.0;
  for (const Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 a = mesh.x[at(t[k])], b = mesh.x[at(t[(k + 1) % 3])];
      if ((a - Vec2(150, 150)).norm() > 40 || (b - Vec2(150, 150)).norm() > 40) continue;
      sum += (a - b).norm(), count += 1.0;
    }
  EXPECT_NEAR(sum / count / 4.0, 1.0, 0.08); // few edges
  EXPECT_LT(mesh.triangles.size(), 3500u);
}

TEST(GradedMesh, HasHardlyATriangleWithoutAMate) {
  for (const MeshKind kind : {MeshKind::diagonal, MeshKind::alternating, MeshKind::crossed,
                              MeshKind::fibres, MeshKind::free}) {
    const BlankMesh mesh = meshed(blank_with(plate(), kind, 3.0, {disc_zone({0, 0}, 12, 0.7, 6)}));
    const StrainGroups groups = pair_triangles(mesh);
    const double n = static_cast<double>(mesh.triangles.size());
    const double alone = 2.0 * static_cast<double>(groups.begin.size() - 1) - n;
    EXPECT_LE(alone, 0.01 * n) << static_cast<int>(kind);
  }
}

TEST(GradedMesh, IsTheSameEveryTimeAndTheUniformOneIfNothingIsAsked) {
  for (const MeshKind kind : {MeshKind::alternating, MeshKind::free}) {
    BlankSpec spec = blank_with(pierced_pentagon(), kind, 20.0, {disc_zone({100, 100}, 30, 5)});
    const BlankMesh once = meshed(spec), again = meshed(spec);
    EXPECT_EQ(once.x, again.x);
    EXPECT_EQ(once.triangles, again.triangles);
  }
  BlankSpec spec =
      blank_with(pierced_pentagon(), MeshKind::alternating, 20.0, {disc_zone({100, 100}, 30, 20)});
  EXPECT_EQ(meshed(spec).x, uniform(spec).x);
  EXPECT_EQ(meshed(spec).triangles, uniform(spec).triangles);
}

TEST(GradedMesh, RefusesFarTooSmallElements) {
  for (const MeshKind kind : {MeshKind::alternating, MeshKind::free}) {
    const auto message = [&](double radius, double size) {
      return message_of([&] {
        meshed(blank_with(plate(), kind, 10.0, {disc_zone({0, 0}, radius, size)}));
      });
    };
    EXPECT_NE(message(0.01, 0.001).find("more than 4096 times smaller"), std::string::npos);
    EXPECT_NE(message(20.0, 0.01).find("triangles, more than 1e+07"), std::string::npos);
    EXPECT_EQ(message(0.05, 0.01), "");
  }
}

TEST(GradedMesh, ExpectsAboutAsManyTrianglesAsThereAre) {
  for (const MeshKind kind : {MeshKind::alternating, MeshKind::crossed, MeshKind::free}) {
    BlankSpec spec = blank_with(plate(), kind, 4.0, {disc_zone({0, 0}, 10, 1.0)});
    EXPECT_NEAR(expected_triangles(spec) / static_cast<double>(meshed(spec).triangles.size()), 1.0,
                0.3);
    EXPECT_EQ(smallest_wanted(spec), 1.0);
    spec.zones.clear();
    spec.sizes = SizeGrid{{0, 0}, 30.0, 2, 1, {1.0, 3.0}};
    EXPECT_NEAR(expected_triangles(spec) / static_cast<double>(meshed(spec).triangles.size()), 1.0,
                0.3);
  }
}

/// Halves of halves of a right-angled triangle with equal legs, through three rounds of marks.
TEST(Bisection, CutsWhatLiesBesideUntilNoNodeIsInASide) {
  Bisection b = start_bisection(uniform(blank_with(plate(), MeshKind::alternating, 10.0, {})));
  for (int round = 0; round < 12; ++round) {
    std::vector<char> marked(b.mesh.triangles.size(), 0);
    for (std::size_t e = 0; e < marked.size(); ++e) // what touches one corner
      for (const int n : b.mesh.triangles[e])
        if (b.mesh.x[at(n)] == Vec2(-30, -20)) marked[e] = 1;
    const std::size_t before = b.mesh.triangles.size();
    const std::vector<char> fresh = bisect(b, marked);
    ASSERT_EQ(fresh.size(), b.mesh.triangles.size());
    EXPECT_GT(b.mesh.triangles.size(), before);
    expect_sound(b.mesh, plate(), "round");
  }
  EXPECT_NEAR(std::sqrt(measure(b.mesh).smallest_double_area), 10.0 / 64.0, 1e-9); // 2^(-12/2)
  EXPECT_LT(b.mesh.triangles.size(), 120u); // geometric: a few more for each round
}

} // namespace
} // namespace plyform::graded_mesh_test
