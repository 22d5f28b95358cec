// SPDX-License-Identifier: GPL-3.0-or-later
// A measured curve from a CSV file: two columns of numbers, or three, and the line of each row.
// Decimal point, not comma. core/identify/curve_table.hpp says how files and columns are read.
#pragma once

#include "base/geometry.hpp"
#include "core/identify/curve_table.hpp"

namespace plyform {

/// Numbers of a column as the file has them, for messages.
struct WrittenColumn {
  std::vector<double> number = {}; ///< of each row; empty of curves that are from no file
  std::string unit = {};           ///< of them; empty of a strain without one
  /// To the program's units; NaN of numbers that are made of others.
  double factor = 1.0;
};

struct Curve {
  std::string file;
  std::string x_name, y_name; ///< from the header, else "column 1"; x's empty if it is missing
  std::vector<double> x, y;   ///< x: mm or strain; y: N; else as asked for
  std::vector<int> line;      ///< from 1, of each row
  /// rad, of each row; empty if not measured
  std::vector<double> angle = {};
  std::string angle_name = {};
  Quantity y_is = Quantity::force;  ///< or force_per_length, stress
  Quantity x_is = Quantity::length; ///< or strain, stretch
  WrittenColumn x_written = {}, y_written = {}, angle_written = {{}, "", degree};
  std::size_t size() const { return x.size(); }
};

/// The columns of a curve.
struct CurveColumns {
  ColumnOption x, y, angle; ///< as the user chooses them
  Quantity x_is = Quantity::length, y_is = Quantity::force;
  std::string x_word = "extension", y_word = "load";
  std::string x_preferred = "extension displacement crosshead stroke elongation deflection";
  std::string y_preferred = {};
  std::string y_option = "--y-column"; ///< that names y's
  std::string x_hint = {};             ///< if x is of another quantity
  std::optional<Quantity> x_also = {}, y_also = {};
  std::string no_per_length = {};           ///< as in ColumnRequest
  std::string only = {};                    ///< of x and y, as in ColumnRequest
  std::string x_wanted = {}, y_wanted = {}; ///< of other_measure
  /// A column of angles is read if there is one; x may miss if it is chosen, or if all else is
  /// found.
  bool with_angle = false;
};

/// Reads the columns, in mm, N, rad, 1, N/mm, N/mm^2. Rows with an empty cell in one of them are
/// left out. Errors go to `diagnostics` (of unreadable numbers the first five), and nothing is
/// returned then. Never throws because of the content of the file.
std::optional<Curve> read_curve(const std::filesystem::path& file, const CurveColumns& columns,
                                Diagnostics& diagnostics);

/// The number of a row as its file has it, with the unit that it is in unless `name` has it: "30"
/// of "extension (in)", "30 in" of "d"; and what it has become since, if something has been taken
/// off: "5 (-2 without what is taken off)". `now`: in the program's units.
std::string written(const WrittenColumn& column, const std::string& name, std::size_t row,
                    double now);
std::string written_x(const Curve& curve, std::size_t row);
std::string written_y(const Curve& curve, std::size_t row);
std::string written_angle(const Curve& curve, std::size_t row);

/// Check the curve of a test with monotonic loading; a zero that is wrong is corrected in between.
/// Report an error and return false unless
/// - x increases; where it decreases by at most `share` of its span the rows are sorted, with a
/// warning;
/// - x is at least 0; rows below by at most `back_share` are removed, with a warning;
/// - y is not below 0 by more than `noise_share` of its largest value.
/// `x_word` and `y_word` ("extension", "load") name the columns in messages.
inline constexpr double back_share = 0.01;
bool check_rising(Curve& curve, const std::string& x_word, Diagnostics& diagnostics,
                  double share = back_share);
bool check_zeros(Curve& curve, const std::string& x_word, const std::string& y_word,
                 Diagnostics& diagnostics);
/// Load cells are accurate to some tenths of a percent of their range, of which a test uses a part.
inline constexpr double noise_share = 0.02;

/// The rows of a curve with the numbers `rows`, in that order.
Curve rows_of(const Curve& curve, const std::vector<std::size_t>& rows);

/// The rows in ascending x, those of equal x as they were.
Curve sorted_by_x(const Curve& curve);

} // namespace plyform
