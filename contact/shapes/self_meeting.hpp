// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a profile crosses or touches itself, or goes twice along one way: then no side of it is
// free.
#pragma once

#include "contact/shapes/tool_shape.hpp"

#include <optional>

namespace plyform {

/// A place (mm) where two segments of a profile meet that do not follow each other, the first in
/// walking order; nothing if there is none. One after the other may turn straight back (a blade).
/// Ends that are nearer than a thousand millionth of the profile's size are one.
std::optional<Vec2> self_meeting(const Profile& profile);

} // namespace plyform
