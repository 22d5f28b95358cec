// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/model/compaction.hpp"

#include <cmath>

namespace plyform {

ThicknessCurve toll_manson(double scale, double exponent, double densest, double weight,
                           double t0) {
  constexpr int pieces = 200;
  ThicknessCurve curve;
  const double from = weight / t0, end = weight / densest;
  for (int i = 0; i <= pieces; ++i) {
    const double t = t0 + (end - t0) * i / pieces;
    curve.thickness.push_back(t);
    curve.pressure.push_back(
        i == 0 ? 0.0 : scale * (std::pow(weight / t, exponent) - std::pow(from, exponent)));
  }
  return curve;
}

} // namespace plyform
