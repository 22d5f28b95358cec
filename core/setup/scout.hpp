// SPDX-License-Identifier: GPL-3.0-or-later
// A run with coarse elements and a fast stroke that says what element sizes the scene needs where:
// in the cloth that passes over what is round in a tool (core/setup/chord_sizes.hpp), and where
// shear bends sharply (core/setup/shear_sizes.hpp). Where its elements are so coarse that they do
// not say where (a small pocket in a large blank), it runs again with elements twice as large as
// those it has found, until they do. It ends where it has taken a share of the work of the run that
// it foresees, with what it has found until then.
#pragma once

#include "core/run/run.hpp"

#include <limits>
#include <vector>

namespace plyform {

struct SizeAhead;

struct ScoutHooks {
  /// Before each of its runs, from 1, with what that will take.
  std::function<void(int run, const SizeAhead& ahead)> begins = {};
  std::function<void(const Progress&)> progress = {}; ///< as in RunHooks
  const std::atomic<bool>* interrupt = nullptr;       ///< as in RunHooks
  RunHooks::Watch watch = {};                         ///< as in RunHooks
  /// Triangles times steps of all its runs, at most, beside its own share of the run.
  double most_work = std::numeric_limits<double>::infinity();
};

struct Scouted {
  std::vector<SizeGrid> sizes; ///< one per ply; of no use with a fault
  std::string fault;           ///< why it did not go to its end, its budget apart; else empty
  std::string ended;           ///< that the budget ended it, and what was not seen; else empty
  double work = 0.0;           ///< triangles times steps, of all its runs
  double seconds = 0.0;        ///< wall time
};

/// The case that scouts for `data`: elements 1.4 times as large as its largest (as large, where
/// boundaries hold nodes), zones and grids left out, and the fastest stroke and softest fibres of a
/// draft.
Case scout_case(const Case& data);

/// Scouts. threads >= 1; the result does not depend on it. shear_error: degrees, the part of the
/// mesh. Throws std::runtime_error as run_case.
Scouted scout(const Case& data, double shear_error, int threads, const ScoutHooks& hooks);

} // namespace plyform
