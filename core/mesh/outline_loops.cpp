// SPDX-License-Identifier: GPL-3.0-or-later
// Loops of an outline: made from chains of lines and arcs, moved, measured, divided into pieces.
#include "contact/shapes/fill_polygon.hpp"
#include "core/mesh/mesher_parts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace plyform {
namespace {

const std::vector<Vec2>& corners_of(const Outline& outline, int hole) {
  return hole < 0 ? outline.boundary : outline.holes[static_cast<std::size_t>(hole)];
}

/// The arc in the place of each side of a loop, or null.
std::vector<const OutlineArc*> arcs_of(const Outline& outline, int hole) {
  std::vector<const OutlineArc*> arcs(corners_of(outline, hole).size(), nullptr);
  for (const OutlineArc& arc : outline.arcs)
    if (arc.hole == hole && arc.side < arcs.size() && !arcs[arc.side]) arcs[arc.side] = &arc;
  return arcs;
}

/// Corners of a loop that are closer than this share of an element to the one before are no more
/// than a part of it: elements as small would set the step of the whole run.
constexpr double same_corner = 0.02;

/// The corners that count at this element size, mm, in order. All of them, if fewer than three did.
std::vector<std::size_t> counting_corners(const std::vector<Vec2>& corners, double spacing) {
  std::vector<std::size_t> counting;
  const double least = std::isfinite(spacing) ? same_corner * spacing : 0.0;
  for (std::size_t k = 0; k < corners.size(); ++k)
    if (counting.empty() || !((corners[k] - corners[counting.back()]).norm() < least))
      counting.push_back(k);
  while (counting.size() > 1 && (corners[counting.back()] - corners[0]).norm() < least)
    counting.pop_back();
  if (counting.size() >= 3) return counting;
  counting.resize(corners.size());
  std::iota(counting.begin(), counting.end(), std::size_t{0});
  return counting;
}

/// The longest side of those from one corner to another, all but one of which are not counted.
std::size_t longest_side(const std::vector<Vec2>& corners, std::size_t from, std::size_t to) {
  std::size_t longest = from;
  double most = -1.0;
  for (std::size_t k = from; most < 0.0 || k != to; k = (k + 1) % corners.size()) {
    const double side = (corners[(k + 1) % corners.size()] - corners[k]).norm();
    if (side > most) most = side, longest = k;
  }
  return longest;
}

/// Area (mm^2), positive for loops that go round anticlockwise.
double signed_area(const Outline& outline, int hole) {
  const std::vector<Vec2>& loop = corners_of(outline, hole);
  double twice = 2.0 * area_of(loop);
  for (const OutlineArc& arc : outline.arcs) {
    if (arc.hole != hole) continue;
    const Vec2 &p = loop[arc.side], &q = loop[(arc.side + 1) % loop.size()];
    const double angle = sweep_of(arc.centre, arc.turn, p, q), r2 = (p - arc.centre).squaredNorm();
    twice += arc.turn * r2 * (angle - std::sin(angle)); // the segment between chord and arc
  }
  return 0.5 * twice;
}

} // namespace

void append_loop(Outline& outline, const Profile& chain) {
  const bool first = outline.boundary.empty();
  const int hole = first ? -1 : static_cast<int>(outline.holes.size());
  std::vector<Vec2>& corners = first ? outline.boundary : outline.holes.emplace_back();
  for (const ProfileSegment& s : chain) {
    if (s.kind == ProfileSegment::Kind::line) {
      corners.push_back(s.a);
      continue;
    }
    OutlineArc arc{hole, 0, s.centre, s.turn};
    const double angle =
        s.a == s.b ? 2.0 * std::numbers::pi : sweep_of(arc.centre, arc.turn, s.a, s.b);
    const int n = std::max(1, static_cast<int>(std::ceil(angle / (0.5 * std::numbers::pi) - 1e-9)));
    for (int i = 0; i < n; ++i) {
      arc.side = corners.size();
      corners.push_back(
          i == 0 ? s.a
                 : Vec2(s.centre + Eigen::Rotation2Dd(s.turn * angle * i / n) * (s.a - s.centre)));
      outline.arcs.push_back(arc);
    }
  }
}

