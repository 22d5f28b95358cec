// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solver/displacements.hpp"

#include "core/solver/pass_through.hpp"

#include <cmath>

namespace plyform {

bool track_displacements(Layup& layup, std::vector<ToolState>& tools) {
  // Between searches the maxima never decrease, also if a body moves back.
  const auto grow = [](double& max_displacement, double now) {
    if (!(now <= max_displacement) && !std::isnan(max_displacement))
      max_displacement = now; // NaN stays
  };
  for (std::size_t i = 0; i < layup.node_blocks.size(); ++i)
    grow(layup.plies[layup.node_blocks[i].ply].max_displacement,
         std::sqrt(layup.node_sums[i].moved2));
  for (std::size_t p = 0; p < layup.plies.size(); ++p) {
    PlyBody& ply = layup.plies[p];
    ply.path_length += step_displacement(layup, static_cast<int>(p)) + ply.thickening;
    ply.thickening_path += ply.thickening;
  }
  for (ToolState& t : tools) {
    // A pushed tool moves later in this step, when its forces are computed.
    const double ahead = t.body.force_controlled ? t.body.max_approach_speed * layup.dt : 0.0;
    t.path_length += t.body.motion.norm();
    if (t.far) continue;
    grow(t.max_displacement, (t.body.displacement - t.displacement_search).norm() + ahead);
  }
  return largest_displacement(layup, tools) <= 0.5 * (layup.skin - layup.sliding_gap);
}

double path_length_ahead(const ToolState& t, double dt) {
  return t.path_length + (t.body.force_controlled ? t.body.max_approach_speed * dt : 0.0);
}

double largest_displacement(const Layup& layup, const std::vector<ToolState>& tools) {
  double furthest = 0.0;
  const auto grow = [&furthest](double max_displacement) {
    if (!(max_displacement <= furthest) && !std::isnan(furthest))
      furthest = max_displacement; // NaN stays
  };
  for (const PlyBody& ply : layup.plies)
    grow(ply.max_displacement + ply.thickening_path);
  for (const ToolState& t : tools)
    grow(t.max_displacement);
  return furthest;
}

} // namespace plyform
