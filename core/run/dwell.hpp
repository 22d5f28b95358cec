// SPDX-License-Identifier: GPL-3.0-or-later
// The dwell at the end of a run: driven tools stand still and pressures stay until forces have
// settled, for at most solver.dwell of the duration. A fast stroke throws plies ahead of the punch,
// off its face; the force on it is known only when they have come back.
//
// Settled: over a twentieth of the duration no tool's force has varied by more than 1 % of the
// largest, and the kinetic energy is below 1 % of that of deformation. Where pressures act, plies
// may swing, and are still for a moment at the ends of their way: there the kinetic energy is
// looked at ten times, and the work done on plies may vary by 0.1 % only.
#pragma once

#include "base/thread_pool.hpp"
#include "core/solver/scene.hpp"

#include <vector>

namespace plyform {

struct Dwell {
  std::vector<double> low, high;          ///< N, of each tool's force in this window
  double window_end = 0.0;                ///< s
  double next_look = 0.0;                 ///< s, at the energies, where pressures act
  double low_work = 0.0, high_work = 0.0; ///< N mm, on plies in this window
  bool moving = false;                    ///< not at rest at some look in this window
  bool settled = false;
};

template <class F>
void each_member(Dwell& dwell, F&& f) {
  auto& [low, high, window_end, next_look, low_work, high_work, moving, settled] = dwell;
  f("low", low);
  f("high", high);
  f("window_end", window_end);
  f("next_look", next_look);
  f("low_work", low_work);
  f("high_work", high_work);
  f("moving", moving);
  f("settled", settled);
}

/// Whether a run whose stroke is over may end, asked at each step when its forces are known.
bool dwell_ends(Dwell& dwell, const Scene& s, ThreadPool& pool);

} // namespace plyform
