// SPDX-License-Identifier: GPL-3.0-or-later
// Columns of plies of any number of families, through every file.
#include "core/results/export.hpp"
#include "tests/support/results_helpers.hpp"

#include <gtest/gtest.h>

namespace plyform::ply_columns_test {
namespace {

using namespace results_test;
using PlyColumns = ResultFolder;

/// The example with as many families as angles; crossings of each with the next but the first pair,
/// which has none of its own.
PlyFrame with_families(PlyFrame ply, const std::vector<double>& angles) {
  const std::vector<double> zero(ply.triangles.size(), 0.0);
  ply.families.clear();
  for (std::size_t k = 0; k < angles.size(); ++k) {
    FamilyFrame family{fmt::format("f{}", k), angles[k], {}, zero, zero};
    for (std::size_t t = 0; t < zero.size(); ++t) {
      family.direction.emplace_back(std::cos(angles[k] + 0.1 * static_cast<double>(t)), 0.5, 0.25);
      family.strain[t] = 0.01 * static_cast<double>(k) + 0.001 * static_cast<double>(t);
      family.tension[t] = 10.0 * static_cast<double>(k) + static_cast<double>(t);
    }
    ply.families.push_back(family);
  }
  for (std::size_t k = 1; k + 1 < angles.size(); ++k)
    ply.crossings.push_back({fmt::format("f{}_f{}", k, k + 1), ply.families[k].tension});
  return ply;
}

Frame mixed(double time) {
  Frame frame = example::frame(time);
  frame.plies = {with_families(example::ply("none", 2, 0, time), {}),
                 with_families(example::ply("one", 3, 1, time), {20.0}),
                 example::ply("woven", 2, 2, time),
                 with_families(example::ply("three", 3, 3, time), {0.0, 60.0, 120.0})};
  return frame;
}

std::vector<std::string> names_of(const PlyFrame& ply) {
  std::vector<std::string> names;
  for (const Column& column : columns_of(ply))
    names.push_back(column.name);
  return names;
}

TEST_F(PlyColumns, OfEachPlyAreThoseOfItsFamilies) {
  const Frame frame = mixed(0.5);
  using Names = std::vector<std::string>;
  EXPECT_EQ(names_of(frame.plies[0]),
            (Names{"contact_pressure", "shear_angle_deg", "thickness_mm"}));
  EXPECT_EQ(names_of(frame.plies[1]), (Names{"contact_pressure", "f0", "shear_angle_deg",
                                             "f0_strain", "f0_tension_N", "thickness_mm"}));
  EXPECT_EQ(names_of(frame.plies[2]),
            (Names{"contact_pressure", "warp", "weft", "shear_angle_deg", "warp_strain",
                   "weft_strain", "warp_tension_N", "weft_tension_N", "thickness_mm"}));
  EXPECT_EQ(names_of(frame.plies[3]),
            (Names{"contact_pressure", "f0", "f1", "f2", "shear_angle_deg", "shear_angle_deg_f1_f2",
                   "f0_strain", "f1_strain", "f2_strain", "f0_tension_N", "f1_tension_N",
                   "f2_tension_N", "thickness_mm"}));
}

TEST_F(PlyColumns, OfPliesWithOtherFamiliesComeBackBitForBit) {
  ResultWriter writer(directory);
  writer.write_frame(mixed(0.25));
  writer.write_final(mixed(0.5), Summary{});
  expect_same(read_last_frame(directory / "results.h5"), mixed(0.5));
  const Frame found = read_last_frame(directory / "results.h5");
  EXPECT_EQ(found.plies[3].families[2].name, "f2");
  EXPECT_EQ(found.plies[3].crossings[0].suffix, "f1_f2");
}

TEST_F(PlyColumns, StandInTablesAndExportsUnderTheirNames) {
  ResultWriter writer(directory);
  writer.write_final(mixed(0.5), Summary{});
  export_results(directory);
  const auto rows = rows_of(content(directory / "plies/three.csv"));
  EXPECT_EQ(rows[0], (std::vector<std::string>{"x0",
                                               "y0",
                                               "z0",
                                               "x",
                                               "y",
                                               "z",
                                               "f0_x",
                                               "f0_y",
                                               "f0_z",
                                               "f1_x",
                                               "f1_y",
                                               "f1_z",
                                               "f2_x",
                                               "f2_y",
                                               "f2_z",
                                               "shear_angle_deg",
                                               "shear_angle_deg_f1_f2",
                                               "f0_strain",
                                               "f1_strain",
                                               "f2_strain",
                                               "f0_tension_N",
                                               "f1_tension_N",
                                               "f2_tension_N",
                                               "thickness_mm"}));
  EXPECT_EQ(rows[3].back(), fmt::format("{:.9g}", mixed(0.5).plies[3].thickness[2]));
  for (const char* file : {"export/three.vtu", "results.xdmf"})
    for (const std::string& name : names_of(mixed(0.5).plies[3]))
      EXPECT_TRUE(contains(content(directory / file), "Name=\"" + name + "\"")) << file << name;
  EXPECT_FALSE(contains(content(directory / "export/none.vtu"), "warp"));
}

TEST_F(PlyColumns, TwoOfOneNameAreRefusedBeforeAnythingIsWritten) {
  for (const char* name : {"x", "thickness_mm", "f1", "f1_x"}) {
    Frame frame = mixed(0.5);
    frame.plies[3].families[0].name = name;
    const std::string error = error_of([&] { ResultWriter(directory).write_frame(frame); });
    EXPECT_TRUE(contains(error, "ply \"three\"")) << error;
    EXPECT_TRUE(contains(error, "rename the family")) << error;
  }
  Frame frame = mixed(0.5);
  frame.plies[3].families[0].name = "a/b";
  EXPECT_NE(error_of([&] { ResultWriter(directory).write_frame(frame); }), "");
}

} // namespace
} // namespace plyform::ply_columns_test
