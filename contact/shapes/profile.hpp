// SPDX-License-Identifier: GPL-3.0-or-later
// Internal to contact/: signed distance to a profile in its plane.
#pragma once

#include "contact/shapes/tool_shape.hpp"

namespace plyform {

/// Signed distance (mm, positive on the free side) and its unit gradient in the plane of a profile.
struct SectionPoint {
  double distance;
  Vec2 normal;
};

/// Signed distance (mm) of q (mm) to the profile, and its gradient: (1) to (3) of profile.cpp. Past
/// an open end the sign is that of the side of the end's tangent on which q lies. The profile must
/// have at least one segment.
SectionPoint section_distance(const Profile& profile, const Vec2& q);

/// A segment and the quantities derived from it that its distance to a point needs.
struct SegmentForm {
  explicit SegmentForm(const ProfileSegment& segment);

  ProfileSegment::Kind kind;
  bool full_circle;    ///< an arc with a = b
  bool past_half_turn; ///< an arc that sweeps more than half a turn
  double extent;       ///< mm, length of a line, radius of an arc
  double turn;         ///< as of ProfileSegment
  Vec2 from;           ///< a of a line, centre of an arc
  Vec2 a, b;           ///< ends
  Vec2 tangent;        ///< unit, of a line
  Vec2 to_a, to_b;     ///< of an arc, mm: from its centre, times turn
};

/// section_distance for many points of one profile. Keeps a reference to the profile, which must
/// outlive it.
class SectionField {
public:
  explicit SectionField(const Profile& profile);
  SectionPoint distance(const Vec2& q) const;

private:
  const Profile* profile_;
  std::vector<SegmentForm> forms_;
};

/// The last point of the profile is its first: a ring.
bool is_ring(const Profile& profile);

/// A ring, or both ends on the axis: the profile bounds a solid.
bool is_closed(const RevolvedProfile& profile);

/// Unit tangent in walking direction at a (end = 0) or b (end = 1).
Vec2 tangent(const ProfileSegment& segment, int end);

/// Angle (rad, in (0, 2 pi]) an arc sweeps, in the direction of its turn.
double sweep(const ProfileSegment& arc);

} // namespace plyform
