// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/identify/curve_file.hpp"

#include "base/format.hpp"
#include "base/text.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace plyform {
namespace {

/// The number in a field, or, if it is not valid, the rule that it breaks and the remedy.
struct Cell {
  double number = 0.0, value = 0.0; ///< as written, and in the program's unit
  std::string rule, remedy;
};

Cell read_cell(const std::string& text, double factor) {
  const std::optional<double> number = number_in(text);
  if (!number) {
    const bool decimal_comma = text.find(',') != std::string::npos;
    return {0.0, 0.0, "must be a number",
            decimal_comma ? "write a decimal point instead of the comma"
                          : "correct it, or take the row out or put # before it"};
  }
  if (!std::isfinite(*number * factor))
    return {0.0, 0.0, "must be a finite number", "take the row out or put # before it"};
  return {*number, *number * factor, "", ""};
}

/// A column to read, and where its numbers go.
struct Target {
  ChosenColumn column;
  std::string name;
  std::vector<double>* values;
  WrittenColumn* written;
};

std::string names_of(const std::vector<Target>& targets) {
  std::vector<std::string> names;
  for (const Target& target : targets)
    names.push_back(target.name);
  return joined(names);
}

/// Collects the numbers; reports the first five errors and the number of further ones.
bool read_cells(const CurveTable& table, const std::vector<Target>& targets, Curve& curve,
                Diagnostics& diagnostics) {
  constexpr int shown = 5;
  std::size_t needed = 0;
  for (const Target& target : targets)
    needed = std::max(needed, target.column.index + 1);
  int mistakes = 0;
  for (const CurveRow& row : table.rows) {
    if (row.fields.size() < needed) {
      if (++mistakes <= shown)
        diagnostics.error({curve.file, row.line, 1}, "", "",
                          fmt::format("the row has {} column{}, there must be at least {}",
                                      row.fields.size(), row.fields.size() == 1 ? "" : "s", needed),
                          "separate columns by comma, semicolon or tab, and give every row all of "
                          "them");
      continue;
    }
    const bool empty = std::any_of(targets.begin(), targets.end(), [&row](const Target& target) {
      return row.fields[target.column.index].text.empty();
    });
    if (empty) continue; // as tables of several curves have where one of them ends
    for (const Target& target : targets) {
      const CurveField& field = row.fields[target.column.index];
      const Cell cell = read_cell(field.text, target.column.factor);
      target.values->push_back(cell.value);
      target.written->number.push_back(cell.number);
      if (!cell.rule.empty() && ++mistakes <= shown)
        diagnostics.error({curve.file, row.line, field.column}, target.name, field.text, cell.rule,
                          cell.remedy);
    }
    curve.line.push_back(row.line);
  }
  if (mistakes > shown)
    diagnostics.error({curve.file, table.rows.back().line, 1}, "", "",
                      fmt::format("{} more mistakes like these", mistakes - shown),
                      "check the separator and the columns chosen");
  if (mistakes == 0 && curve.line.empty())
    diagnostics.error({curve.file, table.rows.front().line, 1}, "", "",
                      fmt::format("no row has a number in each of {}", names_of(targets)),
                      "choose other columns");
  return mistakes == 0 && !curve.line.empty();
}

std::vector<ColumnRequest> requests_of(const CurveColumns& columns) {
  std::vector<ColumnRequest> requests{
      {"--x-column", "--x-unit", columns.x, columns.x_is, columns.x_word, columns.x_preferred,
       columns.x_hint, columns.with_angle && !columns.angle.column.empty(), columns.with_angle,
       columns.x_also},
      {columns.y_option, "--y-unit", columns.y, columns.y_is, columns.y_word, columns.y_preferred,
       "", false, false, columns.y_also, columns.no_per_length}};
  for (ColumnRequest& request : requests)
    request.only = columns.only;
  requests[0].wanted = columns.x_wanted, requests[1].wanted = columns.y_wanted;
  if (columns.with_angle) {
    requests.push_back({"--angle-column", "--angle-unit", columns.angle, Quantity::angle,
                        "shear angle", "shear gamma", "", true});
    requests.back().wanted = "shear angle";
  }
  return requests;
}

} // namespace

