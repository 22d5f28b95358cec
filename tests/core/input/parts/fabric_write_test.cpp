// SPDX-License-Identifier: GPL-3.0-or-later
// Fabric files on their own: read, given another law, and read again as a case does.
#include "core/input/parts/fabric_file.hpp"
#include "core/setup/prepare_case.hpp"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <stdexcept>
#include <unistd.h>

namespace plyform::fabric_write_test {
namespace {

namespace fs = std::filesystem;

/// A folder of this test that goes when it does.
struct Folder {
  fs::path path;
  Folder() {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    path = fs::path(::testing::TempDir()) /
           (std::string("plyform_fabric_") + test->name() + "_" + std::to_string(getpid()));
    fs::create_directories(path);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() { fs::remove_all(path); }
  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path / name, std::ios::binary) << text;
    return path / name;
  }
};

std::string texts(const std::vector<CaseError>& errors) {
  std::string all;
  for (const CaseError& error : errors)
    all += error.text() + "\n";
  return all;
}

/// The fabric as a case reads it from its file.
Fabric in_a_case(const Folder& folder, const std::string& fabric) {
  folder.write("fabric.toml", fabric);
  const fs::path file = folder.write("case.toml", R"(
fabrics.glass = "fabric.toml"
[blanks.square]
size = [100.0, 100.0]
element_size = 10.0
[[ply]]
name = "ply"
fabric = "glass"
blank = "square"
angle = 0.0
)");
  const PreparedCase reading = prepare_case(file, {});
  EXPECT_TRUE(reading.value) << texts(reading.errors) << fabric;
  return reading.value ? reading.value->fabrics.at(0) : Fabric{};
}

const LawText polynomial{"shear", "polynomial", "[0.5, 0.25]", {"from a.csv", "two\nlines"}};

/// The same fabric in the ways that TOML has for it.
const char* const spellings[] = {
    R"(# Where it is from.

name = "a \"glass\" weave"   # in quotes
surface_density = 600.0
thickness = 6e-1

# the stiffer one
[warp]
density = 0.25     # yarns/mm
stiffness = 46000
[weft]
table = [[0.0, 0.0], # origin
         [0.01, 480.0]]
density = 0.25
[shear]
# old comment
polynomial = [1.0, 2.0, 3.0]
)",
    R"(name = 'a "glass" weave'
surface_density = 600.0
thickness = 0.6
warp = { density = 0.25, stiffness = 46000.0 }
weft.density = 0.25
weft.table = [[0, 0], [1e-2, 480]]
shear.table = [[0.0, 0.0], [45.0, 1.0]])",
    "# top\r\n\"name\" = \"a \\u0022glass\\\" weave\"\r\nsurface_density = 600.0\r\nthickness = "
    "0.6\r\n"
    "[weft]\r\ndensity = 0.25\r\ntable = [[0.0, 0.0], [0.01, 480.0]]\r\n"
    "[warp]\r\nstiffness = 46_000.0\r\ndensity = 0.25\r\n"}; // without a law of shear

TEST(FabricWrite, PutsTheLawInAndKeepsEverythingElse) {
  const Folder folder;
  for (const char* spelling : spellings) {
    const Fabric fabric = in_a_case(folder, with_law(spelling, polynomial));
    EXPECT_EQ(fabric.crossings[0].shear.k, (std::vector<double>{0.5, 0.25})) << spelling;
    EXPECT_TRUE(fabric.crossings[0].shear.angle.empty());
    EXPECT_EQ(fabric.name, "a \"glass\" weave");
    EXPECT_DOUBLE_EQ(fabric.surface_density, 600e-12);
    EXPECT_EQ(fabric.thickness, 0.6);
    EXPECT_EQ(fabric.families[0].density, 0.25);
    EXPECT_EQ(fabric.families[0].tension.stiffness, 46000.0);
    EXPECT_EQ(fabric.families[1].tension.tension, (std::vector<double>{0.0, 480.0}));
  }
}

TEST(FabricWrite, ReplacesAStiffnessByATableAndBack) {
  const Folder folder;
  const LawText table{"warp", "table", "[\n    [0.0, 0.0],\n    [0.02, 900],\n]", {}};
  const LawText stiffness{"weft", "stiffness", "7.5", {"x"}};
  for (const char* spelling : spellings) {
    const std::string text = with_law(with_law(with_law(spelling, polynomial), table), stiffness);
    const Fabric fabric = in_a_case(folder, text);
    EXPECT_EQ(fabric.families[0].tension.tension, (std::vector<double>{0.0, 900.0})) << text;
    EXPECT_EQ(fabric.families[1].tension.stiffness, 7.5);
    EXPECT_TRUE(fabric.families[1].tension.strain.empty());
    EXPECT_EQ(fabric.families[0].density, 0.25);
  }
}

