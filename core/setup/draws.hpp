// SPDX-License-Identifier: GPL-3.0-or-later
// Where plies are drawn over a tool: where something moves them, relative to it, against its
// surface. The edge of a blank-holder from which a punch draws the ply away is no such place.
#pragma once

#include "core/model/case.hpp"

#include <vector>

namespace plyform {

/// Where things that move plies go, relative to the tool: unit vectors. A pushed tool stays about
/// where it is if another one is driven.
std::vector<Vec3> draws_on(const Case& data, std::size_t tool);

/// Whether plies are drawn over a place of the tool with this normal, by any of draws_on.
bool draws_over(const std::vector<Vec3>& draws, const Vec3& normal);

} // namespace plyform
