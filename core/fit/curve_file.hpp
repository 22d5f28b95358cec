// SPDX-License-Identifier: GPL-3.0-or-later
// A measured curve from a CSV file: two columns of numbers, with the line that each row stands in.
//
// Lines that start with # and empty lines are left out. Separator: the first of tab, semicolon,
// comma that the first row has. Header: rows at the top without any number, the first of them
// names the columns (a second one usually has the units). Decimal point, not comma.
#pragma once

#include "core/base/diagnostics.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace plyform {

struct Curve {
  std::string file;
  std::string x_name, y_name; ///< from the header, else "column 1"
  std::vector<double> x, y;
  std::vector<int> line; ///< from 1, of each row
  std::size_t size() const { return x.size(); }
};

/// Reads two columns, each given by its name in the header or its number from 1; empty: the first
/// two. Every mistake goes to `findings`, of unreadable numbers the first five; then the answer is
/// nothing. Never throws for anything that stands in the file.
std::optional<Curve> read_curve(const std::filesystem::path& file, const std::string& x_column,
                                const std::string& y_column, Diagnostics& diagnostics);

/// What the curve of a test that only loads must satisfy; false, and a report, if it does not:
/// - x rises; it may step back by `back_share` of its span at most, then the rows are sorted and a
///   warning says so;
/// - x starts at 0 or above; rows below by no more than that share are left out with a warning;
/// - y is not below 0 by more than `noise_share` of its largest value.
/// `x_word` and `y_word` ("extension", "load") name the columns in messages.
bool check_curve(Curve& curve, const std::string& x_word, const std::string& y_word,
                 Diagnostics& diagnostics);
inline constexpr double back_share = 0.01;
/// Load cells are good to some tenths of a percent of their range, of which a test uses a part.
inline constexpr double noise_share = 0.02;

} // namespace plyform
