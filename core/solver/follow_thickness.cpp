// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solver/follow_thickness.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {

void note_thickness(Layup& layup) {
  layup.thickest = layup.thinnest = 1.0;
  for (const PlyBody& ply : layup.plies)
    for (const double r : ply.thickness_ratio)
      layup.thickest = std::max(layup.thickest, r), layup.thinnest = std::min(layup.thinnest, r);
}

double reach_of(const Layup& layup, double distance) {
  return layup.thickest * distance + layup.skin;
}

double least_distance(const Layup& layup, const PlyPlyContact& contact) {
  return layup.thinnest * (contact.distance - contact.law.depth_limit());
}

void update_thickness(Layup& layup, ThreadPool& pool) {
  if (!layup.any_thickness_acts) return;
  pool.run(static_cast<int>(layup.plies.size()), [&layup](int p) {
    PlyBody& ply = layup.plies[at(p)];
    ply.thickening = 0.0;
    if (ply.resting || !ply.thickness_acts) return;
    std::swap(ply.thickness_ratio, ply.last_ratio);
    thickness_ratios(ply.thickness_law, ply.membrane, ply.x, ply.thickness_ratio);
    double change = 0.0;
    for (std::size_t n = 0; n < ply.last_ratio.size(); ++n)
      change = std::max(change, std::abs(ply.thickness_ratio[n] - ply.last_ratio[n]));
    ply.thickening = 0.5 * ply.thickness * change;
  });
}

} // namespace plyform
