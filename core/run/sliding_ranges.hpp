// SPDX-License-Identifier: GPL-3.0-or-later
// Where in the curves of friction a run has slid, and whether they reach so far.
#pragma once

#include "core/model/friction.hpp"
#include "core/results/summary.hpp"

#include <string>
#include <vector>

namespace plyform {

/// A run that has done more than this share of the work of sliding of a pair outside a curve is
/// doubtful, as it went by the curve's ends; so is one that slid unsteadily for that share.
constexpr double doubtful_sliding_share = 0.1;

/// Adds what one contact of a pair has seen. Shares are of work, N mm, until end_ranges.
void add_ranges(const FrictionLaw& law, const SlidingSeen& seen, PairReport& pair);
/// Makes them shares of the pair's work.
void end_ranges(PairReport& pair);

/// Reasons to doubt forces of friction.
std::vector<std::string> doubts_of_sliding(const std::vector<PairReport>& pairs);

} // namespace plyform
