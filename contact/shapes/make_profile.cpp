// SPDX-License-Identifier: GPL-3.0-or-later
// Makes chains of lines and arcs from corner points with fillet radii, and from what a shape is
// given by.
//
// At a corner with unit directions u in, v out and the angle phi between them, a fillet of radius R
// starts and ends R tan(phi/2) from the corner; its centre lies R away from its start, to the side
// to which the profile turns.
#include "base/format.hpp"
#include "contact/shapes/tool_shape.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace plyform {
namespace {

// Relative rounding of lengths: two fillets may together take up a whole side.
constexpr double rounding_of_lengths = 1e-12;

struct Corner {
  Vec2 start, end, centre;
  double setback = 0.0; ///< mm from the corner to start and end
  int turn = 0;         ///< 0: no fillet
};

using Points = std::vector<std::array<double, 3>>;

Vec2 point(const Points& points, std::size_t i) {
  return {points[i][0], points[i][1]};
}

/// Points with what messages call them.
struct Chain {
  const Points& points;
  const PointWords& words;
  bool closed;

  std::string named(std::size_t i) const {
    return fmt::format("{} {} ({} = {:g}, {} = {:g})", words.point, i, words.first, points[i][0],
                       words.second, points[i][1]);
  }
  std::size_t sides() const { return points.size() - (closed ? 0 : 1); }
  std::size_t after(std::size_t i) const { return (i + 1) % points.size(); }
  std::size_t before(std::size_t i) const { return (i + points.size() - 1) % points.size(); }
  bool is_end(std::size_t i) const { return !closed && (i == 0 || i + 1 == points.size()); }
};

void check_points(const Chain& chain) {
  const auto& [points, words, closed] = chain;
  if (const std::size_t least = closed ? 3 : 2; points.size() < least)
    throw std::invalid_argument(
        fmt::format("at least {} points are needed, got {}", least, points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& [first, second, fillet] = points[i];
    if (!std::isfinite(first) || !std::isfinite(second) || !std::isfinite(fillet))
      throw std::invalid_argument(fmt::format("{} {}: {}, {} and fillet radius must be finite "
                                              "numbers",
                                              words.point, i, words.first, words.second));
    if (fillet < 0.0)
      throw std::invalid_argument(
          fmt::format("{}: fillet radius {:g} must be at least 0", chain.named(i), fillet));
    if ((i > 0 || closed) && point(points, i) == point(points, chain.before(i)))
      throw std::invalid_argument(chain.named(i) +
                                  " repeats the point before it: leave one of them out");
    if (fillet > 0.0 && chain.is_end(i))
      throw std::invalid_argument(fmt::format("{}: an end has no corner for its fillet radius {:g} "
                                              "to round; make it 0",
                                              chain.named(i), fillet));
  }
}

Corner round_corner(const Chain& chain, std::size_t i) {
  const Points& points = chain.points;
  const Vec2 p = point(points, i);
  Corner corner{p, p, p};
  const double radius = points[i][2];
  if (radius == 0.0) return corner;
  const Vec2 u = (p - point(points, chain.before(i))).normalized();
  const Vec2 v = (point(points, chain.after(i)) - p).normalized();
  const double sine = u.x() * v.y() - u.y() * v.x(), cosine = u.dot(v);
  if (std::abs(sine) < rounding_of_lengths && cosine > 0.0) return corner; // no corner
  if (std::abs(sine) < rounding_of_lengths)
    throw std::invalid_argument(chain.named(i) +
                                ": the line turns straight back, no fillet fits there");
  corner.turn = sine > 0.0 ? 1 : -1;
  corner.setback = radius * std::tan(0.5 * std::atan2(std::abs(sine), cosine));
  corner.start = p - corner.setback * u;
  corner.end = p + corner.setback * v;
  corner.centre = corner.start + corner.turn * radius * Vec2(-u.y(), u.x());
  return corner;
}

/// Throws if the fillets at both ends of side i take more than its length. Returns the length left.
double length_left(const Chain& chain, const std::vector<Corner>& corners, std::size_t i) {
  const Points& points = chain.points;
  const std::size_t next = chain.after(i);
  const double side = (point(points, next) - point(points, i)).norm();
  const double needed = corners[i].setback + corners[next].setback;
  if (needed > side * (1.0 + rounding_of_lengths)) {
    const std::size_t at = corners[i].setback > corners[next].setback ? i : next;
    throw std::invalid_argument(fmt::format(
        "{}: its fillet radius {:g} does not fit: the fillets on the side from point {} to "
        "point {} take {:g} mm of its {:g} mm; make the fillet smaller or the side longer",
        chain.named(at), points[at][2], i, next, needed, side));
  }
  return side - needed > side * rounding_of_lengths ? side - needed : 0.0;
}

} // namespace

Profile round_corners(const Points& points, bool closed, const PointWords& words) {
  const Chain chain{points, words, closed};
  check_points(chain);
  std::vector<Corner> corners;
  for (std::size_t i = 0; i < points.size(); ++i)
    corners.push_back(chain.is_end(i) ? Corner{point(points, i), point(points, i), {}}
                                      : round_corner(chain, i));
  Profile profile;
  for (std::size_t i = 0; i < chain.sides(); ++i) {
    Corner &here = corners[i], &next = corners[chain.after(i)];
    if (length_left(chain, corners, i) > 0.0)
      profile.push_back({ProfileSegment::Kind::line, here.end, next.start});
    else
      next.start = here.end; // two fillets meet: one and the same point
    if (next.turn != 0)
      profile.push_back({ProfileSegment::Kind::arc, next.start, next.end, next.centre, next.turn});
  }
  return profile;
}

RevolvedProfile make_profile(const Points& points) {
  constexpr PointWords words{"profile point", "r", "z"};
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i][0] < 0.0)
      throw std::invalid_argument(Chain{points, words, false}.named(i) +
                                  ": r must be at least 0, the profile is turned about r = 0");
  return {round_corners(points, false, words)};
}

