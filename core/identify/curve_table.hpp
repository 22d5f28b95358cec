// SPDX-License-Identifier: GPL-3.0-or-later
// The rows and columns of a CSV file, as text; and which of its columns a test needs.
//
// Empty lines and lines that start with # are ignored. Separator: the first of tab, semicolon,
// comma that occurs in the first row that has any. Header: rows at the top without any number. The
// first of those as wide as the rows of numbers names the columns, the one after it may have their
// units.
#pragma once

#include "base/diagnostics.hpp"
#include "core/identify/column_meaning.hpp"

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace plyform {

struct CurveField {
  std::string text; ///< without quotes and outer blanks
  int column;       ///< in the line, in characters from 1
};

struct CurveRow {
  int line; ///< from 1
  std::vector<CurveField> fields;
};

struct CurveTable {
  std::string file;
  std::vector<CurveRow> rows;                 ///< of numbers
  std::vector<std::string> names;             ///< of the header; empty without one
  std::vector<ColumnMeaning> meanings;        ///< of each name
  int header_line = 1;                        ///< of the names, from 1
  std::size_t width() const;                  ///< columns of the first row of numbers
  std::string name_of(std::size_t i) const;   ///< else "column 3"
  ColumnMeaning meaning(std::size_t i) const; ///< unknown without a header
};

/// Reads a file; reports an error and returns nothing if it cannot be read or has no number.
std::optional<CurveTable> read_curve_table(const std::filesystem::path& file,
                                           Diagnostics& diagnostics);

/// A column as the user chooses it.
struct ColumnOption {
  std::string column; ///< name in the header or number from 1; empty: found by its quantity
  std::string unit;   ///< in the place of the header's; empty: the header's
};

/// A column that a test needs.
struct ColumnRequest {
  std::string option;                    ///< "--x-column", for messages
  std::string unit_option;               ///< "--x-unit"
  ColumnOption chosen;                   ///< by the user
  Quantity quantity = Quantity::unknown; ///< length, force, angle or strain
  std::string word;                      ///< "extension": in messages
  std::string preferred;                 ///< words: decide between several columns of the quantity
  std::string hint;                      ///< added to the remedy if the quantity is another
  bool optional = false;                 ///< may be missing unless chosen
  bool angle_does = false;               ///< may be missing beside a column of angles
  std::optional<Quantity> also = {};     ///< taken where no column is of `quantity`
  std::string no_per_length = {};        ///< why a force per length does not do
  std::string only = {};                 ///< words of which a name must have one; empty: any name
  std::string wanted = {};               ///< of other_measure
};

struct ChosenColumn {
  std::size_t index; ///< from 0
  double factor;     ///< to mm, N, rad, 1, N/mm, N/mm^2
  Quantity quantity; ///< of the request, or its `also`
  std::string unit;  ///< of the file's numbers; empty of a strain without one
};

/// The column of each request; none for an optional one that is missing. By the user's choice; else
/// the one of that quantity by the header; else, if neither header nor choice says more and as many
/// columns are left as are needed, those from left to right; but beside an angle one that says
/// `angle_does` is missing rather than guessed, unless others are guessed too. Reports errors and
/// returns nothing where that leaves a doubt: several columns of the quantity, a column of another
/// quantity.
std::optional<std::vector<std::optional<ChosenColumn>>>
choose_columns(const CurveTable& table, const std::vector<ColumnRequest>& requests,
               Diagnostics& diagnostics);

} // namespace plyform
