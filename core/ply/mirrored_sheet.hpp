// SPDX-License-Identifier: GPL-3.0-or-later
// A flat sheet that is a part of a symmetric one, with what lies next to it beyond the planes: the
// mirror images of its own triangles there. So a stencil (core/ply/bending.hpp) at a node on a
// plane is the one that the whole sheet has.
#pragma once

#include "core/model/mirror.hpp"

#include <span>
#include <vector>

namespace plyform {

/// A node beyond a plane: the image of a node of the part.
struct ImageNode {
  std::int32_t node = 0;
  std::int32_t mirror = 0; ///< index into the images of the sheet (images_at)
};

struct MirroredSheet {
  std::vector<Vec2> x;             ///< mm, of the part's nodes, then of the images
  std::vector<Triangle> triangles; ///< of the part, then beyond
  std::vector<ImageNode> images;   ///< of the nodes from that number on
  std::vector<Mirror> mirrors;     ///< images_at; empty without planes
};

/// The sheet with three layers of triangles beyond each plane, which is as far as a stencil sees,
/// and one more. x: mm, of n nodes.
MirroredSheet mirrored_sheet(std::span<const Vec2> x, const std::vector<Triangle>& triangles,
                             const std::vector<SymmetryPlane>& planes);

} // namespace plyform
