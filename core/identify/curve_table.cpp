// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/identify/curve_table.hpp"

#include "base/format.hpp"
#include "base/text.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>

namespace plyform {
namespace {

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
std::vector<CurveField> split(std::string_view line, char separator) {
  std::vector<CurveField> fields;
  std::size_t at = 0, counted = 0;
  int column = 1; // of the character at `counted`
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
    std::size_t first = start; // without blanks before it
    while (first < at && line[first] == ' ')
      ++first;
    column += characters(line.substr(counted, first - counted));
    counted = first;
    fields.push_back({trimmed(text), column});
    if (at >= line.size()) return fields;
    ++at;
  }
}

/// The separator in a line, or nothing: lines about the machine may stand above the names.
std::optional<char> separator_in(std::string_view line) {
  for (const char candidate : {'\t', ';', ','})
    if (line.find(candidate) != std::string_view::npos) return candidate;
  return std::nullopt;
}

std::vector<CurveRow> split_rows(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3); // byte-order mark of spreadsheets
  std::vector<CurveRow> rows;
  std::optional<char> separator;
  for (int line = 1; !text.empty(); ++line) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view content = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (content.ends_with('\r')) content.remove_suffix(1);
    const std::string bare = trimmed(content);
    if (bare.empty() || bare[0] == '#') continue;
    if (!separator) separator = separator_in(bare);
    rows.push_back({line, split(content, separator.value_or(','))});
  }
  return rows;
}

/// Whether a row is a header: it has no number and no field that starts like one ("1,5" is an
/// error).
bool is_header(const CurveRow& row) {
  const bool number =
      std::any_of(row.fields.begin(), row.fields.end(),
                  [](const CurveField& field) { return number_in(field.text).has_value(); });
  return !number && std::any_of(row.fields.begin(), row.fields.end(), [](const CurveField& field) {
    return !field.text.empty() &&
           std::string("0123456789.+-").find(field.text[0]) == std::string::npos;
  });
}

/// Whether a row below the names has their units: a unit that is known or stands in brackets, or
/// nothing but single words that may be units.
bool is_row_of_units(const CurveRow& row) {
  bool all = true;
  for (const CurveField& field : row.fields) {
    if (field.text.empty()) continue;
    const bool may_be = may_be_unit(field.text);
    if (may_be &&
        (find_unit(field.text) || !std::isalpha(static_cast<unsigned char>(field.text[0]))))
      return true;
    all = all && may_be;
  }
  return all;
}

/// Names and units from the header rows, which are removed.
void take_header(CurveTable& table) {
  std::size_t count = 0;
  while (count < table.rows.size() && is_header(table.rows[count]))
    ++count;
  if (count == 0) return;
  // a machine may write lines about itself above the names
  std::size_t names = 0;
  if (count < table.rows.size()) {
    const std::size_t width = table.rows[count].fields.size();
    while (names + 1 < count && table.rows[names].fields.size() != width)
      ++names;
    if (table.rows[names].fields.size() != width) names = 0;
  }
  table.header_line = table.rows[names].line;
  const std::vector<CurveField>& fields = table.rows[names].fields;
  const bool units = names + 1 < count && is_row_of_units(table.rows[names + 1]);
  for (std::size_t i = 0; i < fields.size(); ++i) {
    std::string below;
    if (units && i < table.rows[names + 1].fields.size())
      below = table.rows[names + 1].fields[i].text;
    table.names.push_back(fields[i].text);
    table.meanings.push_back(meaning_of(fields[i].text, below));
  }
  table.rows.erase(table.rows.begin(), table.rows.begin() + static_cast<std::ptrdiff_t>(count));
}

} // namespace

std::size_t CurveTable::width() const {
  return rows.empty() ? names.size() : rows.front().fields.size();
}

std::string CurveTable::name_of(std::size_t i) const {
  return i < names.size() && !names[i].empty() ? names[i] : fmt::format("column {}", i + 1);
}

ColumnMeaning CurveTable::meaning(std::size_t i) const {
  return i < meanings.size() ? meanings[i] : ColumnMeaning{};
}

std::optional<CurveTable> read_curve_table(const std::filesystem::path& file,
                                           Diagnostics& diagnostics) {
  CurveTable table;
  table.file = file.string();
  const Place start{table.file, 1, 1};
  std::string reason;
  const std::optional<std::string> text = read_file(file, most_curve_bytes, reason);
  if (!text) {
    diagnostics.error(start, "", "", "the curve " + reason, "give the path of a CSV file");
    return std::nullopt;
  }
  if (text->find('\0') != std::string::npos) {
    diagnostics.error(start, "", "", "the file is no plain text in UTF-8",
                      "save the curve as CSV in UTF-8");
    return std::nullopt;
  }
  table.rows = split_rows(*text);
  take_header(table);
  if (!table.rows.empty()) return table;
  diagnostics.error(start, "", "", "the file has no row of numbers",
                    "give a CSV file with columns of numbers");
  return std::nullopt;
}

} // namespace plyform
