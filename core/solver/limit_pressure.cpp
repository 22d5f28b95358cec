// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solver/limit_pressure.hpp"

#include "base/format.hpp"
#include "base/node_normals.hpp"
#include "core/model/motion.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

constexpr double most_stretch = 100.0; // no rubber's: what has flown away counts as this

/// The largest root of the present area over that before forming of a triangle, as far as its
/// places are numbers.
double largest_stretch(const PlyBody& ply) {
  double most = 0.0;
  for (std::size_t t = 0; t < ply.membrane.triangles.size(); ++t) {
    const double area = triangle_area(ply.x, ply.membrane.triangles[t]);
    if (std::isfinite(area)) most = std::max(most, std::sqrt(area / ply.membrane.area[t]));
  }
  return std::min(most, most_stretch);
}

/// (P) but for 2 / R, N/mm.
double balloon(const MooneyRivlinLaw& law, double stretch) {
  return equibiaxial_load(law, stretch) / (stretch * stretch);
}

} // namespace

std::string beyond_limit_pressure(const Layup& layup, std::size_t p) {
  const PlyBody& ply = layup.plies[p];
  const double pressure = std::abs(pressure_on(layup.data, p, layup.time).value_or(0.0));
  if (!ply.membrane.fabric.sheet || !(pressure > 0.0)) return {};
  const auto* law = std::get_if<MooneyRivlinLaw>(&*ply.membrane.fabric.sheet);
  if (law == nullptr) return {};
  constexpr double step = 0.01;
  const double stretch = largest_stretch(ply);
  double limit = 1.0;
  while (limit < stretch && balloon(*law, limit + step) > balloon(*law, limit))
    limit += step;
  if (!(limit + step < stretch) || !(balloon(*law, stretch) < balloon(*law, stretch - step)))
    return {};
  return fmt::format(
      "{:.3g} N/mm2 is more than ply {} bears: beyond a stretch of {:.3g} all ways, the limit "
      "point "
      "of a blown-up sheet of its rubber, more stretch bears less pressure, so that no balance "
      "exists before it meets a tool; less pressure, a tool nearer to it, or thicker or stiffer "
      "rubber",
      pressure, ply.name, limit);
}

} // namespace plyform
