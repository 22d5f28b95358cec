// SPDX-License-Identifier: GPL-3.0-or-later
// What a run leaves for its twins: where its plies were at twenty times, and the states from which
// late twins go on.
#pragma once

#include "core/results/verification.hpp"
#include "core/run/run.hpp"

#include <optional>
#include <string>
#include <vector>

namespace plyform {

constexpr int trace_marks = 20; // evenly over the duration: 0.6, 0.75, 0.8, 0.85 are among them

struct Moment {
  double time = 0.0, stroke_mm = 0.0;
  long step = 0;
  std::vector<std::vector<Vec3>> x; ///< mm, of the nodes of each ply; empty: not reached
  std::string state;                ///< bytes of RunHooks::Checkpoint; empty: not kept
};

/// By number of the mark less 1.
using Trace = std::vector<Moment>;

/// Has a run with these hooks fill the trace, which must live as long as the run; with_states: also
/// from where late twins go on.
void watch(RunHooks& hooks, Trace& trace, bool with_states);

/// The moment of a trace at this share of the duration.
const Moment* moment_at(const Trace& trace, double share);

/// Where two runs of the same nodes first are a tenth of an element apart, by their traces or at
/// the end; and how far their shear is apart then, of the ply that is furthest.
std::optional<Parting> parting_of(const Trace& one, const Frame& one_end, const Trace& other,
                                  const Frame& other_end);

} // namespace plyform
