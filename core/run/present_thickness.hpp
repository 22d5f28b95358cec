// SPDX-License-Identifier: GPL-3.0-or-later
// Thickness of plies that give way through it, as their contacts leave it.
//
//   (1) each half of a ply reaches from its mid-surface to what it touches: the tool; of two plies,
//       each has its share of h (contact/forces/ply_ply.hpp) less (3), in the mean over the nodes
//       of either that are near; where it touches nothing, half its thickness before forming times
//       r (core/ply/thickness.hpp)
//   (2) V = rho_A A0 / (rho_f A t), fibre volume fraction of a triangle
//   (3) what two plies lose together, h - d / r, is split so that both halves bear one pressure, by
//       the curve of each, loading or unloading; beyond the densest packing of one the other gives
//       way up to its own, and beyond both they share the rest by their thickness
#pragma once

#include "core/solver/scene.hpp"

#include <vector>

namespace plyform {

/// (1), mm, per node. Empty: its fabric has no compaction.
std::vector<double> thickness_between(const Scene& scene, int ply);

/// (1), mm, and (2) of the triangles of a ply, from the ratios A / A0 of their areas. thickness is
/// left as it is, and fibre_volume empty, where the fabric does not have what it needs.
void add_present_thickness(const Scene& scene, int ply, const std::vector<double>& area_ratios,
                           std::vector<double>& thickness, std::vector<double>& fibre_volume);

} // namespace plyform
