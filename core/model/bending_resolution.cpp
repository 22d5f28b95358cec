// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/model/bending_resolution.hpp"

#include "core/model/fabric_estimates.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plyform {
namespace {

constexpr double pressed_with = 0.2;   // N/mm
constexpr double excess_length = 0.01; // eps

void keep_least(std::optional<double>& least, double value) {
  least = least ? std::min(*least, value) : value;
}

} // namespace

BendingLengths bending_lengths(const Fabric& f, double pressure) {
  BendingLengths lengths;
  if (!f.has_yarns()) return lengths;
  const double rigidity = shear_rigidity(f);
  for (const YarnFamily& yarn : f.families) {
    const double in_plane = yarn.in_plane_bending, bending = yarn.bending.at(0.0).slope;
    if (in_plane > 0.0 && rigidity > 0.0) keep_least(lengths.layer, std::sqrt(in_plane / rigidity));
    if (yarn.tension.compression == 0.0) continue;
    const double force = std::min(pressed_with, yarn.density * yarn.tension.buckling_force);
    if (force > rigidity)
      keep_least(lengths.sideways, 2.0 * M_PI * std::sqrt(2.0 * in_plane / (force - rigidity)));
    if (bending > 0.0 && pressure > 0.0)
      keep_least(lengths.upwards,
                 2.0 * M_PI * std::cbrt(0.5 * bending * std::sqrt(excess_length) / pressure));
  }
  return lengths;
}

double element_size_needed(const BendingLengths& lengths) {
  double needed = std::numeric_limits<double>::infinity();
  if (lengths.layer) needed = std::min(needed, *lengths.layer / elements_in_layer);
  if (lengths.sideways) needed = std::min(needed, *lengths.sideways / elements_in_wave);
  return needed;
}

} // namespace plyform
