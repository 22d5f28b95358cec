// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/shapes/self_meeting.hpp"

#include "contact/shapes/profile.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

namespace plyform {
namespace {

constexpr double one_place = 1e-9; // of the profile's size: less is rounding
// Likewise, of where two that touch at their common end seem to meet: a root of rounding.
constexpr double beside_end = 1e-6;

double turn_of(const Vec2& u, const Vec2& v) {
  return u.x() * v.y() - u.y() * v.x();
}

using Rectangle = Eigen::AlignedBox2d;

Rectangle rectangle_of(const ProfileSegment& s) {
  Rectangle box(s.a);
  box.extend(s.b);
  if (s.kind == ProfileSegment::Kind::line) return box;
  const double radius =
      (s.a - s.centre).norm(); // of the whole circle: more than needed does no harm
  box.extend(s.centre - Vec2::Constant(radius));
  box.extend(s.centre + Vec2::Constant(radius));
  return box;
}

/// Whether p, which lies on the line or circle of a segment, lies between its ends, with room.
bool lies_between(const ProfileSegment& s, const Vec2& p, double room) {
  if ((p - s.a).norm() <= room || (p - s.b).norm() <= room) return true;
  if (s.kind == ProfileSegment::Kind::line) {
    const Vec2 along = s.b - s.a;
    const double share = along.dot(p - s.a) / along.squaredNorm();
    return share >= 0.0 && share <= 1.0;
  }
  const Vec2 from = s.a - s.centre, to = p - s.centre;
  double turned = s.turn * std::atan2(turn_of(from, to), from.dot(to));
  if (turned < 0.0) turned += 2.0 * std::numbers::pi;
  return turned <= sweep(s);
}

using Places = std::vector<Vec2>;

Places ends_of(const ProfileSegment& s, const ProfileSegment& t) {
  return {s.a, s.b, t.a, t.b};
}

Places of_lines(const ProfileSegment& s, const ProfileSegment& t, double room) {
  const Vec2 u = s.b - s.a, v = t.b - t.a;
  const double turn = turn_of(u, v), parallel = one_place * u.norm() * v.norm();
  if (std::abs(turn) > parallel) return {s.a + turn_of(t.a - s.a, v) / turn * u};
  if (std::abs(turn_of(u, t.a - s.a)) > room * u.norm()) return {};
  return ends_of(s, t);
}

Places of_line_and_circle(const ProfileSegment& line, const ProfileSegment& arc, double room) {
  const Vec2 along = (line.b - line.a).normalized();
  const Vec2 foot = line.a + along.dot(arc.centre - line.a) * along;
  const double radius = (arc.a - arc.centre).norm(), away = (foot - arc.centre).norm();
  if (away > radius + room) return {};
  const double half = std::sqrt(std::max(radius * radius - away * away, 0.0));
  return {foot - half * along, foot + half * along};
}

Places of_circles(const ProfileSegment& s, const ProfileSegment& t, double room) {
  const Vec2 apart = t.centre - s.centre;
  const double d = apart.norm(), r = (s.a - s.centre).norm(), q = (t.a - t.centre).norm();
  if (d <= room) return std::abs(r - q) <= room ? ends_of(s, t) : Places{};
  if (d > r + q + room || d < std::abs(r - q) - room) return {};
  const double along = 0.5 * (d + (r - q) * (r + q) / d);
  const double half = std::sqrt(std::max(r * r - along * along, 0.0));
  const Vec2 u = apart / d, across(-u.y(), u.x());
  return {s.centre + along * u - half * across, s.centre + along * u + half * across};
}

/// Where the lines or circles of two segments meet; where they are one, ends of both.
Places meetings(const ProfileSegment& s, const ProfileSegment& t, double room) {
  const bool first = s.kind == ProfileSegment::Kind::line,
             second = t.kind == ProfileSegment::Kind::line;
  if (first && second) return of_lines(s, t, room);
  if (first != second)
    return first ? of_line_and_circle(s, t, room) : of_line_and_circle(t, s, room);
  return of_circles(s, t, room);
}

double way_along(const ProfileSegment& s) {
  return s.kind == ProfileSegment::Kind::line ? (s.b - s.a).norm()
                                              : sweep(s) * (s.a - s.centre).norm();
}

/// A profile with what is asked of it again and again.
struct Walk {
  const Profile& profile;
  double room = 0.0;            ///< mm, of rounding
  std::vector<double> way{0.0}; ///< mm, to the start of each segment, and to the end
  std::vector<Rectangle> boxes{};

  explicit Walk(const Profile& p) : profile(p) {
    Rectangle all;
    for (const ProfileSegment& s : p) {
      boxes.push_back(rectangle_of(s));
      way.push_back(way.back() + way_along(s));
      all.extend(boxes.back());
    }
    room = one_place * all.diagonal().norm();
  }

  /// Whether nothing but rounding lies between two segments, on one way round or the other.
  bool follow(std::size_t i, std::size_t j) const {
    return way[j] - way[i + 1] <= room ||
           (is_ring(profile) && way[i] + way.back() - way[j + 1] <= room);
  }

  std::optional<Vec2> meeting(std::size_t i, std::size_t j) const {
    const auto &s = profile[i], &t = profile[j];
    if (way_along(s) <= room || way_along(t) <= room) return std::nullopt;
    const double beside = follow(i, j) ? beside_end / one_place * room : -1.0;
    for (const Vec2& p : meetings(s, t, room)) {
      const auto ends = ends_of(s, t);
      if (std::any_of(ends.begin(), ends.end(),
                      [&](const Vec2& end) { return (p - end).norm() <= beside; }))
        continue;
      if (lies_between(s, p, room) && lies_between(t, p, room)) return p;
    }
    return std::nullopt;
  }
};

} // namespace

std::optional<Vec2> self_meeting(const Profile& profile) {
  const Walk walk(profile);
  Rectangle all;
  for (const Rectangle& box : walk.boxes)
    all.extend(box);
  const Eigen::Index axis = all.sizes().x() >= all.sizes().y() ? 0 : 1;
  std::vector<std::size_t> order(profile.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return walk.boxes[a].min()[axis] < walk.boxes[b].min()[axis];
  });
  std::optional<Vec2> found;
  std::pair<std::size_t, std::size_t> first(profile.size(), 0);
  for (std::size_t k = 0; k < order.size(); ++k)
    for (std::size_t l = k + 1; l < order.size(); ++l) {
      const Rectangle &one = walk.boxes[order[k]], &other = walk.boxes[order[l]];
      if (other.min()[axis] > one.max()[axis] + walk.room) break;
      const auto pair = std::minmax(order[k], order[l]);
      const std::pair<std::size_t, std::size_t> numbers(pair.first, pair.second);
      if (numbers > first || one.exteriorDistance(other) > walk.room) continue;
      if (const auto place = walk.meeting(numbers.first, numbers.second))
        found = place, first = numbers;
    }
  return found;
}

} // namespace plyform
