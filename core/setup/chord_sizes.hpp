// SPDX-License-Identifier: GPL-3.0-or-later
// How large elements may be where a ply passes over what is round or sharp in a tool, from the
// states of a run with coarse elements (the scout, core/setup/scout.hpp).
//
//   p  mm  a place of the ply, put where its mid-surface would lie: o above the tool
//   o  mm  half its thickness, and that of the plies between
//   d(x)   mm  signed distance of x to the tool;  n  its normal at p
//   L  mm  a chord that stands for an element of size h, the side of a square of two triangles
//
// The middle of a chord through p, tangential to the tool, lies deeper than p should by
//   c(h) = max over e normal to n of  (d(p + L/2 e) + d(p - L/2 e)) / 2 - d(p)              (1)
//   L = 1.7 h
// which is L^2 / 8R over a radius R, and holds for any shape, meshes of tools too. 1.7: sides are
// up to sqrt(2) h long, and over what is curved both ways the middle of a triangle is 2/sqrt(3)
// farther from its corners; measured (core/run/facet_penetration.hpp) on five plies over a
// fillet of 10 mm with elements of 3.4, 3.7, 6.8 and 10 mm cuts are 1.02, 1.05, 1.1 and 1.1 times
// that, nodes' own depth taken off. The wanted size is the largest h with c(h) up to a depth that
// does no harm: where the ply itself lies on the tool less than what makes a run doubtful, a
// thickness (core/run/facet_penetration.hpp); plies between others only come nearer to those.
// Edges that a ply leaves rather than being drawn over them (core/setup/draws.hpp) count where they
// cut into the scout all the same, and 0.7 of that depth: measured at the inner edges of holders.
// Hollows count as ridges do, for a ply that is pressed into one: |c|.
#pragma once

#include "core/input/checks/initial_scene.hpp"
#include "core/model/case.hpp"
#include "core/results/frame.hpp"

#include <array>
#include <vector>

namespace plyform {

/// Places in a triangle that are asked: shares of its corners.
constexpr std::array<std::array<double, 3>, 4> asked_places = {{{1.0 / 3, 1.0 / 3, 1.0 / 3},
                                                                {2.0 / 3, 1.0 / 6, 1.0 / 6},
                                                                {1.0 / 6, 2.0 / 3, 1.0 / 6},
                                                                {1.0 / 6, 1.0 / 6, 2.0 / 3}}};

/// Wanted sizes, mm, of a ply: at each of asked_places of each triangle.
using AskedSizes = std::vector<std::array<double, asked_places.size()>>;

/// What bounds the sizes that are asked for, in thicknesses of the ply.
struct ChordLimits {
  double depth = 0.7;               ///< c at most where the ply lies on the tool
  double depth_between = 5.0 / 3.0; ///< and with other plies between
  double depth_aside = 1.2;         ///< and at edges that it leaves
  double smallest = 3.0;            ///< no element is smaller: no ply bends round less
};

/// c of (1) where a place of a ply was looked at, as seen from a tool.
struct SeenChord {
  Vec3 p = Vec3::Zero(), n = Vec3::Zero(); ///< mm from the tool's origin; unit vector
  double above = 0.0, size = -1.0;         ///< mm: o and h; below 0: not looked at yet
  double depth = 0.0;                      ///< mm, c, no more than was allowed
};

/// What is known of one ply from its states before, as seen from one tool.
struct SeenByTool {
  std::vector<LastDistance> middles, places; ///< of triangles; of all asked_places
  std::vector<SeenChord> chords;             ///< of all asked_places
};

/// Sizes from the states of one run, in their order.
class ChordSizes {
public:
  explicit ChordSizes(const Case& data, const ChordLimits& limits = {})
      : data_(data), limits_(limits) {}

  /// Lowers `sizes`, one per ply, to what (1) asks for at this state.
  void lower(const Frame& state, std::vector<AskedSizes>& sizes);

private:
  const Case& data_;
  ChordLimits limits_;
  std::vector<SeenByTool> seen_; ///< by ply and tool
};

} // namespace plyform