RevolvedProfile make_cone(double radius, double top_radius, double length, double edge_radius) {
  const double half = 0.5 * length, flank = std::hypot(radius - top_radius, length);
  // Half the angle of the section at the base, and what roundings of radius 1 take of the flank and
  // of the faces: at the base, at the top face or at the tip.
  const double tan_half = std::tan(0.5 * std::atan2(length, radius - top_radius));
  const bool tip = top_radius == 0.0;
  const double at_base = 1.0 / tan_half, at_top = tip ? length / radius : tan_half;
  const double most = std::min(
      {radius / at_base, flank / (at_base + at_top), tip ? flank / at_top : top_radius / at_top});
  if (edge_radius > most)
    throw std::invalid_argument(
        fmt::format("must be at most {:g}, for the roundings to fit the cone; make it smaller or "
                    "the cone larger",
                    most));
  if (!tip)
    return make_profile({{0.0, half, 0.0},
                         {top_radius, half, edge_radius},
                         {radius, -half, edge_radius},
                         {0.0, -half, 0.0}});
  if (edge_radius == 0.0)
    return make_profile({{0.0, half, 0.0}, {radius, -half, 0.0}, {0.0, -half, 0.0}});
  const double sine = radius / flank, cosine = length / flank; // of half the angle of the tip
  const Vec2 centre(0.0, half - edge_radius / sine);
  const Vec2 touch = centre + edge_radius * Vec2(cosine, sine);
  RevolvedProfile cone =
      make_profile({{touch.x(), touch.y(), 0.0}, {radius, -half, edge_radius}, {0.0, -half, 0.0}});
  const Vec2 top(0.0, centre.y() + edge_radius);
  cone.segments.insert(cone.segments.begin(), {ProfileSegment::Kind::arc, top, touch, centre, -1});
  return cone;
}

RevolvedProfile make_torus(double major_radius, double minor_radius) {
  const Vec2 centre(major_radius, 0.0), start(major_radius + minor_radius, 0.0);
  return {{{ProfileSegment::Kind::arc, start, start, centre, -1}}};
}

} // namespace plyform
