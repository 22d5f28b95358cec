// SPDX-License-Identifier: GPL-3.0-or-later
// A weave that gives way through its thickness by a closed form, and flat stacks of it.
#pragma once

#include "support/scene_checks.hpp"

#include <cmath>

namespace plyform {

constexpr double packing_side = 60.0;                                         // mm, of the plies
constexpr double packing_weight = 600e-12 / 2.55e-9;                          // mm of fibre
constexpr double packing_free = 0.6, packing_densest = packing_weight / 0.62; // mm

/// A weave that packs from 0.6 mm by Toll and Manson's law to a fibre volume of 0.62.
inline Fabric packing_weave(double scale = 20.0, double exponent = 8.0) {
  Fabric fabric = glass_weave();
  fabric.thickness = packing_free;
  fabric.surface_density = 600e-12;
  fabric.fibre_density = 2.55e-9;
  stiffen_yarns(fabric);
  fabric.compaction =
      Compaction{toll_manson(scale, exponent, 0.62, packing_weight, packing_free), {}, 0.0};
  return fabric;
}

/// N/mm^2, of an unsheared ply of this thickness (mm).
inline double pressure_at(double thickness, double scale = 20.0, double exponent = 8.0) {
  return scale * (std::pow(packing_weight / thickness, exponent) -
                  std::pow(packing_weight / packing_free, exponent));
}

/// mm, of an unsheared ply under this pressure (N/mm^2).
inline double thickness_at(double pressure, double scale = 20.0, double exponent = 8.0) {
  const double free = std::pow(packing_weight / packing_free, exponent);
  return packing_weight / std::pow(pressure / scale + free, 1.0 / exponent);
}

/// Plies of these fabrics on a floor, under a box that comes down to leave `gap` (mm).
inline Case between_plates(const std::vector<Fabric>& fabrics, double gap, double element = 6.0) {
  Case data = stack_of(std::vector<double>(fabrics.size(), 0.0),
                       rectangle(packing_side, packing_side, element));
  data.fabrics = fabrics;
  double top = 0.0;
  for (std::size_t p = 0; p < fabrics.size(); ++p) {
    data.plies[p].fabric = static_cast<int>(p);
    data.plies[p].z = top + 0.5 * fabrics[p].thickness;
    top += fabrics[p].thickness;
  }
  Tool floor;
  floor.name = "floor";
  floor.shape = Box{{200.0, 200.0, 10.0}};
  floor.position = {0.0, 0.0, -5.0};
  Tool press = floor;
  press.name = "press";
  press.position = {0.0, 0.0, top + 5.0};
  press.direction = {0.0, 0.0, -1.0};
  press.motion = Motion::driven;
  press.stroke = top - gap;
  data.tools = {floor, press};
  set_friction(data, 0.2);
  data.solver.duration = 0.02;
  return data;
}

} // namespace plyform
