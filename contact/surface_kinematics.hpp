// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/geometry.hpp"

#include <array>
#include <span>

namespace plyform {

struct SheetEdge;

/// Position and motion of the mid-surface of a ply: spans over its nodes.
struct SurfaceKinematics {
  std::span<const Vec3> x;      ///< mm
  std::span<const Vec3> motion; ///< mm, displacement in the last step
  std::span<const double> area; ///< mm^2, tributary area of a node
  std::span<const double>
      fold_bound; ///< per face (contact/search/fold_bound.hpp); empty: not known
  /// per face, of SheetEdges; needed only with fold_bound
  std::span<const std::array<std::int32_t, 3>> faces_across = {};
  /// per node, present thickness over that before forming; for contacts that ask for it
  std::span<const double> thickness_ratio = {};
  /// per node, how its fibres run, of any length; for searches whose laws ask for it
  std::span<const Vec3> fibres = {};
  /// Its edges and, per node, the distance (mm) before forming from the sheet's rim; where films
  /// slide and heat flows
  std::span<const SheetEdge> edges = {};
  std::span<const double> rim_distance = {};
  /// per node, degC; for friction that asks for it
  std::span<const double> temperature = {};
  std::span<const double> area_now = {}; ///< mm^2, as `area`, now; where a vacuum presses
};

} // namespace plyform
