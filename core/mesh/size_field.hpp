// SPDX-License-Identifier: GPL-3.0-or-later
// The element size that a blank's zones and grid ask for, place by place. Lengths in mm, seen from
// the blank's origin.
#pragma once

#include "core/mesh/mesh_blank.hpp"

#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace plyform {

/// A zone, made ready to be asked many times.
struct FieldZone {
  MeshZone zone;
  Eigen::AlignedBox2d box; ///< around it
  double most_reach = 0.0; ///< of its places
  /// places (their numbers) by square cells of side most_reach: column, row
  std::map<std::pair<std::int64_t, std::int64_t>, std::vector<std::size_t>> cells;
};

struct SizeField {
  double largest = 0.0;         ///< where nothing asks for less; infinite for meshes from files
  std::vector<FieldZone> zones; ///< the smallest elements first
  std::optional<SizeGrid> grid;
};

/// Whether the blank's elements are to be of different sizes.
inline bool is_graded(const BlankSpec& spec) {
  return !spec.zones.empty() || spec.sizes.has_value();
}

/// Throws std::invalid_argument for a grid whose numbers of points and sizes disagree, or with a
/// size that is not above 0.
SizeField make_size_field(const BlankSpec& spec);

/// The wanted element size at p.
double wanted_size(const SizeField& field, const Vec2& p);

/// The least element size wanted anywhere in a triangle: zones count if they overlap it by more
/// than rounding, however small they are; the grid at corners, middles of sides, centroid, and its
/// own points inside.
double least_wanted(const SizeField& field, const std::array<Vec2, 3>& triangle);

/// Whether a zone, as seen from the blank, lies on a part of it; holes count as blank.
bool lies_on(const MeshZone& zone, const Outline& outline);

/// Area (mm^2) of a zone, roughly for one about a tool.
double area_of(const FieldZone& zone);

} // namespace plyform
