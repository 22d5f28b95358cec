// SPDX-License-Identifier: GPL-3.0-or-later
// Velocities at the time of the positions, for who looks at a run between two steps. The step loop
// keeps them half a step behind: v(t) = v(t - dt/2) + dt/2 a(t).
#pragma once

#include "core/solver/scene.hpp"

namespace plyform {

/// While it lives, PlyState::velocity of all plies is that at the time of their x. Then it is
/// half a step behind again: with its bits where nothing was written to it, and with what was
/// written elsewhere. To be used after the forces of x have been computed.
class VelocitiesAtPositions {
public:
  explicit VelocitiesAtPositions(Scene& scene);
  ~VelocitiesAtPositions();
  VelocitiesAtPositions(const VelocitiesAtPositions&) = delete;
  VelocitiesAtPositions& operator=(const VelocitiesAtPositions&) = delete;
  /// Leaves them as they are now, at the end of a run.
  void keep() { keep_ = true; }

private:
  /// mm/s, dt/2 a of each node; v(t - dt/2) and v(t) as they were made.
  struct OfPly {
    std::vector<Vec3> half, behind, now;
  };
  Scene& scene_;
  std::vector<OfPly> plies_;
  bool keep_ = false;
};

} // namespace plyform
