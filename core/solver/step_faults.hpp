// SPDX-License-Identifier: GPL-3.0-or-later
// What stops a simulation: each names step, time, place and value, and what would help. Nodes that
// go through something within one step: core/solver/pass_through.hpp.
#pragma once

#include "core/solver/step.hpp"

#include <optional>

namespace plyform {

/// A position that is no number.
std::optional<Stop> find_not_finite(const Scene& s);

/// A node of a ply on the wrong side of another, or with no room left to it.
std::optional<Stop> find_fault(const Scene& s);

/// Bodies that close however short the step: something is driven into what cannot give way.
std::optional<Stop> find_squeezed(const Scene& s);

/// A triangle that has no meaning any more (core/ply/membrane.hpp, collapsed).
std::optional<Stop> find_collapsed(const Scene& s);

} // namespace plyform
