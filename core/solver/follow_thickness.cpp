// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solver/follow_thickness.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {

void note_thickness(Scene& s) {
  s.thickest = s.thinnest = 1.0;
  for (const PlyBody& ply : s.plies)
    for (const double r : ply.thickness_ratio)
      s.thickest = std::max(s.thickest, r), s.thinnest = std::min(s.thinnest, r);
}

double reach_of(const Scene& s, double distance) {
  return s.thickest * distance + s.skin;
}

double least_distance(const Scene& s, const PlyPlyContact& contact) {
  return s.thinnest * (contact.distance - contact.law.depth_limit());
}

void update_thickness(Scene& s, ThreadPool& pool) {
  if (!s.any_thickness_acts) return;
  pool.run(static_cast<int>(s.plies.size()), [&s](int p) {
    PlyBody& ply = s.plies[at(p)];
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
