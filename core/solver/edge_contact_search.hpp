// SPDX-License-Identifier: GPL-3.0-or-later
// The search for pairs of edges: with every contact search, and when an edge has become a ridge
// since (contact/search/sheet_ridges.hpp).
#pragma once

#include "core/solver/contact_state.hpp"
#include "core/solver/layup.hpp"

#include <span>

namespace plyform {

/// Lists every pair of ridges of two plies within contact distance + skin.
void search_edges(const Layup& layup, PlyEdgeContact& pair);

/// Adds the pairs of these edges, which have become ridges since the search, with all ridges of the
/// other ply. new_a, new_b: numbers of edges of either ply, ascending.
void search_new_ridges(const Layup& layup, PlyEdgeContact& pair,
                       std::span<const std::int32_t> new_a, std::span<const std::int32_t> new_b);

} // namespace plyform