TEST(FabricWrite, KeepsCommentsButThoseOfTheOldLaw) {
  const std::string text = with_law(spellings[0], polynomial);
  for (const char* kept : {"# Where it is from.\n\nname", "\"   # in quotes\n",
                           "0.25     # yarns/mm", "# the stiffer one\n[warp]", "thickness = 6e-1\n",
                           "[shear]\n# from a.csv\n# two lines\npolynomial = [0.5, 0.25]\n"})
    EXPECT_NE(text.find(kept), std::string::npos) << kept << "\nin\n" << text;
  EXPECT_EQ(text.find("old comment"), std::string::npos) << text;
  EXPECT_EQ(text, with_law(text, polynomial)); // written once more it stays
}

TEST(FabricWrite, KeepsStitches) {
  const Folder folder;
  const std::string stitched = std::string(spellings[0]) + R"(
[[stitch]]
direction = 45.0
density = 0.2
table = [[0.0, 0.0], [0.1, 3.0]]
slack = 0.02
[[stitch]] # a zigzag
name = "tricot"
pattern = "tricot"
directions = [30, -30]
density = 0.1
stiffness = 20.0
breaking_force = 5.0
)";
  const Fabric fabric = in_a_case(folder, with_law(stitched, polynomial));
  ASSERT_EQ(fabric.stitches.size(), 3u);
  EXPECT_EQ(fabric.stitches[0].law.tension.tension, (std::vector<double>{0.0, 3.0}));
  EXPECT_EQ(fabric.stitches[0].law.taut_at, 0.02);
  EXPECT_EQ(fabric.stitches[2].name, "tricot_2");
  EXPECT_EQ(fabric.stitches[2].law.breaking_force, 5.0);
  EXPECT_EQ(fabric.crossings[0].shear.k, (std::vector<double>{0.5, 0.25}));
}

const char* const by_families = R"(
surface_density = 446.0
thickness = 0.5
# the first
[[family]]
name = "minus"
angle = -45.0
density = 0.1375
stiffness = 217000.0
[[family]] # the second
name = "plus"
angle = 45.0
density = 0.1375
stiffness = 217000.0
# what holds them
[[crossing]]
families = ["minus", "plus"]
polynomial = [1.0] # to be replaced
[[stitch]]
direction = 0.0
density = 0.2
stiffness = 20.0
)";

TEST(FabricWrite, PutsLawsIntoFamiliesCrossingsAndStitches) {
  const Folder folder;
  const FabricReading reading = read_fabric_file(folder.write("a.toml", by_families), true);
  ASSERT_TRUE(reading.by_families);
  ASSERT_EQ(reading.seams.size(), 1u);
  EXPECT_EQ(reading.seams[0].name, "stitch");
  EXPECT_EQ(table_of_law(reading, "weft"), "family[1]");
  std::string text = reading.text;
  text = with_law(text, {table_of_law(reading, "shear"),
                         "polynomial",
                         "[0.5]",
                         {"by a test"},
                         {{"negative_polynomial", "[0.25]"}}});
  text = with_law(text, {table_of_law(reading, "weft"), "stiffness", "5e4", {}});
  text = with_law(text, {table_of_law(reading, "crimp"), "ratio", "[0.001, 0.002]", {}});
  text = with_law(text, {"stitch[0]", "breaking_force", "3.5", {}});
  const Fabric fabric = in_a_case(folder, text);
  EXPECT_EQ(fabric.crossings[0].shear.k, (std::vector<double>{0.5}));
  EXPECT_EQ(fabric.crossings[0].shear.negative_k, (std::vector<double>{0.25}));
  EXPECT_EQ(fabric.families[0].tension.stiffness, 217000.0);
  EXPECT_EQ(fabric.families[1].tension.stiffness, 5e4);
  ASSERT_TRUE(fabric.crossings[0].crimp);
  EXPECT_EQ(fabric.crossings[0].crimp->crimp[1], 0.002);
  EXPECT_EQ(fabric.stitches[0].law.breaking_force, 3.5);
  for (const char* kept : {"# the first\n[[family]]", "# what holds them\n[[crossing]]",
                           "# by a test\npolynomial = [0.5]\nnegative_polynomial"})
    EXPECT_NE(text.find(kept), std::string::npos) << kept << "\nin\n" << text;
  EXPECT_THROW(with_law(text, {"crossing[1]", "polynomial", "[1]", {}}), std::invalid_argument);
}

TEST(FabricWrite, RefusesWhatIsNoToml) {
  EXPECT_THROW(with_law("name = ", polynomial), std::invalid_argument);
}

