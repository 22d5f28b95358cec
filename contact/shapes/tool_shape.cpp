// SPDX-License-Identifier: GPL-3.0-or-later
// Signed distance and smallest radius of curvature of any tool shape.
#include "contact/shapes/tool_shape.hpp"

#include "contact/shapes/shape_distance.hpp"

#include <algorithm>
#include <limits>
#include <vector>

namespace plyform {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double smallest(const Sphere& s) {
  return s.radius;
}
double smallest(const Cylinder& c) {
  return edge_of(c);
}
double smallest(const Box& b) {
  return edge_of(b);
}
double smallest(const Plane&) {
  return infinity;
}
double smallest(const Annulus& a) {
  return section_of(a).edge;
}
double smallest(const MeshShapePtr& mesh) {
  const std::vector<double>& radii = mesh->curvature().radius;
  return radii.empty() ? infinity : *std::min_element(radii.begin(), radii.end());
}

/// The smallest arc radius, or 0 if the material has a sharp edge: a corner at which the profile
/// turns to the right. Inner corners do not count: a sheet bridges them.
double smallest(const Profile& s) {
  constexpr double straight = 1e-6; // rad, above the rounding of tangents
  double radius = infinity;
  for (std::size_t i = 0; i < s.size(); ++i) {
    if (s[i].kind == ProfileSegment::Kind::arc)
      radius = std::min(radius, (s[i].a - s[i].centre).norm());
    if (i + 1 == s.size() && !is_ring(s)) break;
    const Vec2 t = tangent(s[i], 1), next = tangent(s[(i + 1) % s.size()], 0);
    if (t.x() * next.y() - t.y() * next.x() < -straight) return 0.0;
  }
  return radius;
}

/// A profile that leaves the axis downwards, or reaches it downwards, has the tip of a cone there:
/// a sharp edge too.
double smallest(const RevolvedProfile& profile) {
  constexpr double straight = 1e-6; // of tangents
  const Profile& s = profile.segments;
  if (is_ring(s)) return smallest(s);
  const Vec2 t0 = tangent(s.front(), 0), t1 = tangent(s.back(), 1);
  if (s.front().a.x() <= 0.0 && t0.x() * t0.y() < -straight) return 0.0;
  if (s.back().b.x() <= 0.0 && t1.x() * t1.y() > straight) return 0.0;
  return smallest(s);
}

/// The ends do not count.
double smallest(const ExtrudedProfile& profile) {
  return smallest(profile.segments);
}

} // namespace

SurfacePoint signed_distance(const ToolShape& shape, const Vec3& p, SurfaceHint& hint) {
  // one point: nothing to prepare
  if (const auto* profile = std::get_if<RevolvedProfile>(&shape))
    return revolved(p, [&](const Vec2& q) { return section_distance(profile->segments, q); });
  if (const auto* profile = std::get_if<ExtrudedProfile>(&shape))
    return extruded(p, profile->length,
                    [&](const Vec2& q) { return section_distance(profile->segments, q); });
  return std::visit([&](const auto& s) { return distance_of(s)(p, hint); }, shape);
}

std::size_t facet_count(const ToolShape& shape) {
  const auto* mesh = std::get_if<MeshShapePtr>(&shape);
  return mesh ? (*mesh)->surface().triangles.size() : 0;
}

double smallest_radius(const ToolShape& shape) {
  return std::visit([](const auto& s) { return smallest(s); }, shape);
}

double smallest_rounding(const ToolShape& shape) {
  const auto* mesh = std::get_if<MeshShapePtr>(&shape);
  if (!mesh) return smallest_radius(shape);
  double least = infinity;
  for (const double radius : (*mesh)->curvature().radius)
    if (radius > 0.0) least = std::min(least, radius);
  return least;
}

double radius_near(const ToolShape& shape, const Vec3& p) {
  const auto* mesh = std::get_if<MeshShapePtr>(&shape);
  if (!mesh) return smallest_radius(shape);
  SurfaceHint hint;
  (*mesh)->signed_distance(p, hint);
  if (hint.facet < 0) return infinity;
  double least = infinity;
  for (const std::int32_t node : (*mesh)->surface().triangles[at(hint.facet)])
    if (const double radius = (*mesh)->curvature().radius[at(node)]; radius > 0.0)
      least = std::min(least, radius);
  return least;
}

double deflection_near(const ToolShape& shape, const Vec3& p) {
  const auto* mesh = std::get_if<MeshShapePtr>(&shape);
  if (!mesh) return 0.0;
  SurfaceHint hint;
  (*mesh)->signed_distance(p, hint);
  return hint.facet < 0 ? 0.0 : (*mesh)->curvature().deflection[at(hint.facet)];
}

} // namespace plyform
