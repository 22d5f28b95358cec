// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fit/curve_file.hpp"

#include "core/base/text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <numeric>
#include <string_view>

namespace plyform {
namespace {

struct Field {
  std::string text; ///< without quotes and outer blanks
  int column;       ///< in the line, in characters from 1
};

struct Row {
  int line;
  std::vector<Field> fields;
};

std::string trimmed(std::string_view text) {
  constexpr const char* blanks = " \t\r\f\v";
  const std::size_t from = text.find_first_not_of(blanks);
  if (from == std::string_view::npos) return "";
  return std::string(text.substr(from, text.find_last_not_of(blanks) - from + 1));
}

int characters(std::string_view text) {
  return static_cast<int>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; // not within a UTF-8 character
  }));
}

/// The fields of a line. A field in double quotes may hold the separator; "" in it is one quote.
std::vector<Field> split(std::string_view line, char separator) {
  std::vector<Field> fields;
  std::size_t at = 0;
  while (true) {
    const std::size_t start = at;
    std::string text;
    bool quoted = false;
    for (; at < line.size() && (quoted || line[at] != separator); ++at) {
      if (line[at] != '"')
        text += line[at];
      else if (quoted && at + 1 < line.size() && line[at + 1] == '"')
        text += line[++at];
      else
        quoted = !quoted;
    }
    const std::size_t first = std::min(line.find_first_not_of(' ', start), at);
    fields.push_back({trimmed(text), characters(line.substr(0, first)) + 1});
    if (at >= line.size()) return fields;
    ++at;
  }
}

char separator_of(std::string_view line) {
  for (const char candidate : {'\t', ';'})
    if (line.find(candidate) != std::string_view::npos) return candidate;
  return ',';
}

/// The number, if the whole text is one, else nothing. Independent of the locale.
std::optional<double> number_in(std::string_view text) {
  if (!text.empty() && text[0] == '+') text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::vector<Row> split_rows(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3); // byte-order mark of spreadsheets
  std::vector<Row> rows;
  char separator = '\0';
  for (int line = 1; !text.empty(); ++line) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view content = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (content.ends_with('\r')) content.remove_suffix(1);
    const std::string bare = trimmed(content);
    if (bare.empty() || bare[0] == '#') continue;
    if (separator == '\0') separator = separator_of(bare);
    rows.push_back({line, split(content, separator)});
  }
  return rows;
}

bool has_number(const Row& row) {
  return std::any_of(row.fields.begin(), row.fields.end(),
                     [](const Field& field) { return number_in(field.text).has_value(); });
}

/// Whether a row is a header: it has no number and no field that starts like one ("1,5" is an
/// error).
bool is_header(const Row& row) {
  return !has_number(row) &&
         std::any_of(row.fields.begin(), row.fields.end(), [](const Field& field) {
           return !field.text.empty() &&
                  std::string("0123456789.+-").find(field.text[0]) == std::string::npos;
         });
}

/// Index (from 0) of the column with a name or number; reports an error and returns nothing if
/// there is none.
std::optional<std::size_t> find_column(const std::string& wanted, const char* option,
                                       const std::vector<Field>& header, Diagnostics& diagnostics) {
  std::vector<std::string> names;
  for (const Field& field : header)
    names.push_back(field.text);
  const Place at{option, 1, 1};
  const std::string item = std::string(option).substr(2);
  const auto count = std::count(names.begin(), names.end(), wanted);
  if (count > 1) {
    diagnostics.error(at, item, wanted, fmt::format("stands {} times in the header", count),
                      "give the number of the column, from 1");
    return std::nullopt;
  }
  if (count == 1)
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), wanted) - names.begin());
  if (const auto number = number_in(wanted)) {
    if (*number >= 1.0 && *number <= 10000.0 && *number == std::floor(*number))
      return static_cast<std::size_t>(*number) - 1;
    diagnostics.error(at, item, wanted, "must be a whole number from 1",
                      "give the number or the name of a column");
  } else if (header.empty()) {
    diagnostics.error(at, item, wanted, "names a column, but the file has no header row",
                      "give the number of the column, from 1");
  } else {
    const std::string nearest = nearest_word(wanted, names);
    diagnostics.error(at, item, wanted, "is no column of the header",
                      nearest.empty() ? "it has " + joined(names)
                                      : fmt::format("did you mean {}?", nearest));
  }
  return std::nullopt;
}

/// The column of an option, or of `otherwise` if the option is empty. A column number larger than
/// the first row of numbers (`first`) has is an error of the option, if that was given.
std::optional<std::size_t> chosen_column(const std::string& wanted, const char* otherwise,
                                         const char* option, const std::vector<Row>& rows,
                                         std::size_t first, Diagnostics& diagnostics) {
  const std::vector<Field> header = first > 0 ? rows[0].fields : std::vector<Field>{};
  const auto column = find_column(wanted.empty() ? otherwise : wanted, option, header, diagnostics);
  if (!column || wanted.empty() || first == rows.size()) return column;
  const std::size_t count = rows[first].fields.size();
  if (*column < count) return column;
  diagnostics.error({option, 1, 1}, std::string(option).substr(2), wanted,
                    fmt::format("the rows have {} column{}", count, count == 1 ? "" : "s"),
                    "give another column, or separate columns by comma, semicolon or tab");
  return std::nullopt;
}

