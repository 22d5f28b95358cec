// SPDX-License-Identifier: GPL-3.0-or-later
// Makes a chain of lines and arcs from corner points with fillet radii.
//
// At a corner with unit directions u in, v out and the angle phi between them, a fillet of radius R
// starts and ends R tan(phi/2) from the corner; its centre lies R away from its start, to the side
// to which the profile turns.
#include "contact/shapes/tool_shape.hpp"

#include <cmath>
#include <fmt/format.h>
#include <stdexcept>

namespace plyform {
namespace {

// Relative rounding of lengths: two fillets may together take up a whole side.
constexpr double rounding = 1e-12;

struct Corner {
  Vec2 start, end, centre;
  double setback = 0.0; ///< mm from the corner to start and end
  int turn = 0;         ///< 0: no fillet
};

using Points = std::vector<std::array<double, 3>>;

Vec2 point(const Points& points, std::size_t i) {
  return {points[i][0], points[i][1]};
}

std::string named(const Points& points, std::size_t i) {
  return fmt::format("profile point {} (r = {:g}, z = {:g})", i, points[i][0], points[i][1]);
}

void check_points(const Points& points) {
  if (points.size() < 2)
    throw std::invalid_argument(
        fmt::format("a profile needs at least two points, got {}", points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& [r, z, fillet] = points[i];
    if (!std::isfinite(r) || !std::isfinite(z) || !std::isfinite(fillet))
      throw std::invalid_argument(
          fmt::format("profile point {}: r, z and fillet radius must be finite numbers", i));
    if (r < 0.0)
      throw std::invalid_argument(named(points, i) +
                                  ": r must be at least 0, the profile is turned about r = 0");
    if (fillet < 0.0)
      throw std::invalid_argument(
          fmt::format("{}: fillet radius {:g} must be at least 0", named(points, i), fillet));
    if (i > 0 && point(points, i) == point(points, i - 1))
      throw std::invalid_argument(named(points, i) +
                                  " repeats the point before it: leave one of them out");
    if (fillet > 0.0 && (i == 0 || i + 1 == points.size()))
      throw std::invalid_argument(
          fmt::format("{}: the end of a profile has no corner for its fillet radius {:g} to "
                      "round; make it 0",
                      named(points, i), fillet));
  }
}

Corner round_corner(const Points& points, std::size_t i) {
  const Vec2 p = point(points, i);
  Corner corner{p, p, p};
  const double radius = points[i][2];
  if (radius == 0.0) return corner;
  const Vec2 u = (p - point(points, i - 1)).normalized();
  const Vec2 v = (point(points, i + 1) - p).normalized();
  const double sine = u.x() * v.y() - u.y() * v.x(), cosine = u.dot(v);
  if (std::abs(sine) < rounding && cosine > 0.0) return corner; // no corner
  if (std::abs(sine) < rounding)
    throw std::invalid_argument(named(points, i) +
                                ": the profile turns straight back, no fillet fits there");
  corner.turn = sine > 0.0 ? 1 : -1;
  corner.setback = radius * std::tan(0.5 * std::atan2(std::abs(sine), cosine));
  corner.start = p - corner.setback * u;
  corner.end = p + corner.setback * v;
  corner.centre = corner.start + corner.turn * radius * Vec2(-u.y(), u.x());
  return corner;
}

} // namespace

RevolvedProfile make_profile(const std::vector<std::array<double, 3>>& points) {
  check_points(points);
  std::vector<Corner> corners(points.size());
  corners.front().end = point(points, 0);
  corners.back().start = point(points, points.size() - 1);
  for (std::size_t i = 1; i + 1 < points.size(); ++i)
    corners[i] = round_corner(points, i);

  RevolvedProfile profile;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const double side = (point(points, i + 1) - point(points, i)).norm();
    const double needed = corners[i].setback + corners[i + 1].setback;
    if (needed > side * (1.0 + rounding)) {
      const std::size_t at = corners[i].setback > corners[i + 1].setback ? i : i + 1;
      throw std::invalid_argument(fmt::format(
          "{}: its fillet radius {:g} does not fit: the fillets on the side from point {} to "
          "point {} take {:g} mm of its {:g} mm; make the fillet smaller or the side longer",
          named(points, at), points[at][2], i, i + 1, needed, side));
    }
    if (side - needed > side * rounding)
      profile.segments.push_back(
          {ProfileSegment::Kind::line, corners[i].end, corners[i + 1].start});
    else
      corners[i + 1].start = corners[i].end; // two fillets meet: one and the same point
    if (corners[i + 1].turn != 0)
      profile.segments.push_back({ProfileSegment::Kind::arc, corners[i + 1].start,
                                  corners[i + 1].end, corners[i + 1].centre, corners[i + 1].turn});
  }
  return profile;
}

} // namespace plyform
