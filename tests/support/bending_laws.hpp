// SPDX-License-Identifier: GPL-3.0-or-later
// Laws of bending of a weave for tests.
#pragma once

#include "core/model/fabric.hpp"

namespace plyform {

/// Two families along the axes, warp and weft, bending along them and in their plane: N mm.
inline BendingLaw weave_bending(double warp = 0.0, double weft = 0.0, double in_plane_warp = 0.0,
                                double in_plane_weft = 0.0) {
  BendingLaw law;
  law.families = {{Vec2::UnitX(), {warp, {}, {}}, in_plane_warp},
                  {Vec2::UnitY(), {weft, {}, {}}, in_plane_weft}};
  return law;
}

} // namespace plyform
