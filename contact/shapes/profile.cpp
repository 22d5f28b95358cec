// SPDX-License-Identifier: GPL-3.0-or-later
// Signed distance to a chain of lines and arcs in a plane, written for (r, z).
//
// Symbols: q point, a b ends of a segment, c centre and R radius of an arc (mm), t unit
// tangent in walking direction, n = (-t_z, t_r) its left normal, which points to the free side.
//   inside a line:   s = n . (q - a)                                              (1)
//   inside an arc:   s = turn (R - |q - c|)                                       (2)
//   at a vertex v:   s = sign(m . (q - v)) |q - v|,  m = n_before + n_after       (3)
// (3) is the pseudo-normal of Baerentzen and Aanaes (IEEE TVCG 11, 2005) in two dimensions: both
// segments that share v give the same answer. At an end m is the only normal there is; that is also
// right at a tip on the axis, as every point has r >= 0.
#include "contact/shapes/profile.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace plyform {
namespace {

// Nearer to a vertex than this (mm) the direction to it is mostly rounding (coordinates of 1 m
// carry 1e-13 mm), and the pseudo-normal serves as normal.
constexpr double vertex_radius = 1e-9;

enum class Feature { interior, start, end };

struct Nearest {
  double distance2;
  Feature feature;
};

double cross(const Vec2& u, const Vec2& v) {
  return u.x() * v.y() - u.y() * v.x();
}

Vec2 left(const Vec2& t) {
  return {-t.y(), t.x()};
}

Nearest nearest_end(const SegmentForm& s, const Vec2& q) {
  const double da = (q - s.a).squaredNorm(), db = (q - s.b).squaredNorm();
  return da <= db ? Nearest{da, Feature::start} : Nearest{db, Feature::end};
}

/// Whether the ray from the arc's centre along u meets the arc.
bool spans(const SegmentForm& s, const Vec2& u) {
  const double after_a = cross(s.to_a, u), before_b = cross(u, s.to_b);
  if (!s.past_half_turn) return after_a >= 0.0 && before_b >= 0.0;
  return s.full_circle || !(before_b < 0.0 && after_a < 0.0);
}

Nearest nearest_on(const SegmentForm& s, const Vec2& q) {
  const Vec2 u = q - s.from;
  if (s.kind == ProfileSegment::Kind::line) {
    const double along = u.dot(s.tangent);
    if (along <= 0.0) return {u.squaredNorm(), Feature::start};
    if (along >= s.extent) return {(q - s.b).squaredNorm(), Feature::end};
    const double across = cross(s.tangent, u);
    return {across * across, Feature::interior};
  }
  if (!spans(s, u)) return nearest_end(s, q);
  const double gap = u.norm() - s.extent;
  return {gap * gap, Feature::interior};
}

SectionPoint inside_segment(const SegmentForm& s, const Vec2& q) {
  const Vec2 u = q - s.from;
  if (s.kind == ProfileSegment::Kind::line) {
    const Vec2 n = left(s.tangent);
    return {n.dot(u), n}; // (1)
  }
  const double rho = u.norm();
  // At the centre every point of the arc is the closest: take its start.
  const Vec2 inward = rho > vertex_radius ? Vec2(u * (-s.turn / rho)) : Vec2(-s.to_a.normalized());
  return {s.turn * (s.extent - rho), inward}; // (2)
}

/// m of (3), not normalised, for the vertex at the start or end of segment i.
Vec2 pseudo_normal(const Profile& profile, std::size_t i, Feature feature) {
  const Profile& s = profile;
  const bool at_start = feature == Feature::start;
  const Vec2 own = tangent(s[i], at_start ? 0 : 1);
  Vec2 before = own, after = own;
  const bool last_link = at_start ? i == 0 : i + 1 == s.size();
  if (!last_link)
    (at_start ? before : after) = at_start ? tangent(s[i - 1], 1) : tangent(s[i + 1], 0);
  else if (is_ring(profile))
    (at_start ? before : after) = at_start ? tangent(s.back(), 1) : tangent(s.front(), 0);
  const Vec2 m = left(before) + left(after);
  // A blade, where the profile turns straight back and the normals cancel: every point that is
  // nearest to this vertex lies ahead of it.
  return m.squaredNorm() > 1e-12 ? m : Vec2(before - after);
}

SectionPoint at_vertex(const Profile& profile, std::size_t i, Feature feature, const Vec2& q) {
  const ProfileSegment& s = profile[i];
  const Vec2 d = q - (feature == Feature::start ? s.a : s.b);
  const Vec2 m = pseudo_normal(profile, i, feature);
  const double length = d.norm(), sign = m.dot(d) < 0.0 ? -1.0 : 1.0; // (3)
  if (length <= vertex_radius) return {sign * length, m.normalized()};
  return {sign * length, d * (sign / length)};
}

/// section_distance, with form_of(i) the SegmentForm of segment i.
template <class FormOf>
SectionPoint distance_to_section(const Profile& profile, const FormOf& form_of, const Vec2& q) {
  Nearest best{std::numeric_limits<double>::infinity(), Feature::start};
  std::size_t at = 0;
  for (std::size_t i = 0; i < profile.size(); ++i) {
    const Nearest here = nearest_on(form_of(i), q);
    if (here.distance2 < best.distance2) {
      best = here;
      at = i;
    }
  }
  if (best.feature == Feature::interior) return inside_segment(form_of(at), q);
  return at_vertex(profile, at, best.feature, q);
}

} // namespace

SegmentForm::SegmentForm(const ProfileSegment& s)
    : kind(s.kind), full_circle(s.a == s.b), turn(s.turn), from(s.a), a(s.a), b(s.b) {
  if (kind == ProfileSegment::Kind::line) {
    past_half_turn = false;
    tangent = s.b - s.a;
    extent = tangent.norm();
    if (extent > 0.0) tangent /= extent;
    return;
  }
  from = s.centre;
  extent = (s.a - s.centre).norm();
  to_a = turn * (s.a - s.centre);
  to_b = turn * (s.b - s.centre);
  past_half_turn = full_circle || turn * cross(to_a, to_b) < 0.0;
}

SectionField::SectionField(const Profile& profile)
    : profile_(&profile), forms_(profile.begin(), profile.end()) {}

SectionPoint SectionField::distance(const Vec2& q) const {
  const auto form_of = [this](std::size_t i) -> const SegmentForm& { return forms_[i]; };
  return distance_to_section(*profile_, form_of, q);
}

SectionPoint section_distance(const Profile& profile, const Vec2& q) {
  const auto form_of = [&](std::size_t i) { return SegmentForm(profile[i]); };
  return distance_to_section(profile, form_of, q);
}

bool is_ring(const Profile& profile) {
  return profile.front().a == profile.back().b;
}

bool is_closed(const RevolvedProfile& profile) {
  const Profile& s = profile.segments;
  return is_ring(s) || (s.front().a.x() <= 0.0 && s.back().b.x() <= 0.0);
}

Vec2 tangent(const ProfileSegment& s, int end) {
  if (s.kind == ProfileSegment::Kind::line) return (s.b - s.a).normalized();
  const double turn = s.turn;
  return turn * left(((end == 0 ? s.a : s.b) - s.centre).normalized());
}

double sweep(const ProfileSegment& s) {
  if (s.a == s.b) return 2.0 * std::numbers::pi;
  const Vec2 ca = s.a - s.centre, cb = s.b - s.centre;
  const double turn = s.turn, angle = std::atan2(turn * cross(ca, cb), ca.dot(cb));
  return angle > 0.0 ? angle : angle + 2.0 * std::numbers::pi;
}

} // namespace plyform