TEST(FabricFile, ReadsAFabricOutsideACase) {
  const Folder folder;
  const FabricReading reading = read_fabric_file(folder.write("a.toml", spellings[0]), false);
  ASSERT_TRUE(reading.value) << texts(reading.errors);
  EXPECT_EQ(reading.value->crossings[0].shear.k, (std::vector<double>{1.0, 2.0, 3.0}));
  EXPECT_TRUE(reading.missing.empty());
  EXPECT_EQ(reading.text, spellings[0]);
}

TEST(FabricFile, LetsLawsMissWhereTheyMay) {
  const Folder folder;
  const fs::path file = folder.write(
      "a.toml", "surface_density = 1.0\nthickness = 1.0\n[warp]\ndensity = 0.5\nstiffness = 3.0\n"
                "[weft]\ndensity = 0.25\n");
  const FabricReading reading = read_fabric_file(file, true);
  ASSERT_TRUE(reading.value) << texts(reading.errors);
  EXPECT_EQ(reading.missing, (std::vector<std::string>{"weft", "shear"}));
  EXPECT_EQ(reading.value->families[1].tension.stiffness, 0.0);
  EXPECT_EQ(reading.value->families[0].tension.stiffness, 3.0);
  EXPECT_TRUE(reading.value->crossings[0].shear.k.empty());
  EXPECT_EQ(reading.value->name, "a");
  const FabricReading whole = read_fabric_file(file, false);
  EXPECT_FALSE(whole.value);
  EXPECT_NE(texts(whole.errors).find("a.toml:6:1: error: weft.stiffness: is missing; give"),
            std::string::npos)
      << texts(whole.errors);
  EXPECT_NE(texts(whole.errors).find("error: shear: is missing"), std::string::npos);
}

TEST(FabricFile, ReportsMistakesWithTheirPlace) {
  const Folder folder;
  const fs::path file = folder.write("a.toml", "surface_density = -1.0\nthicknes = 1.0\n"
                                               "[warp]\nstiffness = 3.0\n[weft]\ndensity = 0.25\n");
  const std::string found = texts(read_fabric_file(file, true).errors);
  for (const char* message :
       {"a.toml:1:19: error: surface_density = -1.0: must be at least 0.001",
        "a.toml:2:1: error: thicknes = 1.0: unknown key", "did you mean thickness?",
        "error: thickness: is missing", "a.toml:3:1: error: warp.density: is missing"})
    EXPECT_NE(found.find(message), std::string::npos) << message << "\nin\n" << found;
  EXPECT_NE(texts(read_fabric_file("nosuch.toml", true).errors)
                .find("nosuch.toml:1:1: error: the fabric file cannot be opened"),
            std::string::npos);
  EXPECT_NE(texts(read_fabric_file(folder.write("b.toml", "= 3"), true).errors).find("is no TOML"),
            std::string::npos);
}

TEST(WithLaw, KeepsWhatItKnowsOfPressedAndBentYarns) {
  const Folder folder;
  const Fabric fabric = in_a_case(folder, with_law(R"(
surface_density = 600.0
thickness = 0.6
locking_angle = 50.0
[warp]
density = 0.25
stiffness = 46000.0
compression_stiffness = 460.0
buckling_force = 5.0
in_plane_bending_stiffness = 8.0
[weft]
density = 0.25
stiffness = 48000.0
[shear]
polynomial = [1.0]
)",
                                                   polynomial));
  EXPECT_EQ(fabric.crossings[0].shear.k, (std::vector<double>{0.5, 0.25}));
  EXPECT_EQ(fabric.families[0].tension.compression, 460.0);
  EXPECT_EQ(fabric.families[0].tension.buckling_force, 5.0);
  EXPECT_EQ(fabric.families[0].in_plane_bending, 8.0);
  EXPECT_TRUE(fabric.locking_angle);
}

TEST(WithLaw, PutsBendingInPlaceOfItsTableAndTakesKeysOut) {
  const Folder folder;
  const std::string base = R"(
surface_density = 600.0
thickness = 0.6
[warp]
density = 0.25
stiffness = 46000.0
compression_stiffness = 460.0
buckling_force = 5.0
bending_table = [[0.0, 0.0], [0.1, 0.2]]
[weft]
density = 0.25
stiffness = 48000.0
[shear]
polynomial = [1.0]
)";
  const std::string bent = with_law(base, {"warp", "bending_stiffness", "1.5", {"measured"}});
  const Fabric fabric =
      in_a_case(folder, with_law(bent, {"warp", "buckling_force", "", {"not written"}}));
  EXPECT_EQ(fabric.families[0].bending.stiffness, 1.5);
  EXPECT_TRUE(fabric.families[0].bending.curvature.empty());
  EXPECT_FALSE(fabric.families[0].tension.buckles());
  EXPECT_EQ(fabric.families[0].tension.stiffness, 46000.0);
  EXPECT_EQ(fabric.families[0].tension.compression, 460.0);
}

