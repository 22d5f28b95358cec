// SPDX-License-Identifier: GPL-3.0-or-later
// Cases that are meant to bring a program down: nested without end, huge, with names that are none.
#include "base/names.hpp"
#include "core/input/keys/toml_depth.hpp"
#include "core/input/keys/toml_tree.hpp"
#include "support/case_files.hpp"

#include <fstream>
#include <sys/stat.h>
#include <unistd.h>

namespace plyform::hostile_case_test {
namespace {

class HostileCase : public ::testing::Test {
protected:
  void SetUp() override {
    folder = fs::temp_directory_path() / ("plyform_hostile_" + std::to_string(getpid()));
    fs::create_directories(folder);
  }
  void TearDown() override { fs::remove_all(folder); }
  /// What is said of a case of this text.
  std::string errors_of(const std::string& text, const std::vector<Override>& overrides = {}) {
    std::ofstream(folder / "case.toml", std::ios::binary) << text;
    return all_texts(prepare_case(folder / "case.toml", overrides));
  }
  fs::path folder;
};

std::string repeated(const std::string& part, int times) {
  std::string text;
  for (int i = 0; i < times; ++i)
    text += part;
  return text;
}

const std::string fabric =
    "[fabrics.f]\nsurface_density = 600.0\nthickness = 0.6\nwarp = {density = 0.25, stiffness = "
    "46000.0}\nweft = {density = 0.25, stiffness = 46000.0}\nshear = {polynomial = [0.37]}\n";
const std::string blank = "[blanks.b]\nsize = [20.0, 20.0]\nelement_size = 10.0\n";

std::string ply(const std::string& name) {
  return "[[ply]]\nname = \"" + name + "\"\nfabric = \"f\"\nblank = \"b\"\nangle = 0.0\n";
}

TEST_F(HostileCase, WhatIsNestedWithoutEndIsRefusedAtItsPlace) {
  const std::string dots = repeated("a.", 20000) + "a";
  for (const std::string& text :
       {dots + " = 1\n", "[" + dots + "]\n", "[[" + dots + "]]\n", "x = {" + dots + " = 1}\n",
        "x = " + repeated("[", 20000) + "\n", "x = " + repeated("{a=", 20000) + "\n",
        repeated("'a'.", 20000) + "b = 1\n", repeated("\"a\" . ", 20000) + "b = 1\n",
        "x = [\"\"\"a\"\"\"\", " + repeated("{a.b=", 20000) + "]\n",
        "x = '''a'''\n" + dots + " = 1\n", "x = \"\\\"\" # '\n" + dots + " = 1\n"}) {
    const std::string said = errors_of("# first\n" + text);
    EXPECT_NE(said.find("goes more than 16 levels deep"), std::string::npos)
        << text.substr(0, 60) << "\n"
        << said.substr(0, 300);
  }
  EXPECT_NE(errors_of("\n" + dots + " = 1\n").find("case.toml:2:32: error: "), std::string::npos);
  const std::string said = errors_of(fabric + blank + ply("p"), {{dots, "1"}});
  EXPECT_NE(said.find("--set:1:1: error: a"), std::string::npos) << said.substr(0, 300);
  EXPECT_LT(said.size(), 2000u);
  EXPECT_NE(
      errors_of(fabric + blank + ply("p"), {{"title", repeated("[", 20000)}}).find("levels deep"),
      std::string::npos);
}

TEST_F(HostileCase, DotsInTextsAndCommentsAreNoLevels) {
  const std::string dots = repeated(".", 100), brackets = repeated("[", 100);
  for (const std::string& text :
       {"x = \"" + dots + brackets + "\"", "x = '" + dots + "' # " + dots + brackets,
        "x = \"\"\"\n" + dots + "\n" + brackets + "\"\"\"",
        std::string("x = [1.5, 2.5, 3.5, 4.5, 1.5, 2.5, "
                    "1.5, 2.5, 3.5, 4.5, 1.5, 2.5, 1.5, 2.5, 3.5, 4.5, 1.5, 2.5]"),
        std::string("a.b.c.d.e = [[[[1]]]]")}) {
    EXPECT_FALSE(nested_too_deep(text)) << text;
    Diagnostics diagnostics;
    EXPECT_TRUE(parse_entries(text, "x", diagnostics)) << text;
  }
}

TEST_F(HostileCase, NamesAreBoundedWhereTheyAreRead) {
  EXPECT_EQ(errors_of(fabric + blank + ply(std::string(100, 'p'))), "");
  EXPECT_NE(errors_of(fabric + blank + ply(std::string(101, 'p'))).find("ply.0.name = \"ppp"),
            std::string::npos);
  EXPECT_NE(errors_of(fabric + blank + ply(std::string(10000, 'p')))
                .find("must not be longer than 100 bytes, and has 10000"),
            std::string::npos);
  for (const std::string& name :
       {std::string("\"../x\""), std::string("\"..\""), std::string("\"a\\nb\""),
        std::string("\"\""), std::string("\"a\\u202Eb\""), '"' + std::string(101, 'b') + '"'}) {
    const std::string other = "[blanks." + name + "]\nsize = [20.0, 20.0]\nelement_size = 10.0\n";
    const std::string said = errors_of(fabric + blank + other + ply("p"));
    EXPECT_NE(said.find("its name must not"), std::string::npos) << name << said;
    EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
  }
  EXPECT_EQ(fault_of_name("90\u00b0 ply & co"), "");
  for (const std::string name : {"a:b", "a*", "a?", "a\"", "<a", "a|", ".a"}) {
    EXPECT_EQ(fault_of_name(name), "") << name;
    EXPECT_NE(fault_of_file_name(name), "") << name;
  }
}

TEST_F(HostileCase, MoreThanCanBeWorkedWithIsToldBeforeItIsTried) {
  const std::string tool = "[[tool]]\nname = \"t\"\nshape = \"sphere\"\nradius = 1.0\nposition = "
                           "[0.0, 0.0, 50.0]\nmotion = \"fixed\"\n";
  EXPECT_NE(errors_of(fabric + blank + ply("p") + repeated(tool, 1001))
                .find("has 1001 items, and may have 1000 at most"),
            std::string::npos);
  EXPECT_NE(errors_of(fabric + blank + repeated(ply("p"), 201))
                .find("has 201 items, and may have 200 at most"),
            std::string::npos);
  EXPECT_NE(errors_of(std::string(5 << 20, '#')).find("is too large: it has 5242880 bytes"),
            std::string::npos);
  EXPECT_NE(errors_of(fabric + blank + ply("p"), {{"gravity", "[" + repeated("0,", 3 << 20) + "]"}})
                .find("more than the 4194304"),
            std::string::npos);
}

TEST_F(HostileCase, AnOverrideThatCannotBeLeavesTheOthersAlone) {
  const std::string text = fabric + blank + ply("p");
  const std::string said =
      errors_of(text, {{"contact.pair.0.friction", "0.1"}, {"stack.botom", "1"}, {"title", "x"}});
  EXPECT_NE(said.find("contact.pair has no item 0"), std::string::npos) << said;
  EXPECT_NE(said.find("did you mean bottom"), std::string::npos) << said;
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 2) << said;
}

TEST_F(HostileCase, ValuesOfOneLongLineAreQuotedAsWritten) {
  std::string line = "x = [";
  for (int i = 0; i < 2000; ++i)
    line += "\"\u00e4" + std::to_string(i) + "\", ";
  Diagnostics diagnostics;
  const std::optional<TomlNode> entries = parse_entries(line + "]", "x", diagnostics);
  ASSERT_TRUE(entries);
  const std::vector<TomlNode>& items = entries->children.front().children;
  ASSERT_EQ(items.size(), 2000u);
  for (int i = 0; i < 2000; ++i)
    ASSERT_EQ(items[static_cast<std::size_t>(i)].source_text,
              "\"\u00e4" + std::to_string(i) + "\"");
}

TEST_F(HostileCase, PipesAndDevicesAreRefusedWhereverAFileIsNamed) {
  const std::string pipe = (folder / "pipe.stl").string();
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const std::string named = '"' + pipe + '"';
  EXPECT_NE(all_texts(prepare_case(pipe, {})).find("is a pipe, not a file"), std::string::npos);
  EXPECT_NE(errors_of("[fabrics]\nf = " + named + "\n" + blank + ply("p")).find("is a pipe"),
            std::string::npos);
  EXPECT_NE(errors_of(fabric + "[blanks.b]\noutline_file = " + named +
                      "\nelement_size = 10.0\nmesh = \"free\"\n" + ply("p"))
                .find("is a pipe"),
            std::string::npos);
  EXPECT_NE(errors_of(fabric + "[blanks.b]\nfile = " + named + "\nmesh = \"file\"\n" + ply("p"))
                .find("is a pipe"),
            std::string::npos);
  EXPECT_NE(errors_of(fabric + blank + ply("p") +
                      "[[tool]]\nname = \"t\"\nshape = \"mesh\"\nfile = " + named +
                      "\nposition = [0.0, 0.0, 50.0]\nmotion = \"fixed\"\n")
                .find("is a pipe"),
            std::string::npos);
}

TEST_F(HostileCase, MessagesHoldNothingThatATerminalObeys) {
  const std::string said =
      errors_of("title = 3\n\"\\u001b[2J\" = 1\n" + fabric + blank + ply("a\\u001b]0;x\\u0007"));
  EXPECT_EQ(said.find('\x1b'), std::string::npos) << said;
  EXPECT_EQ(said.find('\a'), std::string::npos) << said;
  EXPECT_NE(said.find("\\x1b[2J"), std::string::npos) << said;
}

} // namespace
} // namespace plyform::hostile_case_test