std::optional<Curve> read_curve(const std::filesystem::path& file, const CurveColumns& columns,
                                Diagnostics& diagnostics) {
  const std::optional<CurveTable> table = read_curve_table(file, diagnostics);
  if (!table) return std::nullopt;
  const auto chosen = choose_columns(*table, requests_of(columns), diagnostics);
  if (!chosen) return std::nullopt;
  Curve curve;
  curve.file = table->file;
  curve.y_name = table->name_of((*chosen)[1]->index);
  curve.y_is = (*chosen)[1]->quantity;
  std::vector<Target> targets{{*(*chosen)[1], curve.y_name, &curve.y, &curve.y_written}};
  if ((*chosen)[0]) {
    curve.x_name = table->name_of((*chosen)[0]->index);
    curve.x_is = (*chosen)[0]->quantity;
    targets.insert(targets.begin(), {*(*chosen)[0], curve.x_name, &curve.x, &curve.x_written});
  }
  if (columns.with_angle && (*chosen)[2]) {
    curve.angle_name = table->name_of((*chosen)[2]->index);
    targets.push_back({*(*chosen)[2], curve.angle_name, &curve.angle, &curve.angle_written});
  }
  for (const Target& target : targets)
    target.written->unit = target.column.unit, target.written->factor = target.column.factor;
  if (!read_cells(*table, targets, curve, diagnostics)) return std::nullopt;
  curve.x.resize(curve.y.size(), 0.0);
  return curve;
}

Curve rows_of(const Curve& curve, const std::vector<std::size_t>& rows) {
  Curve result = curve;
  result.x.clear(), result.y.clear(), result.line.clear(), result.angle.clear();
  for (const auto& [from, to] : {std::pair{&curve.x_written, &result.x_written},
                                 {&curve.y_written, &result.y_written},
                                 {&curve.angle_written, &result.angle_written}}) {
    to->number.clear();
    for (const std::size_t row : rows)
      if (!from->number.empty()) to->number.push_back(from->number[row]);
  }
  for (const std::size_t row : rows) {
    result.x.push_back(curve.x[row]);
    result.y.push_back(curve.y[row]);
    result.line.push_back(curve.line[row]);
    if (!curve.angle.empty()) result.angle.push_back(curve.angle[row]);
  }
  return result;
}

std::string written(const WrittenColumn& column, const std::string& name, std::size_t row,
                    double now) {
  const bool named = column.unit.empty() || meaning_of(name, "").unit == column.unit;
  const std::string unit = named ? "" : " " + column.unit;
  const double since = now / column.factor;
  if (row >= column.number.size()) return fmt::format("{:g}{}", since, unit);
  const double number = column.number[row];
  std::string text = fmt::format("{:g}{}", number, unit);
  constexpr double same = 1e-6;
  if (std::abs(since - number) > same * std::max(std::abs(since), std::abs(number)))
    text += fmt::format(" ({:g} without what is taken off)", since);
  return text;
}

std::string written_x(const Curve& curve, std::size_t row) {
  const double start =
      curve.x_is == Quantity::stretch && !curve.x_written.number.empty() ? 1.0 : 0.0;
  return written(curve.x_written, curve.x_name, row, curve.x[row] + start);
}

std::string written_y(const Curve& curve, std::size_t row) {
  return written(curve.y_written, curve.y_name, row, curve.y[row]);
}

std::string written_angle(const Curve& curve, std::size_t row) {
  return written(curve.angle_written, curve.angle_name, row, curve.angle[row]);
}

Curve sorted_by_x(const Curve& curve) {
  std::vector<std::size_t> order(curve.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return curve.x[a] < curve.x[b]; });
  return rows_of(curve, order);
}

} // namespace plyform