/// The number in a field, or, if it is not valid, the rule that it breaks and the remedy.
struct Cell {
  double value = 0.0;
  std::string rule, remedy;
};

Cell read_cell(const std::string& text) {
  const std::optional<double> number = number_in(text);
  if (!number) {
    const bool decimal_comma = text.find(',') != std::string::npos;
    return {0.0, text.empty() ? "is empty, there must be a number" : "must be a number",
            decimal_comma ? "write a decimal point instead of the comma"
                          : "correct it, or take the row out or put # before it"};
  }
  if (!std::isfinite(*number))
    return {0.0, "must be a finite number", "take the row out or put # before it"};
  return {*number, "", ""};
}

/// Collects the numbers; reports the first five errors and the number of further ones.
bool read_cells(const std::vector<Row>& rows, std::size_t first, const std::size_t columns[2],
                Curve& curve, Diagnostics& diagnostics) {
  constexpr int shown = 5;
  const std::size_t needed = std::max(columns[0], columns[1]) + 1;
  int mistakes = 0;
  for (std::size_t r = first; r < rows.size(); ++r) {
    const Row& row = rows[r];
    if (row.fields.size() < needed) {
      if (++mistakes <= shown)
        diagnostics.error({curve.file, row.line, 1}, "", "",
                          fmt::format("the row has {} column{}, there must be at least {}",
                                      row.fields.size(), row.fields.size() == 1 ? "" : "s", needed),
                          "separate columns by comma, semicolon or tab, and give every row all of "
                          "them");
      continue;
    }
    double values[2];
    for (std::size_t i = 0; i < 2; ++i) {
      const Field& field = row.fields[columns[i]];
      const Cell cell = read_cell(field.text);
      values[i] = cell.value;
      if (!cell.rule.empty() && ++mistakes <= shown)
        diagnostics.error({curve.file, row.line, field.column},
                          i == 0 ? curve.x_name : curve.y_name, field.text, cell.rule, cell.remedy);
    }
    curve.x.push_back(values[0]);
    curve.y.push_back(values[1]);
    curve.line.push_back(row.line);
  }
  if (mistakes > shown)
    diagnostics.error({curve.file, rows.back().line, 1}, "", "",
                      fmt::format("{} more mistakes like these", mistakes - shown),
                      "check the separator and the columns chosen");
  return mistakes == 0;
}

std::string name_of(const std::vector<Field>& header, std::size_t column) {
  const std::string number = fmt::format("column {}", column + 1);
  return column < header.size() && !header[column].text.empty() ? header[column].text : number;
}

/// Reports rows whose x decreases by more than noise: the test was unloaded, or the sign is wrong.
void report_falling(const Curve& curve, const std::string& word, std::size_t row, double peak,
                    int peak_line, Diagnostics& diagnostics) {
  const Place at{curve.file, curve.line[row], 1};
  const std::string value = fmt::format("{:g}", curve.x[row]);
  const double lowest = *std::min_element(curve.x.begin(), curve.x.end());
  if (curve.x.front() - curve.x.back() >= 0.5 * (curve.x.front() - lowest) &&
      *std::max_element(curve.x.begin(), curve.x.end()) - curve.x.front() <=
          back_share * (curve.x.front() - lowest))
    diagnostics.error(at, curve.x_name, value,
                      fmt::format("the {} falls from the first row on, it must rise", word),
                      "turn its sign round, or choose another column with --x-column");
  else
    diagnostics.error(
        at, curve.x_name, value,
        fmt::format("the {} must rise, but falls from {:g} in line {}", word, peak, peak_line),
        fmt::format("if the test was unloaded there, take out the rows from line {} on; "
                    "else check --x-column",
                    curve.line[row]));
}

/// Sorts the rows if x decreases by noise only; reports and returns false if by more.
bool sort_rows(Curve& curve, const std::string& word, Diagnostics& diagnostics) {
  const auto [least, most] = std::minmax_element(curve.x.begin(), curve.x.end());
  const double span = *most - *least;
  if (!(span > 0.0)) {
    diagnostics.error({curve.file, curve.line.front(), 1}, curve.x_name,
                      fmt::format("{:g}", curve.x.front()),
                      fmt::format("the {} is the same in every row, it must rise", word),
                      "choose another column with --x-column");
    return false;
  }
  std::size_t peak = 0;
  int steps = 0;
  double largest = 0.0;
  for (std::size_t i = 1; i < curve.size(); ++i) {
    if (curve.x[i] < curve.x[i - 1]) ++steps;
    if (curve.x[i] >= curve.x[peak]) peak = i;
    const double back = curve.x[peak] - curve.x[i];
    largest = std::max(largest, back);
    if (back <= back_share * span) continue;
    report_falling(curve, word, i, curve.x[peak], curve.line[peak], diagnostics);
    return false;
  }
  if (steps == 0) return true;
  diagnostics.warning(
      {curve.file, curve.line.front(), 1},
      fmt::format("the {} steps back {} time{}, by {:.2g} % of its span at most: the "
                  "rows have been sorted",
                  word, steps, steps == 1 ? "" : "s", 100.0 * largest / span));
  std::vector<std::size_t> order(curve.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return curve.x[a] < curve.x[b]; });
  const Curve old = curve;
  for (std::size_t i = 0; i < order.size(); ++i) {
    curve.x[i] = old.x[order[i]];
    curve.y[i] = old.y[order[i]];
    curve.line[i] = old.line[order[i]];
  }
  return true;
}

