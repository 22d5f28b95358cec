// SPDX-License-Identifier: GPL-3.0-or-later
// What is said of what fabrics leave free or lock.
#include "core/model/fabric_freedoms.hpp"
#include "support/membrane_checks.hpp"

#include <gtest/gtest.h>

namespace plyform::fabric_freedoms_test {
namespace {

using Lines = std::vector<std::string>;

TEST(Freedoms, OfAWeaveAndOfAFoilAreNotTold) {
  EXPECT_EQ(describe_freedoms(glass_weave()), Lines{});
  EXPECT_EQ(describe_freedoms(foil()), Lines{});
}

TEST(Freedoms, OfOneFamilyAreTheSheets) {
  Fabric f = unidirectional(); // E t = 3 N/mm, nu = 0.2
  EXPECT_EQ(
      describe_freedoms(f),
      (Lines{"across tow and in shear the sheet alone holds it together, by 3.12 N/mm for its "
             "strain and 1.25 N/mm for the angle",
             "yarns of tow carry tension only: pressed along them the sheet alone resists"}));
  f.families[0].tension.compression = 460.0, f.families[0].bending.stiffness = 2.0;
  EXPECT_EQ(describe_freedoms(f).at(1),
            "across tow nothing resists bending: give sheet.bending_stiffness");
  f.plate = 0.1;
  EXPECT_EQ(describe_freedoms(f).size(), 1u);
}

TEST(Freedoms, OfTwoFamiliesWithoutACrossingAreShear) {
  Fabric f = glass_weave();
  f.families[0].tension.compression = f.families[1].tension.compression = 460.0;
  f.crossings.clear();
  EXPECT_EQ(describe_freedoms(f), (Lines{"nothing resists shear between warp and weft: it is free "
                                         "in its plane; give a [[crossing]] or a [sheet]"}));
  f.sheet = IsotropicLaw{2.6, 0.3};
  EXPECT_EQ(describe_freedoms(f), (Lines{"shear between warp and weft is resisted by the sheet "
                                         "alone, 1 N/mm for the angle"}));
}

TEST(Freedoms, ThreeFamiliesCannotShear) {
  const Lines lines = describe_freedoms(triaxial());
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_NE(lines[0].find("three families of yarns: the sheet cannot shear; it drapes only what "
                          "develops"),
            std::string::npos);
  EXPECT_EQ(lines[1],
            "yarns of warp and weft carry tension only: pressed along them it gives way without "
            "force");
}

} // namespace
} // namespace plyform::fabric_freedoms_test
