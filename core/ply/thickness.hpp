// SPDX-License-Identifier: GPL-3.0-or-later
// Present thickness of plies over that before forming, by node. Yarns do not get thinner when cloth
// is sheared, they come closer: sheared by gamma, those that began at right angles cover cos gamma
// of their area and are 1 / cos gamma as thick. k_i and omega: core/ply/membrane.hpp.
//
//   r_e = sin omega0 |k_1| |k_2| / |k_1 x k_2|  in a triangle                               (V)
//   r_n = sum of A0 r_e over the triangles of a node, over the sum of A0
//
// That is A0 / A for yarns as long as they were. What yarns are longer or shorter counts for
// nothing in it: else cloth pressed between tools would widen along its yarns, and soft ones in
// plies that are not modelled as stiff as they are would make it thinner. A sheet without yarns
// keeps its volume: A0 / A. Where yarns of one direction part, gaps open between them and the cloth
// stays as thick as it was: r_n of at least 1, and A0 |k_1| / A where they come closer.
#pragma once

#include "core/model/fabric.hpp"
#include "core/ply/membrane.hpp"

#include <array>
#include <span>
#include <vector>

namespace plyform {

/// Bounds of r_n: where a triangle has collapsed or torn, its area tells nothing of the cloth.
constexpr double thinnest_ratio = 0.05, thickest_ratio = 4.0;

/// What of (V) a fabric has.
struct ThicknessLaw {
  std::array<bool, 2> yarns{}; ///< whether |k_i| counts
  double least = thinnest_ratio;
};
ThicknessLaw thickness_law(const Fabric& fabric);

/// (V) of one triangle and its derivatives by the edges B and C from its first corner to the
/// others.
struct ElementThickness {
  double ratio;
  Vec3 by_b, by_c; ///< 1/mm
};
ElementThickness element_thickness(const ThicknessLaw& law, const Membrane& m,
                                   std::span<const Vec3> x, std::size_t triangle);

/// r_n of each node. x: positions, mm.
void thickness_ratios(const ThicknessLaw& law, const Membrane& m, std::span<const Vec3> x,
                      std::vector<double>& ratio);

} // namespace plyform
