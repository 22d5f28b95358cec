// SPDX-License-Identifier: GPL-3.0-or-later
// Outlines with arcs: nodes on them, area against the exact one, and meshes as good as those of
// squares.
#include "core/mesh/mesh_ply.hpp"
#include "support/blank_checks.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace plyform::round_blank_test {
namespace {

using namespace blank_checks;
constexpr double pi = std::numbers::pi;
constexpr MeshKind meshes[] = {MeshKind::diagonal, MeshKind::alternating, MeshKind::crossed,
                               MeshKind::fibres, MeshKind::free};

Outline round(double radius) {
  Outline outline;
  append_circle(outline, {3, -5}, radius);
  return outline;
}

/// Standard deviation of the triangles' areas over their mean.
double spread(const BlankMesh& mesh) {
  double sum = 0.0, squares = 0.0;
  for (const Triangle& t : mesh.triangles) {
    const double area = 0.5 * turn(mesh.x[t[1]] - mesh.x[t[0]], mesh.x[t[2]] - mesh.x[t[0]]);
    sum += area;
    squares += area * area;
  }
  const double n = static_cast<double>(mesh.triangles.size()), mean = sum / n;
  return std::sqrt(std::max(0.0, squares / n - mean * mean)) / mean;
}

/// The number of nodes on the circle, and the largest distance of a rim node from it, mm.
std::pair<std::size_t, double> rim(const BlankMesh& mesh, const Vec2& centre, double radius) {
  std::map<std::pair<int, int>, int> uses;
  for (const Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      ++uses[std::minmax(t[k], t[(k + 1) % 3])];
  std::size_t count = 0;
  double off = 0.0;
  for (const auto& [edge, n] : uses) {
    if (n != 1) continue;
    ++count; // as many edges as nodes
    for (const int node : {edge.first, edge.second})
      off = std::max(off, std::abs((mesh.x[node] - centre).norm() - radius));
  }
  return {count, off};
}

TEST(RoundBlank, HasItsRimOnTheCircleAndElementsLikeThoseOfASquare) {
  const double radius = 100.0, h = 6.8, side = radius * std::sqrt(pi); // of the same area
  for (const MeshKind kind : meshes) {
    const auto made = [&](const Outline& outline) {
      return mesh_blank({outline, kind, h, {}}, 0.6, 0.6 + 0.5 * pi);
    };
    const BlankMesh disc = made(round(radius));
    const double s = 0.5 * side; // its sides askew to all cells
    const Eigen::Rotation2Dd askew(0.3);
    const BlankMesh square = made(
        {{askew * Vec2(-s, -s), askew * Vec2(s, -s), askew * Vec2(s, s), askew * Vec2(-s, s)}, {}});
    const Measures d = measure(disc), q = measure(square);
    const auto [count, off] = rim(disc, {3, -5}, radius);
    const double n = static_cast<double>(count), exact = pi * radius * radius;
    fmt::print("mesh {}: disc of {} triangles, smallest angle {:.1f}, spread {:.3f}, area {:.5f} "
               "of the exact; square {:.1f}, {:.3f}\n",
               static_cast<int>(kind), disc.triangles.size(), d.min_angle / degree, spread(disc),
               d.area / exact, q.min_angle / degree, spread(square));
    EXPECT_LE(off, 1e-13 * radius);
    EXPECT_NEAR(d.area, 0.5 * n * radius * radius * std::sin(2.0 * pi / n), 1e-9 * exact);
    EXPECT_NEAR(d.area / exact, 1.0, 1e-3);
    EXPECT_NEAR(2.0 * pi * radius / n / h, 1.0, 0.03); // pieces of about the element size
    EXPECT_GE(d.min_angle / degree, 20.0 - 1e-9);
    EXPECT_GE(d.min_angle, q.min_angle - 2.0 * degree);
    EXPECT_LE(spread(disc), spread(square) + 0.05);
    EXPECT_EQ(d.bad_nodes, 0u);
    EXPECT_EQ(d.rim_loops, 1u);
  }
}

TEST(RoundBlank, SmallArcsHaveEightPiecesToTheTurn) {
  Outline outline{rectangle(-50, -50, 50, 50), {}};
  append_circle(outline, {10, 0}, 2.0);
  const BlankMesh mesh = mesh_blank({outline, MeshKind::free, 10.0, {}}, 0, 0.5 * pi);
  EXPECT_EQ(measure(mesh).rim_loops, 2u);
  const double octagon = 4.0 * 4.0 * std::sin(pi / 4.0);
  EXPECT_NEAR(measure(mesh).area, 10000.0 - octagon, 1e-9);
}

TEST(RoundBlank, AreaOfOutlinesIsExact) {
  EXPECT_NEAR(area_of(round(20.0)), pi * 400.0, 1e-9);
  Outline rounded;
  append_loop(rounded,
              round_corners({{0, 0, 5}, {40, 0, 5}, {40, 20, 5}, {0, 20, 5}}, true, {"", "", ""}));
  EXPECT_NEAR(area_of(rounded), 800.0 - (4.0 - pi) * 25.0, 1e-9);
  append_circle(rounded, {20, 10}, 3.0);
  EXPECT_NEAR(area_of(rounded), 800.0 - (4.0 - pi) * 25.0 - 9.0 * pi, 1e-9);
  // the same clockwise, the corners rounded outwards: a notch
  Outline notch;
  append_loop(notch, {{ProfileSegment::Kind::line, {0, 0}, {0, 10}},
                      {ProfileSegment::Kind::line, {0, 10}, {10, 10}},
                      {ProfileSegment::Kind::arc, {10, 10}, {10, 0}, {10, 5}, 1},
                      {ProfileSegment::Kind::line, {10, 0}, {0, 0}}});
  EXPECT_NEAR(area_of(notch), 100.0 - 0.5 * pi * 25.0, 1e-9);
}

TEST(RoundBlank, ArcsThatCrossOrTouchAreRejectedByPlace) {
  Outline outline = round(100.0);
  append_circle(outline, {80, -5}, 30.0);
  const std::string message = message_of([&] {
    mesh_blank({outline, MeshKind::free, 10.0, {}}, 0, 0.5 * pi);
  });
  EXPECT_NE(message.find("blank outline: the part from ("), std::string::npos) << message;
  EXPECT_NE(message.find("of hole 0 crosses or touches the part from ("), std::string::npos)
      << message;
  EXPECT_FALSE(takes_elements({outline, MeshKind::free, 10.0, {}}));
}

/// Half a millimetre is left between hole and rim: coarse pieces of both would cross.
TEST(RoundBlank, ArcsThatWouldCrossWhenMeshedAreRejected) {
  Outline outline = round(100.0);
  append_circle(outline, Vec2(3, -5) + Eigen::Rotation2Dd(pi / 8.0) * Vec2(60, 0), 39.5);
  EXPECT_TRUE(takes_elements({outline, MeshKind::free, 3.0, {}}));
  EXPECT_FALSE(takes_elements({outline, MeshKind::free, 80.0, {}}));
}

Case one_ply(MeshKind kind) {
  Case data;
  data.fabrics = {woven_fabric()};
  BlankSpec blank;
  blank.outline = {rectangle(-30, -10, 30, 10), {}};
  blank.mesh = kind;
  blank.element_size = 5.0;
  data.blanks = {blank};
  data.plies = {{"ply", 0, 0, 0.4, 0.0}};
  return data;
}

TEST(PlyPlace, SeedAndRotationMoveTheMeshWithTheBlank) {
  Case data = one_ply(MeshKind::alternating);
  const BlankMesh flat = mesh_ply(data, data.plies[0]);
  data.plies[0].seed = {100, 50};
  data.plies[0].rotation = 0.5 * pi;
  const BlankMesh moved = mesh_ply(data, data.plies[0]);
  ASSERT_EQ(moved.triangles, flat.triangles);
  for (std::size_t n = 0; n < flat.x.size(); ++n)
    EXPECT_LE((moved.x[n] - Vec2(100 - flat.x[n].y(), 50 + flat.x[n].x())).norm(), 1e-12);
}

/// With mesh = "fibres" every side but the diagonals runs along the yarns, which stay at the angle.
TEST(PlyPlace, YarnsStayAtTheirAngleWhenTheBlankTurns) {
  Case data = one_ply(MeshKind::fibres);
  data.plies[0].rotation = 1.1;
  const BlankMesh mesh = mesh_ply(data, data.plies[0]);
  const Vec2 warp(std::cos(0.4), std::sin(0.4)), weft(-warp.y(), warp.x());
  std::size_t along = 0;
  for (const Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 side = (mesh.x[t[(k + 1) % 3]] - mesh.x[t[k]]).normalized();
      along += std::max(std::abs(side.dot(warp)), std::abs(side.dot(weft))) > 1.0 - 1e-12;
    }
  EXPECT_GT(3 * along, 2 * mesh.triangles.size()); // two of three inside, none in the band
}

// A rounding of a thousandth of an element would make elements as small, and with them the steps.
TEST(RoundBlank, CornersMuchSmallerThanElementsAreSharp) {
  constexpr double h = 8.0;
  for (const double radius : {5e-6, 1e-3, 0.05}) {
    Outline rounded, sharp;
    append_loop(
        rounded,
        round_corners({{-40, -40, radius}, {40, -40, radius}, {40, 40, radius}, {-40, 40, radius}},
                      true, {}));
    sharp.boundary = rectangle(-40, -40, 40, 40);
    EXPECT_EQ(merged_corners(rounded, h), 4u);
    for (const MeshKind kind : meshes) {
      BlankSpec spec;
      spec.element_size = h;
      spec.mesh = kind;
      spec.outline = rounded;
      const BlankMesh mesh = mesh_blank(spec, 0.3, 0.3 + 0.5 * pi);
      double covered = 0.0, least = h;
      for (const Triangle& t : mesh.triangles) {
        covered += 0.5 * turn(mesh.x[t[1]] - mesh.x[t[0]], mesh.x[t[2]] - mesh.x[t[0]]);
        for (std::size_t k = 0; k < 3; ++k)
          least = std::min(least, (mesh.x[t[(k + 1) % 3]] - mesh.x[t[k]]).norm());
      }
      EXPECT_NEAR(covered, area_of(sharp), 2.0 * 80.0 * radius + 1e-6) << radius; // 4 sides turn
      EXPECT_GT(least, 0.1 * h) << radius;
    }
  }
  EXPECT_EQ(merged_corners(round(0.05), h), 0u); // a hole has to have three
}

// The piece that is left of a side and a corner is the side, wherever the loop begins.
TEST(RoundBlank, SidesKeepTheirArcsBesideCornersThatAreLeftOut) {
  Outline outline; // half a disc of 40 mm, its corners rounded by next to nothing
  const Vec2 left(-40.0, 0.0), right(40.0, 0.0), near(40.0, 0.001);
  append_loop(outline, {{ProfileSegment::Kind::line, left, right, {}, 0},
                        {ProfileSegment::Kind::line, right, near, {}, 0},
                        {ProfileSegment::Kind::arc, near, left, {0.0, 0.0}, 1}});
  EXPECT_EQ(merged_corners(outline, 8.0), 1u);
  BlankSpec spec;
  spec.element_size = 8.0;
  spec.mesh = MeshKind::free;
  spec.outline = outline;
  const BlankMesh mesh = mesh_blank(spec, 0.0, 0.5 * pi);
  for (const Vec2& x : mesh.x)
    EXPECT_LT(x.norm(), 40.001);
  double covered = 0.0;
  for (const Triangle& t : mesh.triangles)
    covered += 0.5 * turn(mesh.x[t[1]] - mesh.x[t[0]], mesh.x[t[2]] - mesh.x[t[0]]);
  EXPECT_NEAR(covered, 0.5 * pi * 1600.0, 0.01 * 0.5 * pi * 1600.0);
}

} // namespace
} // namespace plyform::round_blank_test
