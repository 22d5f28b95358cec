// SPDX-License-Identifier: GPL-3.0-or-later
// Internal to contact/: the section of a surface of revolution in the (r, z) half-plane.
#pragma once

#include "contact/tool_shape.hpp"

namespace plyform {

/// Signed distance (mm, positive on the free side) and its unit gradient (r, z) at q = (r, z), r >=
/// 0.
struct SectionPoint {
  double distance;
  Vec2 normal;
};

/// Distance of q to the profile. Past an open end the sign is the side of the end's tangent.
/// The profile has at least one segment.
SectionPoint section_distance(const RevolvedProfile& profile, const Vec2& q);

/// The last point of the profile is its first: a ring.
bool is_ring(const RevolvedProfile& profile);

/// A ring, or both ends on the axis: the profile bounds a solid.
bool is_closed(const RevolvedProfile& profile);

/// Unit tangent in walking direction at a (end = 0) or b (end = 1).
Vec2 tangent(const ProfileSegment& segment, int end);

/// Angle (rad, in (0, 2 pi]) an arc sweeps, in the direction of its turn.
double sweep(const ProfileSegment& arc);

/// A box around the surface of revolution, no larger than the full circles of its arcs.
Box3 bounds(const RevolvedProfile& profile);

/// r/|p| direction of p about z; +x on the axis.
inline Vec2 radial_direction(const Vec3& p, double r) {
  return r > 0.0 ? Vec2(p.x() / r, p.y() / r) : Vec2(1.0, 0.0);
}

} // namespace plyform
