// SPDX-License-Identifier: GPL-3.0-or-later
// Plies that went beyond what their laws were measured to.
#pragma once

#include "core/model/fabric.hpp"
#include "core/results/frame.hpp"
#include "core/results/summary.hpp"

#include <optional>
#include <string>
#include <vector>

namespace plyform {

/// Rubber stretched beyond what its law was measured to on more than this share of its area is
/// doubtful.
constexpr double doubtful_stretched_share = 0.01;
/// Likewise of a ply that was sheared faster.
constexpr double doubtful_rated_share = 0.01;

/// 1/s, the highest rate of shear up to which all crossings with rates were measured.
std::optional<double> highest_measured_rate(const Fabric& fabric);

/// A sentence each: rubber that is stretched further, and shear that was faster, than measured.
std::vector<std::string> doubts_of_limits(const Frame& last, const std::vector<PlyReport>& plies);

} // namespace plyform
