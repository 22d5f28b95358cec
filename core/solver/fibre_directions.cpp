// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solver/fibre_directions.hpp"

#include <algorithm>

namespace plyform {
namespace {

void note_fibres(PlyBody& ply) {
  const Membrane& m = ply.membrane;
  if (m.fabric.families.empty()) return;
  const Vec2 along = m.families[0].along;
  ply.fibres.assign(ply.x.size(), Vec3::Zero());
  for (std::size_t e = 0; e < m.triangles.size(); ++e) {
    const Triangle& t = m.triangles[e];
    const AxesState axes = axes_state(m, ply.x, static_cast<int>(e));
    const Vec3 image = m.area[e] * (along.x() * axes.k1() + along.y() * axes.k2());
    for (const std::int32_t n : t)
      ply.fibres[at(n)] += image;
  }
}

} // namespace

void note_fibres(Layup& layup, ThreadPool& pool) {
  const auto asks = [](const FrictionLawPtr& law) { return !law->spec().over_angle.empty(); };
  if (std::none_of(layup.data.friction_laws.begin(), layup.data.friction_laws.end(), asks)) return;
  pool.run(static_cast<int>(layup.plies.size()), [&](int p) { note_fibres(layup.plies[at(p)]); });
}

} // namespace plyform
