// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solver/whole_step.hpp"

#include "core/solver/nodal_forces.hpp"

namespace plyform {

VelocitiesAtPositions::VelocitiesAtPositions(Scene& scene)
    : scene_(scene), plies_(scene.plies.size()) {
  const MassLoads loads = mass_loads(scene.data);
  for (std::size_t p = 0; p < plies_.size(); ++p) {
    PlyBody& ply = scene.plies[p];
    OfPly& of = plies_[p];
    of.behind = ply.velocity;
    of.half.assign(ply.x.size(), Vec3::Zero());
    for (std::size_t n = 0; n < ply.x.size() && !ply.resting && scene.dt > 0.0; ++n) {
      const Vec3 half = 0.5 * scene.dt * acceleration(ply, static_cast<int>(n), loads);
      if (half.allFinite()) of.half[n] = half; // else it is about to stop
    }
    for (std::size_t n = 0; n < ply.x.size(); ++n)
      ply.velocity[n] += of.half[n];
    of.now = ply.velocity;
  }
}

VelocitiesAtPositions::~VelocitiesAtPositions() {
  for (std::size_t p = 0; p < plies_.size() && !keep_; ++p) {
    PlyBody& ply = scene_.plies[p];
    const OfPly& of = plies_[p];
    bool written = false;
    for (std::size_t n = 0; n < ply.x.size(); ++n) {
      const bool same = ply.velocity[n] == of.now[n];
      written = written || !same;
      ply.velocity[n] = same ? of.behind[n] : Vec3(ply.velocity[n] - of.half[n]);
    }
    if (written) ply.resting = false;
  }
}

} // namespace plyform
