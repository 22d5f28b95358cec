// SPDX-License-Identifier: GPL-3.0-or-later
// Case files of the tests and those that are shipped.
#pragma once

#include "core/setup/prepare_case.hpp"

#include <algorithm>
#include <filesystem>
#include <gtest/gtest.h>
#include <string>

namespace plyform {

namespace fs = std::filesystem;

inline const fs::path data_folder = PLYFORM_TEST_DATA;

inline std::string all_texts(const PreparedCase& reading) {
  std::string texts;
  for (const CaseError& error : reading.errors)
    texts += error.text() + "\n";
  return texts;
}

/// A case that must be right.
inline Case good_case(const fs::path& file, const std::vector<Override>& overrides = {}) {
  const PreparedCase reading = prepare_case(file, overrides);
  EXPECT_TRUE(reading.value) << all_texts(reading);
  return reading.value ? *reading.value : Case{};
}

inline bool is_fabric(const fs::path& shipped) {
  return shipped.parent_path().filename() == "fabrics";
}

/// Not a case but a study of one, or what studies include.
inline bool is_study(const fs::path& shipped) {
  return std::find(shipped.begin(), shipped.end(), "studies") != shipped.end();
}

} // namespace plyform
