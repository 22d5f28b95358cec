// SPDX-License-Identifier: GPL-3.0-or-later
// CSV files as test machines and spreadsheets write them, and every mistake in them by its message.
#include "core/identify/curve_file.hpp"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <unistd.h>

namespace plyform::curve_file_test {
namespace {

namespace fs = std::filesystem;

/// A file of this process that goes when the test does.
struct CurveFile {
  fs::path path;
  explicit CurveFile(const std::string& text) {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    path = fs::path(::testing::TempDir()) /
           (std::string("plyform_curve_") + test->name() + "_" + std::to_string(getpid()));
    std::ofstream(path, std::ios::binary) << text;
  }
  CurveFile(const CurveFile&) = delete;
  CurveFile& operator=(const CurveFile&) = delete;
  ~CurveFile() { fs::remove(path); }
};

struct Reading {
  std::optional<Curve> curve;
  Diagnostics diagnostics;
  std::string file;
  /// Every message, the file's name as FILE.
  std::string texts() const {
    std::string all;
    for (const std::string& warning : diagnostics.warnings)
      all += warning + "\n";
    for (const CaseError& error : diagnostics.errors)
      all += error.text() + "\n";
    for (std::size_t at; (at = all.find(file)) != std::string::npos;)
      all.replace(at, file.size(), "FILE");
    return all;
  }
};

Reading read(const std::string& text, const std::string& x = "", const std::string& y = "") {
  const CurveFile file(text);
  Reading reading;
  reading.file = file.path.string();
  CurveColumns columns;
  columns.x.column = x;
  columns.y.column = y;
  reading.curve = read_curve(file.path, columns, reading.diagnostics);
  return reading;
}

Reading checked(const std::string& text) {
  Reading reading = read(text);
  EXPECT_TRUE(reading.curve) << reading.texts();
  if (reading.curve && !(check_rising(*reading.curve, "extension", reading.diagnostics) &&
                         check_zeros(*reading.curve, "extension", "load", reading.diagnostics)))
    reading.curve.reset();
  return reading;
}

using Values = std::vector<double>;

TEST(CurveFile, ReadsCommaSemicolonAndTab) {
  for (const char* separator : {",", ";", "\t"}) {
    const std::string s = separator;
    const Reading reading = read("0" + s + "0\n1.5" + s + " 2e-1\n+2" + s + ".5\n");
    ASSERT_TRUE(reading.curve) << reading.texts();
    EXPECT_EQ(reading.curve->x, (Values{0.0, 1.5, 2.0}));
    EXPECT_EQ(reading.curve->y, (Values{0.0, 0.2, 0.5}));
    EXPECT_EQ(reading.curve->line, (std::vector<int>{1, 2, 3}));
    EXPECT_EQ(reading.curve->x_name, "column 1");
  }
}

TEST(CurveFile, ReadsWhatMachinesAndSpreadsheetsAdd) {
  const Reading reading = read("\xEF\xBB\xBF# made by a machine\r\n\r\n"
                               "\"Extension, crosshead\",\"Load \"\"A\"\"\"\r\n(mm),(N)\r\n"
                               "0.0,0.0\r\n  # a pause\r\n\"1.0\", 2.0 \r\n2.0,3.0",
                               "Extension, crosshead", "Load \"A\"");
  ASSERT_TRUE(reading.curve) << reading.texts();
  EXPECT_EQ(reading.curve->x, (Values{0.0, 1.0, 2.0}));
  EXPECT_EQ(reading.curve->y, (Values{0.0, 2.0, 3.0}));
  EXPECT_EQ(reading.curve->line, (std::vector<int>{5, 7, 8}));
  EXPECT_EQ(reading.curve->x_name, "Extension, crosshead");
}

TEST(CurveFile, ChoosesColumnsByNameOrNumber) {
  const std::string text = "time_s,upper_force_N,upper_displacement_mm\n0,1,2\n3,4,5\n";
  for (const char* x : {"upper_displacement_mm", "3"})
    for (const char* y : {"upper_force_N", "2"}) {
      const Reading reading = read(text, x, y);
      ASSERT_TRUE(reading.curve) << reading.texts();
      EXPECT_EQ(reading.curve->x, (Values{2.0, 5.0}));
      EXPECT_EQ(reading.curve->y, (Values{1.0, 4.0}));
      EXPECT_EQ(reading.curve->y_name, "upper_force_N");
    }
}

TEST(CurveFile, LeavesOutRowsWithAnEmptyCellInItsColumns) {
  const Reading reading = read("d,A,B\n0,,7\n1,2,\n, 3,8\n2,4,9\n", "d", "A");
  ASSERT_TRUE(reading.curve) << reading.texts();
  EXPECT_EQ(reading.curve->x, (Values{1.0, 2.0}));
  EXPECT_EQ(reading.curve->y, (Values{2.0, 4.0}));
  EXPECT_EQ(reading.curve->line, (std::vector<int>{3, 5}));
  EXPECT_EQ(reading.texts(), "");
}

TEST(CurveFile, NamesEveryMistakeWithPlaceAndRemedy) {
  struct Wrong {
    const char *text, *x, *y, *message;
  };
  const Wrong wrong[] = {
      {"d,F\n0,0\n1,abc\n", "", "", "FILE:3:3: error: F = abc: must be a number; correct it"},
      {"d;F\n0;0\n1,5;2\n", "", "", "FILE:3:1: error: d = 1,5: must be a number; write a decimal"},
      {"0,0\n1,-\n", "", "", "FILE:2:3: error: column 2 = -: must be a number"},
      {"d,F\n0,\n1,\n", "", "", "FILE:2:1: error: no row has a number in each of d, F; choose"},
      {"0,0\n1,nan\n", "", "", "FILE:2:3: error: column 2 = nan: must be a finite number"},
      {"0,0\n1,1e999\n", "", "", "FILE:2:3: error: column 2 = 1e999: must be a finite number"},
      {"0,0,0\n1,1\n", "1", "3",
       "FILE:2:1: error: the row has 2 columns, there must be at least 3"},
      {"0,0\n1\n", "", "", "FILE:2:1: error: the row has 1 column, there must be at"},
      {"0 0\n1 1\n", "", "",
       "FILE:1:1: error: the row has 1 column, there must be at least 2; separate"},
      {"0,0,0\n1,1,1\n", "", "3", "the columns are column 1 (of unknown kind), column 2"},
      {"0,0\n1,1\n", "", "3", "--y-column:1:1: error: y-column = 3: the rows have 2 columns; give"},
      {"d,force_N\n0,0\n", "", "force",
       "--y-column:1:1: error: y-column = force: is no column of the header;"},
      {"d,force_N\n0,0\n", "", "force_M", "did you mean force_N?"},
      {"d,d\n0,0\n", "d", "",
       "--x-column:1:1: error: x-column = d: stands 2 times in the header; give the"},
      {"0,0\n1,1\n", "d", "",
       "--x-column:1:1: error: x-column = d: names a column, but the file has no hea"},
      {"0,0\n1,1\n", "0", "",
       "--x-column:1:1: error: x-column = 0: must be a whole number from 1; give"},
      {"0,0\n1,1\n", "2", "2",
       "--y-column:1:1: error: y-column = column 2: is the column of --x-column too; give"},
      {"", "", "", "FILE:1:1: error: the file has no row of numbers; give a CSV"},
      {"# nothing\nd,F\n", "", "", "FILE:1:1: error: the file has no row of numbers; give a CSV"}};
  for (const Wrong& w : wrong) {
    const Reading reading = read(w.text, w.x, w.y);
    EXPECT_FALSE(reading.curve) << w.text;
    EXPECT_NE(reading.texts().find(w.message), std::string::npos)
        << w.text << "expected: " << w.message << "\nfound: " << reading.texts();
    EXPECT_LE(reading.diagnostics.errors.size(), 2u) << reading.texts();
  }
}

TEST(CurveFile, SaysWhatCannotBeRead) {
  Diagnostics diagnostics;
  EXPECT_FALSE(read_curve("nosuch.csv", CurveColumns{}, diagnostics));
  EXPECT_FALSE(read_curve(::testing::TempDir(), CurveColumns{}, diagnostics));
  ASSERT_EQ(diagnostics.errors.size(), 2u);
  EXPECT_NE(diagnostics.errors[0].text().find("the curve cannot be opened"), std::string::npos);
  EXPECT_NE(diagnostics.errors[1].text().find("is a folder"), std::string::npos);
  EXPECT_NE(read(std::string("\xFF\xFE\x31\0", 4)).texts().find("no plain text in UTF-8"),
            std::string::npos);
}

TEST(CurveFile, ReportsTheFirstOfManyMistakes) {
  std::string text = "0,0\n";
  for (int i = 0; i < 100; ++i)
    text += "x1,x2\n";
  const Reading reading = read(text);
  EXPECT_FALSE(reading.curve);
  EXPECT_EQ(reading.diagnostics.errors.size(), 6u);
  EXPECT_NE(reading.texts().find("195 more mistakes like these"), std::string::npos);
}

TEST(CurveChecks, SortStepsBackWithinNoiseAndSaySo) {
  const Reading reading = checked("0,0\n50,1\n49.5,2\n49.8,3\n49.8,4\n100,5\n");
  ASSERT_TRUE(reading.curve) << reading.texts();
  EXPECT_EQ(reading.curve->x, (Values{0.0, 49.5, 49.8, 49.8, 50.0, 100.0}));
  EXPECT_EQ(reading.curve->y, (Values{0.0, 2.0, 3.0, 4.0, 1.0, 5.0}));
  EXPECT_EQ(reading.curve->line, (std::vector<int>{1, 3, 4, 5, 2, 6}));
  EXPECT_NE(reading.texts().find("FILE:1:1: warning: the extension steps back 1 time, by 0.5 % of"),
            std::string::npos)
      << reading.texts();
}

TEST(CurveChecks, LeaveRisingCurvesAlone) {
  const Reading reading = checked("0,0\n0,0.1\n1,1\n1,1\n2,-0.01\n3,4\n");
  ASSERT_TRUE(reading.curve) << reading.texts();
  EXPECT_EQ(reading.texts(), "");
  EXPECT_EQ(reading.curve->x, (Values{0.0, 0.0, 1.0, 1.0, 2.0, 3.0}));
}

TEST(CurveChecks, RefuseWhatIsNoLoading) {
  struct Wrong {
    const char *text, *message;
  };
  const Wrong wrong[] = {
      {"0,0\n1,1\n2,2\n1,1\n0,0\n",
       "FILE:4:1: error: column 1 = 1 mm: the extension must rise, but "
       "falls from 2 mm in line 3; if the test was unloaded there, take "
       "out the rows from line 4 on"},
      {"0,0\n-1,1\n-2,2\n", "FILE:2:1: error: column 1 = -1 mm: the extension falls from the first "
                            "row on, it must rise; turn its sign round"},
      {"5,0\n4,1\n3,2\n", "the extension falls from the first row on"},
      {"2,0\n2,1\n2,2\n", "the extension is the same in every row, it must rise; choose"},
      {"-1,0\n0,1\n2,2\n", "FILE:1:1: error: column 1 = -1 mm: the extension must not be below 0; "
                           "give the extension at which the load begins to rise with --toe"},
      {"0,0\n1,-1\n2,-2\n",
       "FILE:3:1: error: column 2 = -2 N: the load must not be below 0 by more "
       "than 2 % of its largest value, 0 N; turn the sign"},
      {"0,-1\n1,4\n2,9\n", "column 2 = -1 N: the load must not be below 0 by more than 2 % of its "
                           "largest value, 9 N; give the value that the load cell shows"},
      {"0,0\n1,0\n2,0\n",
       "FILE:1:1: error: column 2 = 0: the load is 0 in every row, it must rise; "
       "choose another column with --y-column"}};
  for (const Wrong& w : wrong) {
    const Reading reading = checked(w.text);
    EXPECT_FALSE(reading.curve) << w.text;
    EXPECT_EQ(reading.diagnostics.errors.size(), 1u) << reading.texts();
    EXPECT_NE(reading.texts().find(w.message), std::string::npos)
        << w.text << "expected: " << w.message << "\nfound: " << reading.texts();
  }
}

TEST(CurveChecks, LeaveOutRowsBarelyBelowZero) {
  const Reading reading = checked("-0.9,3\n-0.2,2\n0,0\n100,5\n");
  ASSERT_TRUE(reading.curve) << reading.texts();
  EXPECT_EQ(reading.curve->x, (Values{0.0, 100.0}));
  EXPECT_NE(
      reading.texts().find("warning: 2 rows with extension below 0, down to -0.9 mm: left out"),
      std::string::npos)
      << reading.texts();
}

} // namespace
} // namespace plyform::curve_file_test
