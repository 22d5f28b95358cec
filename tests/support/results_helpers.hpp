// SPDX-License-Identifier: GPL-3.0-or-later
// What the tests of the result files share.
#pragma once

#include "core/results/result_fields.hpp"
#include "support/example_results.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <unistd.h>
#include <vector>

namespace plyform::results_test {

namespace fs = std::filesystem;
using example::frame;

/// A folder of its own for each test, removed after.
class ResultFolder : public ::testing::Test {
protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    directory = fs::temp_directory_path() /
                (std::string("plyform_results_") + test->name() + "_" + std::to_string(getpid()));
    fs::remove_all(directory);
  }
  void TearDown() override { fs::remove_all(directory); }
  fs::path directory;
};

inline std::string content(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  EXPECT_TRUE(in) << path;
  return {std::istreambuf_iterator<char>(in), {}};
}

inline void put(const fs::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

inline std::vector<std::vector<std::string>> rows_of(const std::string& text) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream fields(line);
    rows.emplace_back();
    for (std::string field; std::getline(fields, field, ',');)
      rows.back().push_back(field);
  }
  return rows;
}

/// The message of the std::runtime_error that `action` throws; empty when it throws none.
template <class Action>
std::string error_of(Action action) {
  try {
    action();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// The relative path of every file below `directory`.
inline std::vector<std::string> files_in(const fs::path& directory) {
  std::vector<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(directory))
    if (entry.is_regular_file()) files.push_back(fs::relative(entry.path(), directory).string());
  std::sort(files.begin(), files.end());
  return files;
}

inline void write_run(const fs::path& directory, std::initializer_list<double> times) {
  ResultWriter writer(directory);
  for (const double time : times)
    writer.write_frame(frame(time));
  writer.write_final(frame(*(times.end() - 1)), Summary{});
}

inline void expect_same(const PlyFrame& a, const PlyFrame& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.angle_deg, b.angle_deg);
  EXPECT_EQ(a.x0, b.x0);
  EXPECT_EQ(a.x, b.x);
  EXPECT_EQ(a.triangles, b.triangles);
  ASSERT_EQ(a.families.size(), b.families.size());
  for (std::size_t i = 0; i < a.families.size(); ++i)
    EXPECT_EQ(a.families[i].angle_deg, b.families[i].angle_deg);
  std::map<std::string, std::string> columns; // bytes of the values by name
  const auto bytes_of = [](const auto& values) {
    return std::string(reinterpret_cast<const char*>(values.data()),
                       values.size() * sizeof(values[0]));
  };
  each_column(a, [&](const Column& column, const auto& values) {
    columns[column.name] = bytes_of(values);
  });
  each_column(b, [&](const Column& column, const auto& values) {
    ASSERT_EQ(columns.count(column.name), 1u) << column.name;
    EXPECT_EQ(columns[column.name], bytes_of(values)) << column.name;
    columns.erase(column.name);
  });
  EXPECT_TRUE(columns.empty());
}

inline void expect_same(const ToolFrame& a, const ToolFrame& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.surface.x, b.surface.x);
  EXPECT_EQ(a.surface.triangles, b.surface.triangles);
  EXPECT_EQ(a.displacement, b.displacement);
  EXPECT_EQ(a.force, b.force);
  EXPECT_EQ(a.stroke_mm, b.stroke_mm);
  EXPECT_EQ(a.force_N, b.force_N);
  EXPECT_EQ(a.force_raw_N, b.force_raw_N);
}

inline void expect_same(const BoundaryFrame& a, const BoundaryFrame& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.stroke_mm, b.stroke_mm);
  EXPECT_EQ(a.force_N, b.force_N);
  EXPECT_EQ(a.force, b.force);
}

/// Every bit: results.h5 holds doubles.
inline void expect_same(const Frame& a, const Frame& b) {
  EXPECT_EQ(a.time, b.time);
  EXPECT_EQ(a.stroke_mm, b.stroke_mm);
  EXPECT_EQ(a.step, b.step);
  ASSERT_EQ(a.plies.size(), b.plies.size());
  for (std::size_t i = 0; i < a.plies.size(); ++i)
    expect_same(a.plies[i], b.plies[i]);
  ASSERT_EQ(a.tools.size(), b.tools.size());
  for (std::size_t i = 0; i < a.tools.size(); ++i)
    expect_same(a.tools[i], b.tools[i]);
  ASSERT_EQ(a.boundaries.size(), b.boundaries.size());
  for (std::size_t i = 0; i < a.boundaries.size(); ++i)
    expect_same(a.boundaries[i], b.boundaries[i]);
}

} // namespace plyform::results_test
