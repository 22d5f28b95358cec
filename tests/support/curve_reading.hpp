// SPDX-License-Identifier: GPL-3.0-or-later
// A curve read from a text, with all that is said of it.
#pragma once

#include "core/identify/curve_file.hpp"
#include "support/fit_curves.hpp"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <optional>
#include <string>
#include <unistd.h>

namespace plyform {

struct CurveReading {
  std::optional<Curve> curve;
  std::string texts;
};

inline CurveReading curve_from(const std::string& text, const CurveColumns& columns) {
  const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
  const std::filesystem::path path =
      std::filesystem::path(::testing::TempDir()) /
      (std::string("plyform_curve_") + test->name() + std::to_string(getpid()));
  std::ofstream(path, std::ios::binary) << text;
  CurveReading reading;
  Diagnostics diagnostics;
  reading.curve = read_curve(path, columns, diagnostics);
  reading.texts = texts(diagnostics);
  std::filesystem::remove(path);
  return reading;
}

} // namespace plyform
