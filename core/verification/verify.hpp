// SPDX-License-Identifier: GPL-3.0-or-later
// Verifies a run: runs its siblings (siblings.hpp) and takes from them the bands of its figures
// (bands.hpp).
#pragma once

#include "core/results/verification.hpp"
#include "core/solver/run.hpp"

#include <atomic>
#include <functional>
#include <optional>
#include <string>

namespace plyform {

struct VerifyHooks {
  std::function<void(const std::string& sibling, std::size_t number, std::size_t of)> begins;
  std::function<void(const Progress&)> progress;
  const std::atomic<bool>* interrupt = nullptr; ///< set it to end early
};

/// The bands of a run of `data` that went to its end. A sibling that stops, or ends at another
/// stroke, is left out, which the verification says. Nothing if it was interrupted. threads >= 1.
/// Throws std::runtime_error as run_case.
std::optional<Verification> verify(const Case& data, const RunResult& run, int threads,
                                   const VerifyHooks& hooks);

} // namespace plyform
