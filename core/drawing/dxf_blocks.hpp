// SPDX-License-Identifier: GPL-3.0-or-later
// Blocks of a drawing, put where they are inserted.
//
//   x -> p + R diag(sx, sy) (x - q)      q base point of the block, p, R, sx, sy of the insertion;
//                                        seen from below x and y then go to -x and y
#pragma once

#include "core/drawing/dxf_drawing.hpp"

#include <map>

namespace plyform {

struct DxfBlock {
  Vec2 base = Vec2::Zero(); ///< drawing's unit
  std::vector<DxfEntity> entities;
};

/// By name, in lower case: names of blocks do not distinguish it.
using DxfBlocks = std::map<std::string, DxfBlock>;

/// The entities with those of blocks in the place of their insertions, also of blocks in blocks. An
/// entity on layer 0 of a block gets the layer of the insertion. Insertions that cannot be resolved
/// stay, with their fault: of a block that is not there, of arrays, of blocks in themselves, of
/// arcs by different scales. Throws std::runtime_error ("rule; remedy") if that makes too many.
std::vector<DxfEntity> exploded(const std::vector<DxfEntity>& entities, const DxfBlocks& blocks);

} // namespace plyform
