// SPDX-License-Identifier: GPL-3.0-or-later
// Verifies a run: runs its siblings (siblings.hpp) and takes from them the bands of its figures
// (bands.hpp).
#pragma once

#include "core/results/verification.hpp"
#include "core/run/run.hpp"
#include "core/verification/trace.hpp"

#include <atomic>
#include <functional>
#include <optional>
#include <string>

namespace plyform {

struct VerifyHooks {
  std::function<void(const std::string& sibling, std::size_t number, std::size_t of)> begins;
  /// Of the sibling; fraction: of all their work.
  std::function<void(const Progress&, double fraction)> progress;
  const std::atomic<bool>* interrupt = nullptr; ///< set it to end early
};

/// The bands of a run of `data` that went to its end; trace: what watch() kept of it, with states;
/// without them there are no late twins. A sibling that stops is left out, which the verification
/// says. Nothing if it was interrupted. threads >= 1. meshes: of the run's plies, or empty. Throws
/// std::runtime_error as run_case.
std::optional<Verification> verify(const Case& data, const RunResult& run, const Trace& trace,
                                   int threads, const VerifyHooks& hooks,
                                   const std::vector<BlankMesh>& meshes = {});

} // namespace plyform
