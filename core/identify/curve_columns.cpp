// SPDX-License-Identifier: GPL-3.0-or-later
// Which column of a table a test needs: curve_table.hpp.
#include "base/format.hpp"
#include "base/text.hpp"
#include "core/identify/curve_table.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

using Chosen = std::vector<std::optional<ChosenColumn>>;

std::string item_of(const std::string& option) {
  return option.substr(option.find_first_not_of('-'));
}

/// "d (length, mm), F (of unknown kind)".
std::string description(const CurveTable& table, const std::vector<std::size_t>& columns) {
  std::vector<std::string> texts;
  for (const std::size_t i : columns) {
    const ColumnMeaning meaning = table.meaning(i);
    const std::string unit =
        meaning.unknown_unit.empty() ? meaning.unit : meaning.unknown_unit + ", which is not known";
    texts.push_back(fmt::format("{} ({}{}{})", table.name_of(i), quantity_name(meaning.quantity),
                                unit.empty() ? "" : ", ", unit));
  }
  return joined(texts);
}

std::vector<std::size_t> all_columns(const CurveTable& table) {
  std::vector<std::size_t> all(table.width());
  for (std::size_t i = 0; i < all.size(); ++i)
    all[i] = i;
  return all;
}

/// "a length" or "an angle".
std::string a_quantity(Quantity quantity) {
  const std::string name = quantity_name(quantity);
  if (quantity == Quantity::other) return name;
  return (name[0] == 'a' ? "an " : "a ") + name;
}

void column_error(const ColumnRequest& request, const std::string& rule, const std::string& remedy,
                  Diagnostics& diagnostics) {
  diagnostics.error({request.option, 1, 1}, item_of(request.option), request.chosen.column, rule,
                    remedy);
}

/// Index (from 0) of the column that the user names; reports an error and returns nothing if there
/// is none.
std::optional<std::size_t> named_column(const CurveTable& table, const ColumnRequest& request,
                                        Diagnostics& diagnostics) {
  const std::string& wanted = request.chosen.column;
  const auto count = std::count(table.names.begin(), table.names.end(), wanted);
  if (count > 1) {
    column_error(request, fmt::format("stands {} times in the header", count),
                 "give the number of the column, from 1", diagnostics);
    return std::nullopt;
  }
  if (count == 1)
    return static_cast<std::size_t>(std::find(table.names.begin(), table.names.end(), wanted) -
                                    table.names.begin());
  if (const auto number = number_in(wanted)) {
    const bool whole = *number >= 1.0 && *number <= 10000.0 && *number == std::floor(*number);
    if (whole && *number <= static_cast<double>(table.width()))
      return static_cast<std::size_t>(*number) - 1;
    if (whole)
      column_error(
          request,
          fmt::format("the rows have {} column{}", table.width(), table.width() == 1 ? "" : "s"),
          "give another column, or separate columns by comma, semicolon or tab", diagnostics);
    else
      column_error(request, "must be a whole number from 1",
                   "give the number or the name of a column", diagnostics);
  } else if (table.names.empty()) {
    column_error(request, "names a column, but the file has no header row",
                 "give the number of the column, from 1", diagnostics);
  } else {
    const std::string nearest = nearest_word(wanted, table.names);
    column_error(request, "is no column of the header",
                 nearest.empty() ? "it has " + joined(table.names)
                                 : fmt::format("did you mean {}?", nearest),
                 diagnostics);
  }
  return std::nullopt;
}

/// Columns of a quantity whose names have one of the words `only`, if there are any words.
std::vector<std::size_t> of_quantity(const CurveTable& table, Quantity quantity,
                                     const std::string& only) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < table.width(); ++i)
    if (table.meaning(i).quantity == quantity && (only.empty() || has_word(table.name_of(i), only)))
      found.push_back(i);
  return found;
}

bool fits(const ColumnRequest& request, Quantity quantity) {
  return quantity == request.quantity || quantity == request.also;
}

