// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/setup/chord_sizes.hpp"

#include "core/model/reach_ahead.hpp"
#include "core/setup/draws.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace plyform {
namespace {

constexpr double chord_of_size = 1.7;    // L / h of (1)
constexpr int chord_directions = 4;      // of e in (1), over half a turn
constexpr double reach_of_contact = 1.5; // thicknesses above its place: a ply about to touch
constexpr double cut_aside = 0.3;   // thicknesses: an edge that cuts into the scout is not left
constexpr double size_grain = 1.05; // sizes are found to this factor

double thickness_of(const Case& data, std::size_t ply) {
  return data.fabrics[at(data.plies[ply].fabric)].thickness;
}

/// A tool at one state, asked for chords of one ply.
class ChordDepths {
public:
  ChordDepths(const Case& data, std::size_t tool, const Vec3& displacement)
      : tool_(data.tools[tool]), place_(data.tools[tool].position + displacement),
        draws_(draws_on(data, tool)) {}

  /// Whether plies are drawn over a place with this normal.
  bool drawn_over(const Vec3& normal) const { return draws_over(draws_, normal); }

  SurfacePoint at(const Vec3& x) {
    SurfacePoint found = asked(x, hint_);
    found.normal = tool_.rotation * found.normal;
    return found;
  }

  /// Whether x is farther from the tool than `far`, mm; asked only if not known from `last`.
  bool beyond(const Vec3& x, double far, LastDistance& last) {
    const Vec3 here = seen_from_tool(x);
    if (!(last.at_least(here) > far)) last = {here, asked(x, hint_).distance};
    return last.at_least(here) > far;
  }

  /// c of (1) at the place p with normal n, mm, or some value above `enough` if it is; above: o,
  /// mm.
  double depth(const Vec3& p, const Vec3& n, double above, double size, double enough) {
    const Vec3 a = n.unitOrthogonal(), b = n.cross(a);
    double deepest = 0.0;
    for (int k = 0; k < chord_directions && deepest <= enough; ++k) {
      const double turn = k * std::numbers::pi / chord_directions;
      const Vec3 half = 0.5 * chord_of_size * size * (std::cos(turn) * a + std::sin(turn) * b);
      SurfaceHint &one = ends_[static_cast<std::size_t>(2 * k)],
                  &other = ends_[static_cast<std::size_t>(2 * k + 1)];
      const double middle = 0.5 * (asked(p + half, one).distance + asked(p - half, other).distance);
      deepest = std::max(deepest, std::abs(middle - above));
    }
    return deepest;
  }

  Vec3 seen_from_tool(const Vec3& p) const { return p - place_; }

private:
  SurfacePoint asked(const Vec3& x, SurfaceHint& hint) const {
    return signed_distance(tool_.shape, tool_.rotation.transpose() * (x - place_), hint);
  }