/// Every fabric of the library is read.
TEST(FabricFile, ReadsTheLibrary) {
  int count = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(PLYFORM_CASES "/fabrics")) {
    if (entry.path().extension() != ".toml") continue;
    ++count;
    const FabricReading reading = read_fabric_file(entry.path(), false);
    EXPECT_TRUE(reading.value) << entry.path() << texts(reading.errors);
    if (reading.value) {
      EXPECT_FALSE(reading.value->name.empty());
    }
  }
  EXPECT_GE(count, 4);
}

TEST(FabricFile, ReadsRubberWithItsBending) {
  const Folder folder;
  const auto read = [&](const std::string& law) {
    const FabricReading reading = read_fabric_file(
        folder.write("r.toml", "surface_density = 1650.0\nthickness = 1.5\n" + law), false);
    EXPECT_TRUE(reading.value) << texts(reading.errors);
    return reading.value.value_or(Fabric{});
  };
  const Fabric neo =
      read("law = \"neo_hookean\"\nneo_hookean = {shear_modulus = 0.3, stretch_limit = 2.0}\n");
  const auto& law = std::get<MooneyRivlinLaw>(neo.sheet.value());
  EXPECT_DOUBLE_EQ(law.shear_modulus(), 0.3 * 1.5); // N/mm
  EXPECT_EQ(law.c01, 0.0);
  EXPECT_NEAR(neo.plate, 0.3 * 1.5 * 1.5 * 1.5 / 3.0, 1e-15); // E h^3 / 9 of nu = 1/2, E = 3 mu
  EXPECT_DOUBLE_EQ(neo.plate_coupling, 0.5 * neo.plate);
  EXPECT_DOUBLE_EQ(neo.twist, neo.plate);
  EXPECT_EQ(neo.stretch_limit, 2.0);
  const Fabric limp = read("law = \"mooney_rivlin\"\n[mooney_rivlin]\nc10 = 0.2\nc01 = -0.05\n"
                           "bending_stiffness = 0.0\n");
  const auto& mooney = std::get<MooneyRivlinLaw>(limp.sheet.value());
  EXPECT_DOUBLE_EQ(mooney.c10, 0.3);
  EXPECT_DOUBLE_EQ(mooney.c01, -0.075);
  EXPECT_EQ(limp.plate, 0.0);
  EXPECT_FALSE(limp.stretch_limit);
}

TEST(WithLaw, OfRubberTakesThePlaceOfTheOther) {
  const Folder folder;
  const std::string base = "# a bag\n\nthickness = 1.5 # mm\nsurface_density = 1650.0\n"
                           "law = \"mooney_rivlin\"\n[mooney_rivlin]\nc10 = 0.2\nc01 = 0.1\n";
  LawText word{"", "law", "\"neo_hookean\"", {}};
  word.without = {"mooney_rivlin"};
  const LawText law{
      "neo_hookean", "shear_modulus", "0.31", {"measured"}, {{"stretch_limit", "1.9"}}};
  for (const std::string& from : {base, std::string("thickness = 1.5\nsurface_density = 1650.0\n"),
                                  with_law(with_law(base, word), law)}) {
    const std::string text = with_law(with_law(from, word), law);
    EXPECT_EQ(text.find("mooney"), std::string::npos) << text;
    EXPECT_EQ(text.find("shear_modulus"), text.rfind("shear_modulus")) << text;
    EXPECT_EQ(text.find("stretch_limit"), text.rfind("stretch_limit")) << text;
    const FabricReading reading = read_fabric_file(folder.write("r.toml", text), false);
    ASSERT_TRUE(reading.value) << texts(reading.errors) << text;
    EXPECT_DOUBLE_EQ(std::get<MooneyRivlinLaw>(*reading.value->sheet).shear_modulus(), 0.31 * 1.5);
    EXPECT_EQ(reading.value->stretch_limit, 1.9);
  }
}

TEST(FabricFile, RubberMayLackItsLaw) {
  const Folder folder;
  const std::string sizes = "thickness = 1.5\nsurface_density = 1650.0\n";
  for (const std::string& text :
       {sizes, sizes + "law = \"neo_hookean\"\n", sizes + "law = \"mooney_rivlin\"\n",
        sizes + "law = \"neo_hookean\"\n[neo_hookean]\nbending_stiffness = 0.1\n"}) {
    const FabricReading reading = read_rubber_file(folder.write("r.toml", text));
    ASSERT_TRUE(reading.value) << texts(reading.errors) << text;
    EXPECT_TRUE(std::holds_alternative<MooneyRivlinLaw>(reading.value->sheet.value()));
    EXPECT_EQ(reading.text, text);
  }
}

} // namespace
} // namespace plyform::fabric_write_test