/// Whether a force per length is refused for a reason of its own, which is then reported.
bool is_refused(const ColumnRequest& request, Quantity quantity, const Place& at,
                const std::string& item, const std::string& value, Diagnostics& diagnostics) {
  if (request.no_per_length.empty() || quantity != Quantity::force_per_length) return false;
  diagnostics.error(at, item, value,
                    fmt::format("is a force per length, the {} must be {}: {}", request.word,
                                a_quantity(request.quantity), request.no_per_length),
                    "take the load as measured, in N");
  return true;
}

/// Reports an error and returns true if the words of the header say that the column is another
/// measure than the test takes.
bool is_other_measure(const CurveTable& table, const ColumnRequest& request,
                      const ChosenColumn& chosen, Diagnostics& diagnostics) {
  const std::string name = table.name_of(chosen.index);
  const auto other = other_measure(name, chosen.quantity, request.wanted);
  if (!other) return false;
  diagnostics.error({table.file, table.header_line, 1}, name, "",
                    fmt::format("is {} by its name, and that is not the {} that the test takes",
                                other->is, request.word),
                    other->remedy);
  return true;
}

/// "give one of mm, cm ..."; of a name that stands for several units why.
std::string unit_remedy(const ColumnRequest& request, const std::string& unit) {
  std::string known = units_of(request.quantity);
  if (request.also) known += ", " + units_of(*request.also);
  const std::string doubt = ambiguous_unit(unit);
  return fmt::format("{}give one of {}", doubt.empty() ? "" : doubt + "; ", known);
}

/// Reports a unit in the header that is not known.
void report_unknown_unit(const CurveTable& table, const ColumnRequest& request, std::size_t column,
                         Diagnostics& diagnostics) {
  const std::string& unit = table.meaning(column).unknown_unit;
  diagnostics.error({table.file, table.header_line, 1}, table.name_of(column), unit,
                    fmt::format("is no unit of {} that is known", a_quantity(request.quantity)),
                    unit_remedy(request, unit) +
                        (request.only.empty()
                             ? fmt::format(", in the header or with {}; so too if {} is no unit",
                                           request.unit_option, unit)
                             : ", in the header"));
}

/// The column with its factor by the unit that the user gives, or by its header; reports an error
/// and returns nothing if that is of another quantity, or not known.
std::optional<ChosenColumn> factor_of(const CurveTable& table, const ColumnRequest& request,
                                      std::size_t column, Diagnostics& diagnostics) {
  const ColumnMeaning meaning = table.meaning(column);
  if (!request.chosen.unit.empty()) {
    const auto unit = find_unit(request.chosen.unit);
    if (unit && fits(request, unit->quantity))
      return ChosenColumn{column, unit->factor, unit->quantity, request.chosen.unit};
    const Place option{request.unit_option, 1, 1};
    const std::string item = item_of(request.unit_option), &given = request.chosen.unit;
    if (!unit || !is_refused(request, unit->quantity, option, item, given, diagnostics))
      diagnostics.error(option, item, given,
                        fmt::format("is no unit of {}", a_quantity(request.quantity)),
                        unit_remedy(request, given));
    return std::nullopt;
  }
  const bool fitting = fits(request, meaning.quantity);
  if (!meaning.unknown_unit.empty() && (fitting || meaning.quantity == Quantity::unknown)) {
    report_unknown_unit(table, request, column, diagnostics);
    return std::nullopt;
  }
  if (fitting)
    return ChosenColumn{column, meaning.factor, meaning.quantity,
                        meaning.unit.empty() ? usual_unit(meaning.quantity) : meaning.unit};
  if (meaning.quantity == Quantity::unknown)
    return ChosenColumn{column, usual_factor(request.quantity), request.quantity,
                        usual_unit(request.quantity)};
  if (is_refused(request, meaning.quantity, {table.file, 1, 1}, table.name_of(column), meaning.unit,
                 diagnostics))
    return std::nullopt;
  const std::vector<std::size_t> better = of_quantity(table, request.quantity, request.only);
  std::string remedy = request.hint;
  if (remedy.empty())
    remedy = better.empty()
                 ? fmt::format("give the unit with {} if the header is wrong", request.unit_option)
                 : fmt::format("take {} {}", request.option, table.name_of(better.front()));
  diagnostics.error({table.file, 1, 1}, table.name_of(column), meaning.unit,
                    fmt::format("is {}, the {} must be {}", a_quantity(meaning.quantity),
                                request.word, a_quantity(request.quantity)),
                    remedy);
  return std::nullopt;
}

