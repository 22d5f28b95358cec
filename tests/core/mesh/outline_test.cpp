// SPDX-License-Identifier: GPL-3.0-or-later
// Outlines that cannot be meshed, and what the user is told.
#include "support/blank_checks.hpp"

#include <gtest/gtest.h>
#include <limits>

namespace plyform::outline_test {
namespace {

using namespace blank_checks;

std::string error_of(const Outline& outline, double h = 10, MeshKind kind = MeshKind::free) {
  return message_of([&] { mesh_blank({outline, kind, h, {}}, 0, 90 * degree); });
}

Outline pierced(std::vector<std::vector<Vec2>> holes) {
  return {rectangle(0, 0, 100, 80), std::move(holes)};
}

TEST(BlankOutline, NeedsThreePoints) {
  EXPECT_EQ(error_of({{{0, 0}, {1, 0}}, {}}),
            "blank outline: the boundary has 2 points, at least 3 are needed; add its missing "
            "corners");
  EXPECT_EQ(error_of({{}, {}}), "blank outline: the boundary has 0 points, at least 3 are needed; "
                                "add its missing corners");
  EXPECT_EQ(error_of(pierced({rectangle(10, 10, 20, 20), {{30, 30}}})),
            "blank outline: hole 1 has 1 points, at least 3 are needed; add its missing corners");
}

TEST(BlankOutline, NeedsFinitePoints) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    EXPECT_EQ(error_of({{{0, 0}, {100, 0}, {100, bad}}, {}}),
              "blank outline: point 2 of the boundary is not finite; give both coordinates as "
              "numbers in mm");
}

TEST(BlankOutline, MayNotRepeatAPoint) {
  EXPECT_EQ(error_of({{{0, 0}, {100, 0}, {100, 0}, {100, 80}}, {}}),
            "blank outline: points 1 and 2 of the boundary are both (100, 0); leave one of them "
            "out");
  EXPECT_EQ(error_of({{{0, 0}, {100, 0}, {100, 80}, {0, 0}}, {}}),
            "blank outline: the last point of the boundary repeats the first, (0, 0); leave it "
            "out, the outline is closed without it");
}

TEST(BlankOutline, MustEncloseAnArea) {
  EXPECT_EQ(error_of({{{0, 0}, {50, 50}, {100, 100}}, {}}),
            "blank outline: the boundary encloses no area, its points lie on one line; correct the "
            "points");
}

TEST(BlankOutline, MayNotCrossItself) {
  EXPECT_EQ(error_of({{{0, 0}, {100, 80}, {100, 0}, {0, 80}}, {}}),
            "blank outline: side 0 from (0, 0) to (100, 80) and side 2 from (100, 0) to (0, 80) of "
            "the boundary cross or touch; list the points in order around it, each once");
  // Touching itself in a corner.
  EXPECT_NE(error_of({{{0, 0}, {100, 0}, {50, 40}, {100, 80}, {0, 80}, {50, 40}}, {}})
                .find("of the boundary cross or touch"),
            std::string::npos);
  // Touching itself but for a gap as fine as no mesh is, which the mesher would not end in.
  for (const double gap : {1e-300, 1e-12})
    EXPECT_NE(error_of({{{0, 0}, {100, 0}, {100, 80}, {50, gap}, {0, 80}}, {}})
                  .find("of the boundary cross or touch"),
              std::string::npos)
        << gap;
  EXPECT_EQ(error_of({{{0, 0}, {100, 0}, {100, 80}, {50, 0.01}, {0, 80}}, {}}), "");
  // Folding back on itself.
  EXPECT_EQ(error_of({{{0, 0}, {100, 0}, {40, 0}, {40, 80}}, {}}),
            "blank outline: side 0 from (0, 0) to (100, 0) and side 1 from (100, 0) to (40, 0) of "
            "the boundary cross or touch; list the points in order around it, each once");
  EXPECT_NE(error_of(pierced({{{10, 10}, {30, 30}, {30, 10}, {10, 30}}})).find("of hole 0 cross"),
            std::string::npos);
}

TEST(BlankOutline, HolesLieInsideTheBoundary) {
  EXPECT_EQ(error_of(pierced({rectangle(110, 10, 120, 20)})),
            "blank outline: hole 0 lies outside the boundary, its first point is (110, 10); move "
            "it inside or leave it out");
  EXPECT_EQ(error_of(pierced({rectangle(-10, -10, 120, 120)})),
            "blank outline: hole 0 lies outside the boundary, its first point is (-10, -10); move "
            "it inside or leave it out");
  EXPECT_EQ(error_of(pierced({rectangle(90, 10, 110, 20)})),
            "blank outline: side 0 from (90, 10) to (110, 10) of hole 0 crosses or touches side 1 "
            "from (100, 0) to (100, 80) of the boundary; move or shrink the hole");
  // One corner on the boundary.
  EXPECT_EQ(error_of(pierced({{{50, 0}, {60, 10}, {40, 10}}})),
            "blank outline: side 0 from (50, 0) to (60, 10) of hole 0 crosses or touches side 0 "
            "from (0, 0) to (100, 0) of the boundary; move or shrink the hole");
}

TEST(BlankOutline, HolesAreApart) {
  EXPECT_EQ(error_of(pierced({rectangle(10, 10, 30, 30), rectangle(30, 15, 40, 25)})),
            "blank outline: side 0 from (30, 15) to (40, 15) of hole 1 crosses or touches side 1 "
            "from (30, 10) to (30, 30) of hole 0; move or shrink the hole");
  EXPECT_EQ(error_of(pierced({rectangle(10, 10, 40, 40), rectangle(20, 20, 30, 30)})),
            "blank outline: hole 1 lies inside hole 0; leave it out");
  EXPECT_EQ(error_of(pierced({rectangle(20, 20, 30, 30), rectangle(10, 10, 40, 40)})),
            "blank outline: hole 0 lies inside hole 1; leave it out");
}

TEST(BlankOutline, ElementSizeIsPositiveAndFitsTheBlank) {
  EXPECT_EQ(error_of(pierced({}), 0), "blank outline: element_size 0 mm must be greater than 0");
  EXPECT_EQ(error_of(pierced({}), -3), "blank outline: element_size -3 mm must be greater than 0");
  EXPECT_EQ(error_of(pierced({}), std::numeric_limits<double>::quiet_NaN()),
            "blank outline: element_size unknown mm must be greater than 0");
  for (const MeshKind kind :
       {MeshKind::diagonal, MeshKind::crossed, MeshKind::fibres, MeshKind::free})
    EXPECT_EQ(error_of(pierced({}), 80.1, kind),
              "blank outline: element_size 80.1 mm is larger than the blank's smallest width 80 "
              "mm; choose less, usually a twentieth of it");
  EXPECT_EQ(error_of(pierced({}), 80), "");
  EXPECT_EQ(error_of(pierced({}), 1e-4),
            "blank outline: element_size 0.0001 mm would give 1.6e+12 triangles, more than 1e+07; "
            "choose at least 0.04 mm");
}

TEST(BlankOutline, SmallestWidthIsThatOfTheShapeNotOfItsBoundingBox) {
  Outline strip{rectangle(0, 0, 200, 20), {}}; // bounding box 156 x 156 once turned
  for (Vec2& p : strip.boundary)
    p = Eigen::Rotation2Dd(45 * degree) * p;
  EXPECT_NE(error_of(strip, 21).find("smallest width 20 mm"), std::string::npos);
  EXPECT_EQ(error_of(strip, 20), "");
}

} // namespace
} // namespace plyform::outline_test
