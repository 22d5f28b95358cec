// SPDX-License-Identifier: GPL-3.0-or-later
// How deep a tool may cut into a ply that is drawn over it, before anything has moved: contact is
// at nodes only, and a side of a triangle is a chord over what is round or sharp.
//
// Asked are edges between faces of the tool's tessellated surface, at their middle q, with n the
// mean of the normals of both faces. A chord of the longest side L that the ply has there and for
// half a stroke on, where what will pass there comes from, across the edge and at
// half a thickness from the tool, is lowered along -n until an end touches the tool: the way is the
// cut. On a cylinder, a fillet of 90 degrees and a sharp edge that is
// core/run/facet_penetration.hpp, (1) and (2), and it takes any tool, meshes too. A ply is drawn
// over q if q faces it and something moves it, relative to this tool, against n: the edge of a
// blank-holder from which a punch draws the ply away is no such place.
#pragma once

#include "core/solver/scene.hpp"

#include <optional>

namespace plyform {

struct CutAhead {
  double depth = 0.0;     ///< mm
  Vec3 where{0, 0, 0};    ///< mm, in space
  double radius = 0.0;    ///< mm, that would cut as deep; 0: an edge sharper than the thickness
  double good_side = 0.0; ///< mm, with which the cut is half a thickness
  double side = 0.0;      ///< mm, L
};

/// The deepest cut of the tool into the ply; nothing if the ply is drawn over no part of it.
std::optional<CutAhead> cut_ahead(const Scene& scene, std::size_t tool, std::size_t ply);

} // namespace plyform
