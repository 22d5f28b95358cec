// SPDX-License-Identifier: GPL-3.0-or-later
// Faults that stop a simulation. Each message names step, time, position and value, and a remedy.
// Nodes that pass through a body within one step: core/solver/pass_through.hpp.
#pragma once

#include "core/solver/step.hpp"

#include <optional>

namespace plyform {

/// mm, a thousand kilometres: nothing is formed there, and squares of it are finite in floats,
/// which the search computes with.
constexpr double furthest_place = 1e9;

/// A position that is not finite, or further away than `furthest_place`; or a way in one step.
std::optional<Stop> find_not_finite(const Layup& layup);

/// A node of a ply on the other side of another ply, or beyond the depth limit of contact.
std::optional<Stop> find_fault(const PlyContacts& contacts, const Layup& layup);

/// Contacts that close so fast that they reduce the time step below 1e-4 of the longest one: a body
/// is driven into something that cannot yield.
std::optional<Stop> find_squeezed(const Scene& s);

/// A triangle that has collapsed (core/ply/membrane.hpp, collapsed).
std::optional<Stop> find_collapsed(const Layup& layup);

} // namespace plyform
