// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers of a fabric that its file leaves out: which cases get them, which values, what is said.
#include "core/model/bending_resolution.hpp"
#include "core/model/fabric_estimates.hpp"
#include "core/setup/prepare_case.hpp"
#include "support/membrane_checks.hpp"

#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <unistd.h>

namespace plyform::fabric_estimates_test {
namespace {

namespace fs = std::filesystem;

/// A case of so many plies of one fabric, with these lines in its warp and weft, and settings.
struct Stack {
  int plies = 2;
  std::string warp{}, weft{}, fabric{}, shear = "polynomial = [0.37044, 0.84105, 1.03113]";
  double size = 6.0, softening = 1.0; ///< mm of the elements
};

PreparedCase read_stack(const Stack& stack) {
  std::string text =
      fmt::format("[fabrics.glass]\nsurface_density = 600.0\nthickness = 0.6\n{}\n"
                  "[fabrics.glass.warp]\ndensity = 0.25\nstiffness = 46000.0\n{}\n"
                  "[fabrics.glass.weft]\ndensity = 0.25\nstiffness = 48000.0\n{}\n"
                  "[fabrics.glass.shear]\n{}\n"
                  "[blanks.square]\nsize = [60.0, 60.0]\nelement_size = {}\n"
                  "[solver]\nfibre_softening = {}\n",
                  stack.fabric, stack.warp, stack.weft, stack.shear, stack.size, stack.softening);
  for (int i = 0; i < stack.plies; ++i)
    text += fmt::format("[[ply]]\nname = \"ply{}\"\nfabric = \"glass\"\nblank = \"square\"\n"
                        "angle = 0.0\n",
                        i);
  const fs::path file =
      fs::path(::testing::TempDir()) / fmt::format("plyform_estimates_{}.toml", getpid());
  std::ofstream(file) << text;
  const PreparedCase reading = prepare_case(file, {});
  fs::remove(file);
  return reading;
}

Case case_of(const Stack& stack) {
  const PreparedCase reading = read_stack(stack);
  EXPECT_TRUE(reading.value) << (reading.errors.empty() ? "" : reading.errors[0].text());
  return reading.value.value_or(Case{});
}

TEST(Estimates, AreGivenToAStackWithTheirReasons) {
  const Case data = case_of({});
  const Fabric& f = data.fabrics.at(0);
  EXPECT_EQ(f.families[0].tension.compression, 460.0);
  EXPECT_EQ(f.families[1].tension.compression, 480.0);
  EXPECT_NEAR(f.families[0].bending.stiffness, 6e-10 * 9810.0 * 343000.0, 1e-12); // 2.02 N mm
  EXPECT_EQ(f.families[1].bending.stiffness, f.families[0].bending.stiffness);
  EXPECT_NEAR(f.twist, f.families[0].bending.stiffness, 1e-12);
  EXPECT_NEAR(f.families[0].in_plane_bending, 0.0625 * 0.37044 * 400.0, 1e-12); // 9.26 N mm
  EXPECT_EQ(f.families[1].in_plane_bending, f.families[0].in_plane_bending);
  EXPECT_EQ(describe_estimates(data).at(0),
            "glass: compression 460 / 480 N per yarn (1 % of tension), bending 2 N mm (bending "
            "length 70 mm), in-plane bending 9.3 N mm (zones of 20 mm): estimated, since a stack "
            "of plies presses its yarns; give the keys, or compression_stiffness = 0 for yarns "
            "that carry tension only");
}

TEST(Estimates, LeaveOnePlyAsItsFileHasIt) {
  const Case data = case_of({.plies = 1});
  EXPECT_EQ(data.fabrics[0].families[0].tension.compression, 0.0);
  EXPECT_FALSE(bending_law(data.fabrics[0]).any());
  EXPECT_TRUE(describe_estimates(data).empty());
}

TEST(Estimates, DoNotFollowTheElements) {
  const Fabric fine = case_of({.size = 3.0}).fabrics[0],
               coarse = case_of({.size = 20.0}).fabrics[0];
  EXPECT_EQ(fine.families[0].bending.stiffness, coarse.families[0].bending.stiffness);
  for (std::size_t a = 0; a < 2; ++a)
    EXPECT_EQ(fine.families[a].in_plane_bending, coarse.families[a].in_plane_bending);
}

TEST(Estimates, StayAwayFromYarnsThatCarryTensionOnly) {
  const Case both =
      case_of({.warp = "compression_stiffness = 0", .weft = "compression_stiffness = 0.0"});
  EXPECT_EQ(both.fabrics[0].families[0].tension.compression, 0.0);
  EXPECT_FALSE(bending_law(both.fabrics[0]).any());
  EXPECT_TRUE(describe_estimates(both).empty());
  const Case one = case_of({.warp = "compression_stiffness = 0.0"});
  EXPECT_EQ(one.fabrics[0].families[0].in_plane_bending, 0.0);
  EXPECT_GT(one.fabrics[0].families[1].in_plane_bending, 0.0);
  EXPECT_EQ(one.fabrics[0].twist, 0.0);
  EXPECT_NE(describe_estimates(one).at(0).find("compression 480 N per yarn along the weft"),
            std::string::npos);
}

TEST(Estimates, FillInOnlyWhatIsMissing) {
  const Fabric f = case_of({.warp = "bending_stiffness = 0.0\nin_plane_bending_stiffness = 0.0",
                            .weft = "compression_stiffness = 50.0\nbending_stiffness = 8.0",
                            .fabric = "twist_stiffness = 0.0"})
                       .fabrics[0];
  EXPECT_EQ(f.families[0].tension.compression, 460.0);
  EXPECT_EQ(f.families[0].bending.stiffness, 0.0);
  EXPECT_EQ(f.families[0].in_plane_bending, 0.0);
  EXPECT_EQ(f.families[1].tension.compression, 50.0);
  EXPECT_EQ(f.families[1].bending.stiffness, 8.0);
  EXPECT_GT(f.families[1].in_plane_bending, 0.0);
  EXPECT_EQ(f.twist, 0.0); // as given
}

TEST(Estimates, GiveYarnsThatBendOrBuckleTheirCompressionInOnePlyToo) {
  const Case data =
      case_of({.plies = 1, .warp = "bending_stiffness = 2.0", .weft = "buckling_force = 3"});
  EXPECT_EQ(data.fabrics[0].families[0].tension.compression, 460.0);
  EXPECT_EQ(data.fabrics[0].families[1].tension.compression, 480.0);
  EXPECT_EQ(data.fabrics[0].families[0].in_plane_bending, 0.0);
  EXPECT_NE(describe_estimates(data).at(0).find("since yarns that bend"), std::string::npos);
}

TEST(Estimates, OfInPlaneBendingTakeTheSecantWhereShearStartsWithNothing) {
  const Fabric table =
      case_of({.shear = "table = [[0.0, 0.0], [10.0, 0.0], [40.0, 0.6]]"}).fabrics[0];
  EXPECT_NEAR(table.families[0].in_plane_bending,
              0.0625 * table.crossings[0].shear.secant(0.5) * 400.0, 1e-12);
  EXPECT_GT(table.families[0].in_plane_bending, 0.0);
  const Fabric none = case_of({.shear = "polynomial = [0.0]"}).fabrics[0];
  EXPECT_EQ(none.families[0].in_plane_bending, 0.0);
  EXPECT_GT(none.families[0].bending.stiffness, 0.0);
}

/// Bundles bend by their own fibres: those of a tape as those of a weave that has as many of them
/// in each direction, which is twice as heavy; across, and in its plane, by the sheet.
TEST(Estimates, OfOneFamilyAreThoseOfAWeaveWithAsManyFibresAlongIt) {
  const Fabric tape = unidirectional();
  Fabric weave = glass_weave();
  weave.surface_density = 2.0 * tape.surface_density;
  EXPECT_NEAR(usual_bending(tape, tape.families[0]), usual_bending(weave, weave.families[0]),
              1e-12);
  EXPECT_NEAR(usual_bending_across(tape), tape.weight() * 8000.0, 1e-15);
  EXPECT_NEAR(shear_rigidity(tape), 3.0 / 2.4, 1e-15);                       // E t / (2 (1 + nu))
  EXPECT_NEAR(usual_in_plane_bending(tape), 3.0 / 2.4 * 10.0 * 10.0, 1e-12); // 2.5 cells of 4 mm
  Fabric bent = tape;
  bent.families[0].bending.stiffness = 4.0, bent.plate = 0.5;
  EXPECT_NEAR(usual_twist(bent), std::sqrt(4.5 * 0.5), 1e-15);
}

/// The share of a family is that of its fibres.
TEST(Estimates, OfThreeFamiliesGoByTheirShareOfTheFibres) {
  Fabric f = triaxial();
  f.families[2].density *= 2.0;
  const double half = usual_bending(f, f.families[2]), other = usual_bending(f, f.families[0]);
  EXPECT_NEAR(half, 2.0 * other * f.families[2].tension.stiffness / f.families[0].tension.stiffness,
              1e-12);
  double all = 0.0;
  for (const YarnFamily& family : f.families)
    all += usual_bending(f, family);
  EXPECT_NEAR(all, 2.0 * f.weight() * 343000.0, 1e-12);
  EXPECT_EQ(usual_twist(f), 0.0);
}

TEST(Estimates, AreGivenToAStackOfTapes) {
  std::string text = "[fabrics.tape]\nsurface_density = 300.0\nthickness = 0.3\n"
                     "[[fabrics.tape.family]]\nname = \"tow\"\nangle = 0.0\ndensity = 0.5\n"
                     "stiffness = 40000.0\n"
                     "[fabrics.tape.sheet]\nyoungs_modulus = 0.4\npoissons_ratio = 0.2\n"
                     "[blanks.square]\nsize = [60.0, 60.0]\nelement_size = 4.0\n";
  for (const char* name : {"lower", "upper"})
    text += fmt::format("[[ply]]\nname = \"{}\"\nfabric = \"tape\"\nblank = \"square\"\n"
                        "angle = 0.0\n",
                        name);
  const fs::path file =
      fs::path(::testing::TempDir()) / fmt::format("plyform_tapes_{}.toml", getpid());
  std::ofstream(file) << text;
  const PreparedCase reading = prepare_case(file, {});
  fs::remove(file);
  ASSERT_TRUE(reading.value) << reading.errors.at(0).text();
  const Fabric& f = reading.value->fabrics.at(0);
  EXPECT_EQ(f.families[0].tension.compression, 400.0);
  EXPECT_NEAR(f.families[0].bending.stiffness, 2.0 * f.weight() * 343000.0, 1e-12); // 2.0 N mm
  EXPECT_NEAR(f.plate, f.weight() * 8000.0, 1e-15);                                 // 0.024
  EXPECT_GT(f.twist, 0.0);
  EXPECT_EQ(bending_law(f).families.size(), 3u);
  EXPECT_NE(describe_estimates(*reading.value)
                .at(0)
                .find("bending across 0.024 N mm (bending length 20 mm, as of limp cloth)"),
            std::string::npos)
      << describe_estimates(*reading.value)[0];
}

TEST(Estimates, SofteningIsSaidWhereCompressionLimitsIt) {
  EXPECT_TRUE(describe_softening(case_of({.softening = 100.0})).empty());
  EXPECT_NE(describe_softening(case_of({.softening = 250.0})).at(0).find("by 100 and 100 only"),
            std::string::npos);
  EXPECT_TRUE(describe_softening(case_of({.plies = 1, .softening = 250.0})).empty());
}

TEST(Resolution, LengthsAreThoseOfTheirFormulas) {
  Fabric f = glass_weave();
  const BendingLengths none = bending_lengths(f, 0.003);
  EXPECT_FALSE(none.layer || none.sideways || none.upwards);
  f.families[0].tension.compression = f.families[1].tension.compression = 460.0;
  f.families[0].bending.stiffness = f.families[1].bending.stiffness = 2.0;
  f.families[0].in_plane_bending = 2.0;
  f.families[1].in_plane_bending = 8.0;
  const BendingLengths lengths = bending_lengths(f, 0.0034);
  const double rigidity = 0.0625 * 0.37044;
  EXPECT_NEAR(lengths.layer.value(), std::sqrt(2.0 / rigidity), 1e-12); // 9.3 mm
  EXPECT_NEAR(lengths.sideways.value(), 2.0 * M_PI * std::sqrt(4.0 / (0.2 - rigidity)), 1e-12);
  EXPECT_NEAR(lengths.upwards.value(), 2.0 * M_PI * std::cbrt(0.1 / 0.0034), 1e-12);
  EXPECT_NEAR(element_size_needed(lengths), lengths.layer.value() / 2.5, 1e-12);
  f.families[0].tension.buckling_force = f.families[1].tension.buckling_force =
      0.05; // less than shear holds: straight
  EXPECT_FALSE(bending_lengths(f, 0.0).sideways);
  EXPECT_FALSE(bending_lengths(f, 0.0).upwards);
}

TEST(Resolution, WarnsOfMeshesThatDoNotCarryTheYarnsBending) {
  EXPECT_TRUE(read_stack({.size = 7.5}).warnings.empty());
  const std::vector<std::string> coarse = read_stack({.size = 15.0}).warnings;
  ASSERT_EQ(coarse.size(), 1u); // once for both plies
  for (const char* part :
       {":15:1: warning: blanks.square, elements of 15 mm: is too coarse",
        "shear changes over 20 mm, 1.3 elements, and needs 2.5",
        "waves of 64.3 mm, 4.3 elements, and need 6", "elements of 8 mm would do"})
    EXPECT_NE(coarse[0].find(part), std::string::npos) << part << "\n" << coarse[0];
  EXPECT_TRUE(read_stack({.plies = 1, .size = 15.0}).warnings.empty());
  const Stack limp{.warp = "in_plane_bending_stiffness = 0",
                   .weft = "in_plane_bending_stiffness = 0"};
  ASSERT_EQ(read_stack(limp).warnings.size(), 1u);
  EXPECT_NE(read_stack(limp).warnings[0].find("9.3 N mm or so"), std::string::npos);
}

} // namespace
} // namespace plyform::fabric_estimates_test
