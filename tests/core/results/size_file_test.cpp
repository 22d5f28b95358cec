// SPDX-License-Identifier: GPL-3.0-or-later
// mesh_sizes.txt: what is written is read, and what is damaged is told.
#include "core/results/size_file.hpp"
#include "support/results_helpers.hpp"

namespace plyform::size_file_test {
namespace {

namespace fs = std::filesystem;

class SizeFile : public results_test::ResultFolder {
protected:
  void SetUp() override {
    ResultFolder::SetUp();
    fs::create_directories(directory);
  }
  std::filesystem::path file() const { return directory / size_file_name; }
  void put(const std::string& text) const { std::ofstream(file()) << text; }
};

const std::vector<PlySizes> two_plies = {
    {"lower ply", {{-1.0 / 3.0, 2.5}, 0.1, 3, 2, {1.0, 2.0 / 3.0, 3.0, 4.0, 5e-3, 6.0}}},
    {"ply2", {{0.0, 0.0}, 2.0, 1, 1, {7.25}}}};

TEST_F(SizeFile, GivesBackWhatWasWritten) {
  write_sizes(file(), two_plies);
  for (const auto& path : {file(), directory}) {
    const std::vector<PlySizes> read = read_sizes(path);
    ASSERT_EQ(read.size(), 2u);
    EXPECT_EQ(read[0].ply, "lower ply");
    EXPECT_EQ(text_of(read), text_of(two_plies)); // every bit
    EXPECT_EQ(read[0].sizes.size, two_plies[0].sizes.size);
    EXPECT_EQ(read[1].sizes.columns, 1);
  }
}

TEST_F(SizeFile, WhatIsDamagedIsToldWithItsLine) {
  const std::pair<std::string, const char*> wrong[] = {
      {"", ":0: is no file of element sizes"},
      {"plyform mesh sizes 2\n", ":1: is no file of element sizes"},
      {"plyform mesh sizes 1\nply 0 0 2 1 2 a\n1\n", ":3: the file ends before its sizes do"},
      {"plyform mesh sizes 1\nply 0 0 2 1 1 a\n-1\n", ":3: \"-1\" is no number"},
      {"plyform mesh sizes 1\nply 0 0 2 1 1 a\nnan\n", ":3: \"nan\" is no number"},
      {"plyform mesh sizes 1\nply 0 0 0 1 1 a\n1\n", ":2: \"0\" is no number"},
      {"plyform mesh sizes 1\nply 0 0 2 1.5 1 a\n1\n", ":2: the size of a grid"},
      {"plyform mesh sizes 1\nplies\n", ":2: a line that begins with"}};
  for (const auto& [text, told] : wrong) {
    put(text);
    try {
      read_sizes(file());
      FAIL() << text;
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find(told), std::string::npos) << error.what();
    }
  }
}

TEST_F(SizeFile, AFolderWithoutItIsTold) {
  EXPECT_THROW(read_sizes(directory), std::runtime_error);
}

} // namespace
} // namespace plyform::size_file_test