/// Removes rows with x below 0; reports and returns false if x is below by more than noise.
bool cut_below_zero(Curve& curve, const std::string& word, Diagnostics& diagnostics) {
  const auto below = std::lower_bound(curve.x.begin(), curve.x.end(), 0.0) - curve.x.begin();
  if (below == 0) return true;
  if (-curve.x.front() > back_share * curve.x.back()) {
    diagnostics.error({curve.file, curve.line.front(), 1}, curve.x_name,
                      fmt::format("{:g}", curve.x.front()),
                      fmt::format("the {} must not be below 0", word),
                      "subtract the value at which the load begins to rise");
    return false;
  }
  diagnostics.warning({curve.file, curve.line.front(), 1},
                      fmt::format("{} row{} with {} below 0, down to {:g}: left out", below,
                                  below == 1 ? "" : "s", word, curve.x.front()));
  curve.x.erase(curve.x.begin(), curve.x.begin() + below);
  curve.y.erase(curve.y.begin(), curve.y.begin() + below);
  curve.line.erase(curve.line.begin(), curve.line.begin() + below);
  return true;
}

bool check_signs(const Curve& curve, const std::string& word, Diagnostics& diagnostics) {
  const double most = *std::max_element(curve.y.begin(), curve.y.end());
  const auto least = std::min_element(curve.y.begin(), curve.y.end()) - curve.y.begin();
  const std::size_t row = static_cast<std::size_t>(least);
  if (most > 0.0 && curve.y[row] >= -noise_share * most) return true;
  const Place at{curve.file, curve.line[row], 1};
  if (most == 0.0 && curve.y[row] == 0.0) {
    diagnostics.error(at, curve.y_name, "0",
                      fmt::format("the {} is 0 in every row, it must rise", word),
                      "choose another column with --y-column");
    return false;
  }
  const bool turned = !(most > -curve.y[row]);
  diagnostics.error(
      at, curve.y_name, fmt::format("{:g}", curve.y[row]),
      fmt::format("the {} must not be below 0 by more than {:g} % of its largest value, "
                  "{:g}",
                  word, 100.0 * noise_share, most),
      turned ? "turn the sign of the column round, or choose another with --y-column"
             : "subtract the value that the load cell shows without load");
  return false;
}

} // namespace

std::optional<Curve> read_curve(const std::filesystem::path& file, const std::string& x_column,
                                const std::string& y_column, Diagnostics& diagnostics) {
  Curve curve;
  curve.file = file.string();
  const Place start{curve.file, 1, 1};
  std::string reason;
  const std::optional<std::string> text = read_text(file, reason);
  if (!text) {
    diagnostics.error(start, "", "", "the curve " + reason, "give the path of a CSV file");
    return std::nullopt;
  }
  if (text->find('\0') != std::string::npos) {
    diagnostics.error(start, "", "", "the file is no plain text in UTF-8",
                      "save the curve as CSV in UTF-8");
    return std::nullopt;
  }
  const std::vector<Row> rows = split_rows(*text);
  std::size_t first = 0;
  while (first < rows.size() && is_header(rows[first]))
    ++first;
  const auto x = chosen_column(x_column, "1", "--x-column", rows, first, diagnostics);
  const auto y = chosen_column(y_column, "2", "--y-column", rows, first, diagnostics);
  if (!x || !y) return std::nullopt;
  const std::vector<Field> header = first > 0 ? rows[0].fields : std::vector<Field>{};
  curve.x_name = name_of(header, *x);
  curve.y_name = name_of(header, *y);
  if (*x == *y) {
    diagnostics.error({"--y-column", 1, 1}, "y-column", y_column.empty() ? "2" : y_column,
                      "is the column of --x-column too", "give two different columns");
    return std::nullopt;
  }
  if (first == rows.size()) {
    diagnostics.error(start, "", "", "the file has no row of numbers",
                      "give a CSV file with two columns of numbers");
    return std::nullopt;
  }
  const std::size_t columns[2] = {*x, *y};
  if (!read_cells(rows, first, columns, curve, diagnostics)) return std::nullopt;
  return curve;
}

bool check_curve(Curve& curve, const std::string& x_word, const std::string& y_word,
                 Diagnostics& diagnostics) {
  return sort_rows(curve, x_word, diagnostics) && cut_below_zero(curve, x_word, diagnostics) &&
         check_signs(curve, y_word, diagnostics);
}

} // namespace plyform
