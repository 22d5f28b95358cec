// SPDX-License-Identifier: GPL-3.0-or-later
// Which bodies of a case can come within reach of each other, told before anything moves: by boxes
// around plies and tools at the start, drawn out by how far what moves them goes. What is chosen
// for a whole stack (estimates of fabrics, stiffness of contact, contact of plies with themselves,
// the skin of the search, cost parameters) is chosen for plies that may press each other; a body
// that reaches nothing has no part in it.
#pragma once

#include "core/model/case.hpp"

namespace plyform {

struct ReachAhead {
  std::vector<int> stack;         ///< per ply: the lowest ply of its stack, of which it is one
  std::vector<char> ply_moves;    ///< per ply: whether anything may move it
  std::vector<char> tool_reaches; ///< per tool: whether it may touch a ply

  int plies_in_stack(std::size_t ply) const; ///< itself included
  /// The same of any ply that moves, or of any if none does; 0 without plies.
  int largest_stack() const;
};

/// Errs on the side of reach: a ply may rise by a tenth of its size, and what it meets moves it
/// along. A blank read from a mesh reaches everything at its height.
ReachAhead reach_ahead(const Case& data);

/// Where a flat ply lies, seen from above, mm; empty of a blank without an outline.
Eigen::AlignedBox2d plan_of(const Case& data, const Ply& ply);

/// The case without the plies that nothing moves, and the tools that reach none; all of it if
/// nothing moves any ply.
Case taking_part(const Case& data);

} // namespace plyform