  const Tool& tool_;
  Vec3 place_; ///< mm, of the tool's origin
  std::vector<Vec3> draws_;
  SurfaceHint hint_;
  std::array<SurfaceHint, 2 * chord_directions> ends_; ///< near what is asked next of each end
};

/// Half of a ply's thickness (`own`), and with it the plies of its stack below and above it, mm: o
/// of tools on either side.
struct Offsets {
  double own = 0.0, below = 0.0, above = 0.0;
};

std::vector<Offsets> offsets_of(const Case& data) {
  const std::vector<int> stack = reach_ahead(data).stack;
  std::vector<Offsets> offsets(data.plies.size());
  for (std::size_t p = 0; p < offsets.size(); ++p) {
    const double own = 0.5 * thickness_of(data, p);
    offsets[p] = {own, own, own};
    for (std::size_t q = 0; q < offsets.size(); ++q)
      if (q != p && stack[q] == stack[p])
        (q < p ? offsets[p].below : offsets[p].above) += thickness_of(data, q);
  }
  return offsets;
}

/// What a place of a ply asks of a tool: no deeper than `limit`, mm, at o = `above`.
struct Asked {
  Vec3 p, n;
  double above, limit;
};

/// The largest size between least and most (mm) whose chord is no deeper than is asked. seen: what
/// this place was found to be at an earlier state, and is now. As the distance to a tool changes by
/// no more than the way from place to place, a place that has hardly moved asks for no less.
double size_of_depth(ChordDepths& chords, const Asked& asked, double least, double most,
                     SeenChord& seen) {
  const Vec3 here = chords.seen_from_tool(asked.p);
  const double way =
      (here - seen.p).norm() + 0.5 * chord_of_size * most * (asked.n - seen.n).norm();
  if (seen.size == most && seen.above == asked.above && seen.depth + way <= asked.limit)
    return most;
  const auto depth = [&](double size) {
    return chords.depth(asked.p, asked.n, asked.above, size, asked.limit);
  };
  const double there = depth(most);
  if (there <= asked.limit) {
    seen = {here, asked.n, asked.above, most, there};
    return most;
  }
  least = std::min(least, most);
  if (depth(least) > asked.limit) return least;
  while (most > size_grain * least) {
    const double between = std::sqrt(least * most);
    (depth(between) > asked.limit ? most : least) = between;
  }
  return least;
}

void lower_under(ChordDepths chords, const PlyFrame& ply, double thickness, const Offsets& offsets,
                 const ChordLimits& limits, AskedSizes& sizes, SeenByTool& seen) {
  const double reach = reach_of_contact * thickness;
  const double highest = std::max(offsets.below, offsets.above) + reach;
  const std::size_t places = ply.triangles.size() * asked_places.size();
  seen.middles.resize(ply.triangles.size());
  seen.places.resize(places);
  seen.chords.resize(places);
  for (std::size_t t = 0; t < ply.triangles.size(); ++t) {
    const Triangle& n = ply.triangles[t];
    const Vec3 &a = ply.x[at(n[0])], &b = ply.x[at(n[1])], &c = ply.x[at(n[2])];
    const Vec3 up = (b - a).cross(c - a);
    const double side = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    if (chords.beyond((a + b + c) / 3.0, highest + side, seen.middles[t])) continue;
    for (std::size_t k = 0; k < asked_places.size(); ++k) {
      const auto& w = asked_places[k];
      const std::size_t place = t * asked_places.size() + k;
      const Vec3 x = w[0] * a + w[1] * b + w[2] * c;
      if (seen.places[place].at_least(chords.seen_from_tool(x)) > highest) continue;
      const SurfacePoint found = chords.at(x);
      seen.places[place] = {chords.seen_from_tool(x), found.distance};
      const double above = found.normal.dot(up) > 0.0 ? offsets.below : offsets.above;
      if (found.distance > above + reach) continue;
      const bool aside = !chords.drawn_over(found.normal);
      if (aside && found.distance > offsets.own - cut_aside * thickness) continue;
      const double depth = aside                 ? limits.depth_aside
                           : above > offsets.own ? limits.depth_between
                                                 : limits.depth;
      const Vec3 p = x - (found.distance - above) * found.normal;
      sizes[t][k] = size_of_depth(chords, {p, found.normal, above, depth * thickness},
                                  limits.smallest * thickness, sizes[t][k], seen.chords[place]);
    }
  }
}

} // namespace

void ChordSizes::lower(const Frame& state, std::vector<AskedSizes>& sizes) {
  const std::vector<Offsets> offsets = offsets_of(data_);
  seen_.resize(state.plies.size() * data_.tools.size());
  for (std::size_t p = 0; p < state.plies.size(); ++p)
    for (std::size_t t = 0; t < data_.tools.size(); ++t)
      lower_under(ChordDepths(data_, t, state.tools[t].displacement), state.plies[p],
                  thickness_of(data_, p), offsets[p], limits_, sizes[p],
                  seen_[p * data_.tools.size() + t]);
}

} // namespace plyform
