// SPDX-License-Identifier: GPL-3.0-or-later
// Where a tool is tightly rounded, seen from above: what a zone along it holds.
#pragma once

#include "core/model/case.hpp"

#include <optional>
#include <vector>

namespace plyform {

/// Which places of a tool count, and how far a zone reaches from them. mm.
struct ToolZoneRule {
  /// the largest radius that counts; unless given twice the tightest one of the tool, or a tenth
  /// of its diagonal if that is more
  std::optional<double> below_radius;
  /// unless given twice the radius there, or twice the element size if that is more
  std::optional<double> distance;
  double element_size = 0.0;
  /// Places further from it than they reach are left out but for one of each piece of the surface:
  /// of a tool that is far wider than the blank they would be millions. Empty: none are.
  Eigen::AlignedBox2d window{};
};

/// Discs about all places of the tool's surface, where it lies at the start, whose tightest convex
/// radius is at most below_radius; sharp edges count, what is flat or hollow does not. The radius
/// is that of contact/shapes/mesh_curvature.hpp, of shapes that are no meshes after they were
/// tessellated. Discs are at most half their reach apart. Empty if there is no such place.
std::vector<ToolPlace> tight_places(const Tool& tool, const ToolZoneRule& rule);

/// The zone as seen from the blank of a ply: places turned and moved with it; others as they are.
MeshZone seen_from_blank(MeshZone zone, const Ply& ply);

} // namespace plyform
