// SPDX-License-Identifier: GPL-3.0-or-later
// A measured curve (CSV), columns chosen by number and by name. Refused with errors, or rows of
// finite numbers.
#include "core/identify/curve_file.hpp"
#include "fuzz/fuzz_file.hpp"

#include <cmath>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace plyform;
  const auto file = fuzz::put("curve.csv", data, size);
  for (const auto& [x, y] : {std::pair("", ""), std::pair("2", "1"), std::pair("strain", "load")}) {
    Diagnostics diagnostics;
    CurveColumns columns;
    columns.x.column = x;
    columns.y.column = y;
    columns.with_angle = true;
    std::optional<Curve> curve = read_curve(file, columns, diagnostics);
    if (!curve || !check_rising(*curve, "displacement", diagnostics) ||
        !check_zeros(*curve, "displacement", "force", diagnostics)) {
      if (diagnostics.errors.empty()) std::abort();
      continue;
    }
    if (curve->x.empty() || curve->x.size() != curve->y.size()) std::abort();
    for (std::size_t i = 0; i < curve->size(); ++i)
      if (!std::isfinite(curve->x[i]) || !std::isfinite(curve->y[i])) std::abort();
  }
  return 0;
}
