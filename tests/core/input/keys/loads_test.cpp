// SPDX-License-Identifier: GPL-3.0-or-later
// Loads as a case file gives them; wrong ones are in tests/data/broken.
#include "core/accuracy/error_model.hpp"
#include "core/model/motion.hpp"
#include "support/case_files.hpp"

#include <algorithm>
#include <gtest/gtest.h>

namespace plyform::loads_test {
namespace {

TEST(Loads, AreReadWithTheirProgrammes) {
  const Case read = good_case(data_folder / "good" / "loads.toml");
  ASSERT_EQ(read.loads.size(), 2u);
  EXPECT_EQ(read.loads[0].ply, 0);
  EXPECT_EQ(read.loads[0].side, PlyFace::below);
  EXPECT_EQ(read.loads[0].pressure, 0.01);
  EXPECT_NEAR(programme_value(read.loads[0].stages(), 0.5, 1.0), 0.005, 1e-15); // over all of it
  EXPECT_EQ(read.loads[1].side, PlyFace::above);
  EXPECT_EQ(read.loads[1].pressure, 0.02); // the largest
  EXPECT_EQ(programme_value(read.loads[1].stages(), 0.5, 1.0), 0.02);
  EXPECT_EQ(programme_value(read.loads[1].stages(), 1.0, 1.0), 0.005);
}

TEST(Loads, OfAnEnclosedStackPressItsOuterPliesTowardsEachOther) {
  const Case read = good_case(data_folder / "good" / "enclosure.toml");
  ASSERT_EQ(read.loads.size(), 3u);
  const PressureLoad &lower = read.loads[0], &top = read.loads[1], &forming = read.loads[2];
  EXPECT_EQ(lower.ply, 0);
  EXPECT_EQ(lower.side, PlyFace::below);
  EXPECT_EQ(top.ply, 2);
  EXPECT_EQ(top.side, PlyFace::above);
  for (const PressureLoad* one : {&lower, &top}) {
    EXPECT_EQ(one->pressure, 0.09);
    EXPECT_EQ(one->stages(), (std::vector<Stage>{{0.3, 0.09}}));
    EXPECT_EQ(one->entry, 0u);
  }
  EXPECT_EQ(forming.ply, 0); // drawn down: what is above it pushes
  EXPECT_EQ(forming.side, PlyFace::above);
  EXPECT_EQ(forming.pressure, 0.08);
  EXPECT_EQ(forming.entry, 1u);
}

// In bar or kPa a vacuum would be more than the air that makes it.
TEST(Loads, WarnOfAVacuumBeyondAnAtmosphere) {
  const auto warned = [](const std::string& value) {
    const PreparedCase reading = prepare_case((data_folder / "good" / "enclosure.toml").string(),
                                              {{"load.1.vacuum_programme", value}});
    EXPECT_TRUE(reading.errors.empty());
    return std::any_of(reading.warnings.begin(), reading.warnings.end(), [](const auto& line) {
      return line.find("load.1.vacuum_programme") != std::string::npos;
    });
  };
  EXPECT_FALSE(warned("[[0.3, 0.0], [1.0, 0.1013]]"));
  EXPECT_TRUE(warned("[[0.3, 0.0], [1.0, 0.9]]"));
}

TEST(Loads, KeepTheirPliesWhenOthersAreTakenOut) {
  Case data = good_case(data_folder / "good" / "loads.toml");
  data.plies.insert(data.plies.begin(), data.plies[0]);
  for (PressureLoad& load : data.loads)
    load.ply = 1;
  keep_plies(data, {0, 1});
  EXPECT_EQ(data.loads[0].ply, 0);
  EXPECT_EQ(data.loads[1].ply, 0);
}

TEST(Loads, AreNotWhatErrorsWereMeasuredFor) {
  Case read = good_case(data_folder / "good" / "loads.toml");
  read.boundaries[1].as<Grip>().stroke = 1.0;
  EXPECT_EQ(not_measured(read), "not measured: a pressure acts on ply ply");
  read.loads.clear();
  EXPECT_EQ(not_measured(read), "");
}

} // namespace
} // namespace plyform::loads_test
