// SPDX-License-Identifier: GPL-3.0-or-later
// The part of an outline on one side of a line.
#pragma once

#include "core/model/blank_spec.hpp"

#include <optional>

namespace plyform {

/// What is inside the outline and on the side of the line through `point` (mm) to which `normal`
/// (unit vector) points: corners on the line, arcs and holes as they are. Nothing if that is
/// nothing, or more than one piece.
std::optional<Outline> cut_outline(const Outline& outline, const Vec2& point, const Vec2& normal);

} // namespace plyform
