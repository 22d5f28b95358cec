// SPDX-License-Identifier: GPL-3.0-or-later
// Every code of $INSUNITS: a square of 100 mm in each unit that is known, others refused.
#include "core/drawing/dxf_outline.hpp"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <stdexcept>
#include <unistd.h>

namespace plyform::dxf_units_test {
namespace {

// mm of each, by the list of codes in the DXF reference.
const std::map<int, double> known = {
    {1, 25.4},    {2, 304.8},  {3, 1609344.0}, {4, 1.0},   {5, 10.0},  {6, 1000.0}, {7, 1e6},
    {8, 2.54e-5}, {9, 0.0254}, {10, 914.4},    {12, 1e-6}, {13, 1e-3}, {14, 100.0}};

std::string square(int code, double side) {
  const auto number = [](double x) {
    char text[40];
    std::snprintf(text, sizeof text, "%.17g", x);
    return std::string(text);
  };
  std::string text = "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n" + std::to_string(code) +
                     "\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n";
  const double corner[5][2] = {{0, 0}, {side, 0}, {side, side}, {0, side}, {0, 0}};
  for (int i = 0; i < 4; ++i)
    text += "0\nLINE\n8\n0\n10\n" + number(corner[i][0]) + "\n20\n" + number(corner[i][1]) +
            "\n11\n" + number(corner[i + 1][0]) + "\n21\n" + number(corner[i + 1][1]) + "\n";
  return text + "0\nENDSEC\n0\nEOF\n";
}

DxfOutline read(int code, double side) {
  const auto path = std::filesystem::path(::testing::TempDir()) /
                    ("plyform_units_" + std::to_string(getpid()) + ".dxf");
  std::ofstream(path, std::ios::binary) << square(code, side);
  return read_dxf_outline({.file = path, .layer = "", .scale = {}});
}

TEST(DxfUnits, OfEveryCodeThatIsKnownGiveTheSameSquare) {
  for (const auto& [code, mm] : known) {
    const std::string description = read(code, 100.0 / mm).description;
    EXPECT_NE(description.find("100 x 100 mm"), std::string::npos) << code << description;
    EXPECT_NEAR(unit_named_in(description), mm, 1e-12 * mm) << description;
  }
}

TEST(DxfUnits, ThatAreNotKnownAreRefused) {
  int refused = 0;
  for (int code = 1; code < 60; ++code) {
    if (known.count(code) > 0) continue;
    try {
      read(code, 100.0);
      ADD_FAILURE() << code;
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find("is not known"), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("4 mm"), std::string::npos) << error.what();
      ++refused;
    }
  }
  EXPECT_GE(refused, 30);
}

} // namespace
} // namespace plyform::dxf_units_test
