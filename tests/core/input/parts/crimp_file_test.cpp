// SPDX-License-Identifier: GPL-3.0-or-later
// Crimp as fabric files give it: cells of plain weaves and twills, and what is written again.
#include "core/input/parts/fabric_file.hpp"

#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <unistd.h>

namespace plyform::crimp_file_test {
namespace {

const std::string weave = R"(
surface_density = 600.0
thickness = 0.6
[warp]
density = 0.5
stiffness = 46000.0
[weft]
density = 0.25
stiffness = 48000.0
[shear]
polynomial = [0.37044]
[crimp]
)";

Fabric fabric_of(const std::string& text) {
  const std::filesystem::path file =
      std::filesystem::path(::testing::TempDir()) / fmt::format("crimp_{}.toml", getpid());
  std::ofstream(file, std::ios::binary) << text;
  const FabricReading reading = read_fabric_file(file, false);
  std::filesystem::remove(file);
  EXPECT_TRUE(reading.value) << text;
  return reading.value.value_or(Fabric{});
}

CrimpedCell cell_of(const std::string& keys) {
  const Fabric fabric = fabric_of(weave + keys);
  EXPECT_EQ(fabric.crossings.size(), 1u);
  EXPECT_TRUE(fabric.crossings.at(0).crimp);
  return fabric.crossings.at(0).crimp.value_or(CrimpedCell{});
}

/// Half a wave of the warp is one spacing of the weft, and the other way round.
TEST(CrimpFile, OfExcessLengthsIsAPlainWeave) {
  const CrimpedCell cell = cell_of("ratio = [0.005, 0.01]\n");
  EXPECT_DOUBLE_EQ(cell.half_wave[0], 4.0);
  EXPECT_DOUBLE_EQ(cell.half_wave[1], 2.0);
  EXPECT_NEAR(cell.height(0), std::sqrt(4.02 * 4.02 - 16.0), 1e-12);
  EXPECT_NEAR(cell.height(1), std::sqrt(2.02 * 2.02 - 4.0), 1e-12);
  EXPECT_EQ(cell.toe(0), 0.005);
}

/// Heights make twills: twice as high, of the same crimp, twice as long. Equally many
/// waves in both families: the cells per area are one number.
TEST(CrimpFile, OfHeightsSaysOverHowManyYarnsFloat) {
  const double high = 2.0 * std::sqrt(4.02 * 4.02 - 16.0),
               other = 2.0 * std::sqrt(2.02 * 2.02 - 4.0);
  const CrimpedCell cell =
      cell_of(fmt::format("ratio = [0.005, 0.01]\nheight = [{}, {}]\n", high, other));
  EXPECT_NEAR(cell.half_wave[0], 8.0, 1e-9);
  EXPECT_NEAR(cell.half_wave[1], 4.0, 1e-9);
  const CrimpedCell rounded = cell_of("ratio = [0.005, 0.01]\nheight = [0.8, 0.57]\n");
  EXPECT_NEAR(rounded.half_wave[0], 8.0, 0.1);
  EXPECT_DOUBLE_EQ(0.5 / rounded.half_wave[0], 0.25 / rounded.half_wave[1]);
  const CrimpedCell straight = cell_of("ratio = [0.005, 0.0]\nheight = [0.4005, 0.0]\n");
  EXPECT_EQ(straight.height(1), 0.0);
}

TEST(CrimpFile, IsKeptWhenALawIsWritten) {
  const std::string text = weave + "ratio = [0.005, 0.01]   # measured\n";
  const std::string written = with_law(text, {"shear", "polynomial", "[0.5]", {}});
  EXPECT_NE(written.find("# measured"), std::string::npos);
  const Fabric before = fabric_of(text), after = fabric_of(written);
  ASSERT_TRUE(after.crossings.at(0).crimp);
  EXPECT_EQ(after.crossings[0].crimp->crimp, before.crossings.at(0).crimp->crimp);
  EXPECT_EQ(after.crossings[0].crimp->half_wave, before.crossings[0].crimp->half_wave);
}

} // namespace
} // namespace plyform::crimp_file_test