/// Likewise, unless the column is another measure by its name.
std::optional<ChosenColumn> with_factor(const CurveTable& table, const ColumnRequest& request,
                                        std::size_t column, Diagnostics& diagnostics) {
  auto chosen = factor_of(table, request, column, diagnostics);
  if (chosen && is_other_measure(table, request, *chosen, diagnostics)) return std::nullopt;
  return chosen;
}

/// Of several columns of a quantity those that are the measure which the test takes, if any is.
std::vector<std::size_t> of_that_measure(const CurveTable& table, const ColumnRequest& request,
                                         std::vector<std::size_t> columns) {
  std::vector<std::size_t> fitting;
  for (const std::size_t i : columns)
    if (!other_measure(table.name_of(i), table.meaning(i).quantity, request.wanted))
      fitting.push_back(i);
  return fitting.empty() ? columns : fitting;
}

/// The one column of the quantity; nothing if there is none, or an error if there are several.
std::optional<std::size_t> column_by_header(const CurveTable& table, const ColumnRequest& request,
                                            Diagnostics& diagnostics) {
  std::vector<std::size_t> all = of_quantity(table, request.quantity, request.only);
  if (all.empty() && request.also) all = of_quantity(table, *request.also, request.only);
  all = of_that_measure(table, request, std::move(all));
  if (all.size() == 1) return all.front();
  if (all.empty()) return std::nullopt;
  std::vector<std::size_t> preferred;
  for (const std::size_t i : all)
    if (has_word(table.name_of(i), request.preferred)) preferred.push_back(i);
  if (preferred.size() == 1) return preferred.front();
  diagnostics.error({table.file, 1, 1}, "", "",
                    fmt::format("{} columns may be the {}: {}", all.size(), request.word,
                                description(table, all)),
                    request.only.empty() ? fmt::format("name one with {}", request.option)
                                         : "take the others out");
  return std::nullopt;
}

/// Columns of unknown kind that no request has; names as the requests want them, which are alike in
/// that.
std::vector<std::size_t> unknown_left(const CurveTable& table,
                                      const std::vector<ColumnRequest>& requests,
                                      const Chosen& chosen) {
  std::vector<std::size_t> left;
  for (const std::size_t i : of_quantity(table, Quantity::unknown, requests.front().only))
    if (std::none_of(chosen.begin(), chosen.end(),
                     [i](const auto& column) { return column && column->index == i; }))
      left.push_back(i);
  return left;
}

/// Takes a request that an angle does for out of the open ones where there is an angle, unless all
/// have their places from left to right.
void leave_to_angle(const CurveTable& table, const std::vector<ColumnRequest>& requests,
                    const Chosen& chosen, std::vector<std::size_t>& open) {
  const bool angle = std::any_of(chosen.begin(), chosen.end(), [](const auto& column) {
    return column && column->quantity == Quantity::angle;
  });
  if (!angle || (open.size() > 1 && unknown_left(table, requests, chosen).size() == open.size()))
    return;
  std::erase_if(open, [&requests](std::size_t n) { return requests[n].angle_does; });
}

