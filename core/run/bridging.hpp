// SPDX-License-Identifier: GPL-3.0-or-later
// Bridging: where a stack spans a hollow of a tool that it is pressed towards, as a bag over a
// corner. It is pressed, at a node,
// - by loads: to the side of the sum of the loads on all plies of its stack; a vacuum between two
//   membranes alone presses the stack between them to neither side;
// - between the tools of a closed mould (core/run/moulds.hpp): from the one that it touches to the
// other. A ply under an open punch is not.
//
//   u  -   unit normal of the ply, to the side to which it is pressed
//   d  mm  distance from the tool that the line along u meets first, along that tool's normal
//   b  mm  thickness of the other plies between the node and the tool, along that normal
//   h  mm  d - t/2 - b, height of the stack over the tool, t thickness of the ply            (1)
// Over the middle of a hollow d has a ridge, where the nearest point of the tool changes sides, and
// nodes lie beside it: the highest node of a triangle gets the largest h in that.
//
// A ply lies between, too, if the way to the tool misses its border by less than half of its
// element size: plies as large as each other are drawn in by some hundredths of a millimetre more
// or less, and what the last half element of a stack spans the mesh does not tell.
//
// Something holds a node up if h <= (t + b)/2 over a tool that faces it: on fillets facets of plies
// leave gaps between each other. Where nothing does, neighbours make a region, which bridges if it
//   - has a node beside it that is held up: nothing is spanned before the tool is touched;
//   - is no wave of its own. With a sum over nodes i of the region and their neighbours j,
//       S = sum h_i (x_j - x_i) . u_i,   G = sum h_i (h_i - h_j),   S <= G/2                 (2)
//     A wave on a flat tool has S = G, as its height is that over the tool. A ply that hangs
//     between its supports or is straight has S <= 0: the height is the tool's.
#pragma once

#include "core/results/frame.hpp"
#include "core/run/moulds.hpp"
#include "core/solver/scene.hpp"

#include <memory>

namespace plyform {

/// Finds bridging in the plies of a scene, in its present state with its last forces.
class BridgingSearch {
public:
  BridgingSearch(const Scene& scene, const Moulds& moulds);
  ~BridgingSearch();
  BridgingSearch(const BridgingSearch&) = delete;
  BridgingSearch& operator=(const BridgingSearch&) = delete;

  /// Fills bridging_height and pushed of a ply; both stay empty in a case without loads and without
  /// a mould that closes. Several threads may call it at once.
  void fill(std::size_t ply, PlyFrame& frame) const;

private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

} // namespace plyform
