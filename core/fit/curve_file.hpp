// SPDX-License-Identifier: GPL-3.0-or-later
// A measured curve from a CSV file: two columns of numbers, and the line of each row.
//
// Empty lines and lines that start with # are ignored. Separator: the first of tab, semicolon,
// comma that occurs in the first row. Header: rows at the top without any number, the first of
// which names the columns (a second one usually has the units). Decimal point, not comma.
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
/// two. Errors go to `diagnostics` (of unreadable numbers the first five), and nothing is returned
/// then. Never throws because of the content of the file.
std::optional<Curve> read_curve(const std::filesystem::path& file, const std::string& x_column,
                                const std::string& y_column, Diagnostics& diagnostics);

/// Checks the curve of a test with monotonic loading; reports an error and returns false unless
/// - x increases; where it decreases by at most `back_share` of its span the rows are sorted, with
/// a
///   warning;
/// - x is at least 0; rows below by at most that fraction are removed, with a warning;
/// - y is not below 0 by more than `noise_share` of its largest value.
/// `x_word` and `y_word` ("extension", "load") name the columns in messages.
bool check_curve(Curve& curve, const std::string& x_word, const std::string& y_word,
                 Diagnostics& diagnostics);
inline constexpr double back_share = 0.01;
/// Load cells are accurate to some tenths of a percent of their range, of which a test uses a part.
inline constexpr double noise_share = 0.02;

} // namespace plyform