/// Columns of unknown kind for the requests that are still open, from left to right, if they are as
/// many as these; else an error.
bool fill_from_left(const CurveTable& table, const std::vector<ColumnRequest>& requests,
                    const std::vector<std::size_t>& open, Chosen& chosen,
                    Diagnostics& diagnostics) {
  const std::vector<std::size_t> left = unknown_left(table, requests, chosen);
  for (std::size_t n = 0; n < open.size(); ++n) {
    const ColumnRequest& request = requests[open[n]];
    if (left.size() == open.size()) {
      chosen[open[n]] = with_factor(table, request, left[n], diagnostics);
      if (!chosen[open[n]]) return false;
      continue;
    }
    if (table.width() < requests.size() && table.names.empty() && table.width() == 1) {
      diagnostics.error({table.file, table.rows.front().line, 1}, "", "",
                        fmt::format("the row has 1 column, there must be at least {}", open.size()),
                        "separate columns by comma, semicolon or tab, and give every row all of "
                        "them");
      return false;
    }
    const auto per_length = of_quantity(table, Quantity::force_per_length, request.only);
    if (!per_length.empty() && is_refused(request, Quantity::force_per_length, {table.file, 1, 1},
                                          table.name_of(per_length.front()),
                                          table.meaning(per_length.front()).unit, diagnostics))
      return false;
    std::string remedy = fmt::format("name it with {}, and its unit with {}, if it is there",
                                     request.option, request.unit_option);
    if (!request.only.empty())
      remedy = fmt::format("name it in the header, with {} and its unit", request.only);
    if (!request.hint.empty()) remedy += "; " + request.hint;
    diagnostics.error({table.file, 1, 1}, "", "",
                      fmt::format("no column says by header or unit that it is the {}, {}: the "
                                  "columns are {}",
                                  request.word, a_quantity(request.quantity),
                                  description(table, all_columns(table))),
                      remedy);
    return false;
  }
  return true;
}

/// Whether just one column may be an optional one; nor is it read where the column is another
/// measure and what it may stand for is there.
bool is_clear(const CurveTable& table, const ColumnRequest& request, const ColumnRequest& instead) {
  const auto found =
      of_that_measure(table, request, of_quantity(table, request.quantity, request.only));
  if (found.size() != 1) return false;
  return of_quantity(table, instead.quantity, instead.only).empty() ||
         !other_measure(table.name_of(found.front()), request.quantity, request.wanted);
}

/// Reports columns that two requests have in common.
bool all_different(const CurveTable& table, const std::vector<ColumnRequest>& requests,
                   const Chosen& chosen, Diagnostics& diagnostics) {
  for (std::size_t a = 0; a < chosen.size(); ++a)
    for (std::size_t b = a + 1; b < chosen.size(); ++b) {
      if (!chosen[a] || !chosen[b] || chosen[a]->index != chosen[b]->index) continue;
      const ColumnRequest& request = requests[requests[b].chosen.column.empty() ? a : b];
      const ColumnRequest& other = requests[requests[b].chosen.column.empty() ? b : a];
      diagnostics.error(
          {request.option, 1, 1}, item_of(request.option), table.name_of(chosen[a]->index),
          fmt::format("is the column of {} too", other.option), "give two different columns");
      return false;
    }
  return true;
}

} // namespace

std::optional<Chosen> choose_columns(const CurveTable& table,
                                     const std::vector<ColumnRequest>& requests,
                                     Diagnostics& diagnostics) {
  Chosen chosen(requests.size());
  std::vector<std::size_t> open;
  const std::size_t errors = diagnostics.errors.size();
  for (std::size_t n = 0; n < requests.size(); ++n) {
    const ColumnRequest& request = requests[n];
    const bool named = !request.chosen.column.empty();
    if (!named && request.optional && !is_clear(table, request, requests.front())) continue;
    const std::size_t before = diagnostics.errors.size();
    const auto column = named ? named_column(table, request, diagnostics)
                              : column_by_header(table, request, diagnostics);
    if (column) {
      chosen[n] = with_factor(table, request, *column, diagnostics);
    } else if (diagnostics.errors.size() == before) {
      open.push_back(n);
    }
  }
  if (diagnostics.errors.size() > errors) return std::nullopt;
  leave_to_angle(table, requests, chosen, open);
  if (!fill_from_left(table, requests, open, chosen, diagnostics) ||
      !all_different(table, requests, chosen, diagnostics))
    return std::nullopt;
  return chosen;
}

} // namespace plyform
