// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/identify/fit_biaxial.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace plyform {
namespace {

constexpr std::array<const char*, 2> direction_names{"warp", "weft"};

CurveColumns columns_of(const std::string& direction) {
  CurveColumns columns;
  columns.x_is = Quantity::strain;
  columns.x_word = direction + " strain";
  columns.y_word = direction + " load";
  columns.x_preferred = columns.y_preferred = direction;
  return columns;
}

/// Reports loads that push.
bool pulls(const Curve& curve, double largest, Diagnostics& diagnostics) {
  const auto least = std::min_element(curve.y.begin(), curve.y.end());
  if (*least >= -noise_share * largest) return true;
  const auto row = static_cast<std::size_t>(least - curve.y.begin());
  diagnostics.error(place_of(curve, row), curve.y_name, fmt::format("{:g}", *least),
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
  BiaxialCurve curve;
  curve.file = file;
  std::array<Curve, 2> read;
  std::array<bool, 2> there{};
  for (std::size_t a = 0; a < 2; ++a)
    there[a] = std::any_of(table->names.begin(), table->names.end(), [a](const std::string& name) {
      return has_word(name, direction_names[a]);
    });
  if (!there[0] && !there[1]) {
    diagnostics.error({file, 1, 1}, "", "",
                      "no column says that it is of warp or weft: a biaxial curve has the columns "
                      "warp strain, weft strain, warp load, weft load",
                      "give the file a header with these names; a direction that was free may "
                      "miss");
    return std::nullopt;
  }
  for (std::size_t a = 0; a < 2; ++a) {
    if (!there[a]) continue;
    auto one = read_curve(file, columns_of(direction_names[a]), diagnostics);
    if (!one) return std::nullopt;
    read[a] = std::move(*one);
  }
  const std::size_t rows = read[there[0] ? 0 : 1].size();
  curve.line = read[there[0] ? 0 : 1].line;
  double largest = 0.0;
  for (std::size_t a = 0; a < 2; ++a) {
    if (!there[a]) read[a].x.assign(rows, 0.0), read[a].y.assign(rows, 0.0);
    curve.strain[a] = read[a].x;
    for (const double load : read[a].y) {
      curve.load[a].push_back(load / yarns[a]);
      largest = std::max(largest, curve.load[a].back());
    }
  }
  for (std::size_t a = 0; a < 2; ++a) {
    if (there[a] && !pulls(read[a], largest * yarns[a], diagnostics)) return std::nullopt;
    const double most = *std::max_element(curve.load[a].begin(), curve.load[a].end());
    curve.free[a] = !there[a] || most <= noise_share * largest;
  }
  return curve;
}

} // namespace plyform
