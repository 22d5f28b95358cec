// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/format.hpp"
#include "core/identify/fit_biaxial.hpp"

#include <algorithm>

namespace plyform {
namespace {

constexpr std::array<const char*, 2> direction_names{"warp", "weft"};

CurveColumns columns_of(const std::string& direction) {
  CurveColumns columns;
  columns.x_is = Quantity::strain;
  columns.x_word = direction + " strain";
  columns.y_word = direction + " load";
  columns.only = direction;
  return columns;
}

/// Which directions the columns are of; reports an error and returns nothing if a name has both, if
/// none has one, or if a direction has a strain without a load or a load without a strain.
std::optional<std::array<bool, 2>> directions_of(const CurveTable& table,
                                                 Diagnostics& diagnostics) {
  constexpr const char* remedy = "give the file a header with the names warp_strain, weft_strain, "
                                 "warp_load_N, weft_load_N; a direction that was free has neither "
                                 "strain nor load";
  std::array<std::vector<std::string>, 2> names;
  for (const std::string& name : table.names) {
    const std::array<bool, 2> is{has_word(name, direction_names[0]),
                                 has_word(name, direction_names[1])};
    if (is[0] && is[1]) {
      diagnostics.error({table.file, 1, 1}, name, "", "names both warp and weft", remedy);
      return std::nullopt;
    }
    for (std::size_t a = 0; a < 2; ++a)
      if (is[a]) names[a].push_back(name);
  }
  if (names[0].empty() && names[1].empty()) {
    diagnostics.error({table.file, 1, 1}, "", "",
                      "no column says that it is of warp or weft: a biaxial curve has the columns "
                      "warp strain, weft strain, warp load, weft load",
                      remedy);
    return std::nullopt;
  }
  for (std::size_t a = 0; a < 2; ++a)
    if (names[a].size() == 1) {
      diagnostics.error({table.file, 1, 1}, names[a].front(), "",
                        fmt::format("is the only column whose name says {0}, there must be {0} "
                                    "strain and {0} load",
                                    direction_names[a]),
                        remedy);
      return std::nullopt;
    }
  return std::array<bool, 2>{!names[0].empty(), !names[1].empty()};
}

/// Keeps the rows that both curves have; reports an error and returns false if there are none.
bool keep_common(std::array<Curve, 2>& curves, Diagnostics& diagnostics) {
  std::array<std::vector<std::size_t>, 2> kept; // lines ascend
  for (std::size_t i = 0, j = 0; i < curves[0].size() && j < curves[1].size();) {
    const int warp = curves[0].line[i], weft = curves[1].line[j];
    if (warp == weft) kept[0].push_back(i), kept[1].push_back(j);
    if (warp <= weft) ++i;
    if (weft <= warp) ++j;
  }
  if (kept[0].empty()) {
    diagnostics.error(place_of(curves[0]), "", "",
                      "no row has strain and load of both warp and weft", "fill the empty cells");
    return false;
  }
  for (std::size_t a = 0; a < 2; ++a)
    curves[a] = rows_of(curves[a], kept[a]);
  return true;
}

/// Reports loads that push.
bool pulls(const Curve& curve, double largest, Diagnostics& diagnostics) {
  const auto least = std::min_element(curve.y.begin(), curve.y.end());
  if (*least >= -noise_share * largest) return true;
  const auto row = static_cast<std::size_t>(least - curve.y.begin());
  diagnostics.error(place_of(curve, row), curve.y_name, written_y(curve, row),
                    "must not be below 0 by more than 2 % of the largest load",
                    "set the load cell to 0 without a specimen, or turn the sign of the column");
  return false;
}

} // namespace

std::optional<BiaxialCurve> read_biaxial(const std::string& file,
                                         const std::array<double, 2>& yarns,
                                         Diagnostics& diagnostics) {
  const auto table = read_curve_table(file, diagnostics);
  if (!table) return std::nullopt;
  const auto there = directions_of(*table, diagnostics);
  if (!there) return std::nullopt;
  std::array<Curve, 2> read;
  for (std::size_t a = 0; a < 2; ++a) {
    if (!(*there)[a]) continue;
    auto one = read_curve(file, columns_of(direction_names[a]), diagnostics);
    if (!one) return std::nullopt;
    read[a] = std::move(*one);
  }
  if ((*there)[0] && (*there)[1] && !keep_common(read, diagnostics)) return std::nullopt;
  BiaxialCurve curve;
  curve.file = file;
  curve.line = read[(*there)[0] ? 0 : 1].line;
  const std::size_t rows = curve.line.size(), all = table->rows.size();
  if (rows < all)
    diagnostics.warning({file, 1, 1},
                        fmt::format("{} of {} rows have an empty cell and are left out, {} count",
                                    all - rows, all, rows));
  double largest = 0.0;
  for (std::size_t a = 0; a < 2; ++a) {
    if (!(*there)[a]) read[a].x.assign(rows, 0.0), read[a].y.assign(rows, 0.0);
    curve.strain[a] = read[a].x;
    for (const double load : read[a].y) {
      curve.load[a].push_back(load / yarns[a]);
      largest = std::max(largest, curve.load[a].back());
    }
  }
  for (std::size_t a = 0; a < 2; ++a) {
    if ((*there)[a] && !pulls(read[a], largest * yarns[a], diagnostics)) return std::nullopt;
    const double most = *std::max_element(curve.load[a].begin(), curve.load[a].end());
    curve.free[a] = !(*there)[a] || most <= noise_share * largest;
  }
  return curve;
}

} // namespace plyform