void append_circle(Outline& outline, const Vec2& centre, double radius) {
  const Vec2 start = centre + Vec2(radius, 0.0);
  append_loop(outline, {{ProfileSegment::Kind::arc, start, start, centre, 1}});
}

double area_of(const Outline& outline) {
  double area = std::abs(signed_area(outline, -1));
  for (std::size_t k = 0; k < outline.holes.size(); ++k)
    area -= std::abs(signed_area(outline, static_cast<int>(k)));
  return area;
}

std::vector<Vec2> points_of(const Outline& outline, double largest_turn) {
  return sample_loop(outline, -1, std::numeric_limits<double>::infinity(), largest_turn);
}

void shift(Outline& outline, const Vec2& by) {
  for (Vec2& x : outline.boundary)
    x += by;
  for (std::vector<Vec2>& hole : outline.holes)
    for (Vec2& x : hole)
      x += by;
  for (OutlineArc& arc : outline.arcs)
    arc.centre += by;
}

std::vector<Vec2> sample_loop(const Outline& outline, int hole, double spacing,
                              double largest_turn) {
  std::vector<Vec2> points;
  for (const SampledSide& side : sample_sides(outline, hole, spacing, largest_turn))
    points.insert(points.end(), side.points.begin(), side.points.end());
  return points;
}

std::size_t merged_corners(const Outline& outline, double spacing) {
  std::size_t merged = 0;
  for (int k = -1; k < static_cast<int>(outline.holes.size()); ++k) {
    const std::vector<Vec2>& corners = corners_of(outline, k);
    merged += corners.size() - counting_corners(corners, spacing).size();
  }
  return merged;
}

std::vector<SampledSide> sample_sides(const Outline& outline, int hole, double spacing,
                                      double largest_turn) {
  const std::vector<Vec2>& corners = corners_of(outline, hole);
  const auto pieces = [spacing](double length) {
    return std::max(1, static_cast<int>(std::lround(length / spacing)));
  };
  const std::vector<const OutlineArc*> arcs = arcs_of(outline, hole);
  std::vector<SampledSide> sides;
  const std::vector<std::size_t> counting = counting_corners(corners, spacing);
  for (std::size_t k = 0; k < counting.size(); ++k) {
    const std::size_t next = counting[(k + 1) % counting.size()];
    const Vec2 p = corners[counting[k]], q = corners[next], along = q - p;
    const OutlineArc* arc = arcs[longest_side(corners, counting[k], next)];
    std::vector<Vec2>& points = sides.emplace_back(SampledSide{{}, q, arc}).points;
    if (!arc) {
      const int n = pieces(along.norm());
      for (int i = 0; i < n; ++i)
        points.push_back(p + along * (static_cast<double>(i) / n));
      continue;
    }
    // The radii of both ends may differ by the rounding of a drawing's numbers.
    const Vec2 u = p - arc->centre;
    const double angle = sweep_of(arc->centre, arc->turn, p, q),
                 ratio = (q - arc->centre).norm() / u.norm();
    const int n = std::max(pieces(angle * u.norm()),
                           static_cast<int>(std::ceil(angle / largest_turn - 1e-9)));
    points.push_back(p);
    for (int i = 1; i < n; ++i) {
      const double share = static_cast<double>(i) / n;
      points.push_back(arc->centre + Eigen::Rotation2Dd(arc->turn * angle * share) * u *
                                         (1.0 + share * (ratio - 1.0)));
    }
  }
  return sides;
}

Region sample_outline(const Outline& outline, double spacing, double largest_turn) {
  Region region;
  for (int k = -1; k < static_cast<int>(outline.holes.size()); ++k) {
    const auto first = static_cast<std::int32_t>(region.x.size());
    const std::vector<Vec2> points = sample_loop(outline, k, spacing, largest_turn);
    region.x.insert(region.x.end(), points.begin(), points.end());
    const auto last = static_cast<std::int32_t>(region.x.size());
    for (std::int32_t n = first; n < last; ++n)
      region.edges.push_back({n, n + 1 < last ? n + 1 : first});
  }
  return region;
}

} // namespace plyform
