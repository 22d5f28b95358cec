// SPDX-License-Identifier: GPL-3.0-or-later
// The clock of the process: laws with rates need it, others have nothing from it.
#include "core/input/keys/schema_case.hpp"
#include "core/input/keys/toml_tree.hpp"
#include "support/case_files.hpp"

#include <gtest/gtest.h>

namespace plyform::process_clock_test {
namespace {

TEST(ProcessClock, IsReadAndSaidToDoNothingWithoutRates) {
  const PreparedCase read = prepare_case(data_folder / "good" / "accuracy.toml", {});
  ASSERT_TRUE(read.value) << all_texts(read);
  EXPECT_EQ(read.value->process.duration, 20.0);
  EXPECT_EQ(read.value->process_time(), 20.0 / read.value->solver.duration);
  std::string warnings;
  for (const std::string& warning : read.warnings)
    warnings += warning + "\n";
  EXPECT_NE(warnings.find("accuracy.toml:45:12: warning: process.duration = 20.0: does nothing, as "
                          "no law of these fabrics depends on rates"),
            std::string::npos)
      << warnings;
  const Case without = good_case(data_folder / "good" / "base.toml");
  EXPECT_FALSE(without.process.duration);
  EXPECT_EQ(without.process_time(), 1.0);
}

TEST(ProcessClock, IsNeededByLawsWithRates) {
  Case built;
  built.fabrics.resize(2);
  built.fabrics[1].name = "prepreg";
  const auto check = [&built](std::string_view text) {
    Diagnostics parsing, found;
    std::optional<TomlNode> entries = parse_entries(std::string(text), "case.toml", parsing);
    TableView root{&*entries, "", ""};
    check_clock(
        root, built, [](const Fabric& f) { return f.name == "prepreg"; }, found);
    return found;
  };
  const Diagnostics missing = check("title = \"none\"");
  ASSERT_EQ(missing.errors.size(), 1u);
  EXPECT_EQ(missing.errors[0].text(),
            "case.toml:1:1: error: process.duration: is missing, and laws of fabric prepreg depend "
            "on rates; give [process] a duration, the seconds that the real stroke takes");
  built.process.duration = 20.0;
  const Diagnostics told = check("[process]\nduration = 20.0");
  EXPECT_TRUE(told.errors.empty());
  EXPECT_TRUE(told.warnings.empty());
}

} // namespace
} // namespace plyform::process_clock_test
