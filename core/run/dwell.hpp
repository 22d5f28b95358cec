// SPDX-License-Identifier: GPL-3.0-or-later
// The dwell at the end of a run: driven tools stand still until forces have settled, for at most
// solver.dwell of the duration. A fast stroke throws plies ahead of the punch, off its face; the
// force on it is known only when they have come back.
//
// Settled: over a twentieth of the duration no tool's force has varied by more than 1 % of the
// largest, and the kinetic energy is below 1 % of that of deformation.
#pragma once

#include "base/thread_pool.hpp"
#include "core/solver/scene.hpp"

#include <vector>

namespace plyform {

struct Dwell {
  std::vector<double> low, high; ///< N, of each tool's force in this window
  double window_end = 0.0;       ///< s
  bool settled = false;
};

template <class F>
void each_member(Dwell& dwell, F&& f) {
  auto& [low, high, window_end, settled] = dwell;
  f("low", low);
  f("high", high);
  f("window_end", window_end);
  f("settled", settled);
}

/// Whether a run whose stroke is over may end, asked at each step when its forces are known.
bool dwell_ends(Dwell& dwell, const Scene& s, ThreadPool& pool);

} // namespace plyform
