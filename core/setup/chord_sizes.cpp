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
    SurfacePoint found =
        signed_distance(tool_.shape, tool_.rotation.transpose() * (x - place_), hint_);
    found.normal = tool_.rotation * found.normal;
    return found;
  }

  /// Whether c of (1) is more than `limit` (mm) at the place p with normal n; above: o, mm.
  bool deeper(const Vec3& p, const Vec3& n, double above, double size, double limit) {
    const Vec3 a = n.unitOrthogonal(), b = n.cross(a);
    for (int k = 0; k < chord_directions; ++k) {
      const double turn = k * std::numbers::pi / chord_directions;
      const Vec3 half = 0.5 * chord_of_size * size * (std::cos(turn) * a + std::sin(turn) * b);
      const double middle = 0.5 * (at(p + half).distance + at(p - half).distance);
      if (std::abs(middle - above) > limit) return true;
    }
    return false;
  }

private:
  const Tool& tool_;
  Vec3 place_; ///< mm, of the tool's origin
  std::vector<Vec3> draws_;
  SurfaceHint hint_;
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

/// The largest size between least and most (mm) whose chord is `limit` (mm) deep at most.
double size_of_depth(ChordDepths& chords, const Vec3& p, const Vec3& n, double above, double limit,
                     double least, double most) {
  if (!chords.deeper(p, n, above, most, limit)) return most;
  least = std::min(least, most);
  if (chords.deeper(p, n, above, least, limit)) return least;
  while (most > size_grain * least) {
    const double between = std::sqrt(least * most);
    (chords.deeper(p, n, above, between, limit) ? most : least) = between;
  }
  return least;
}

void lower_under(ChordDepths chords, const PlyFrame& ply, double thickness, const Offsets& offsets,
                 const ChordLimits& limits, AskedSizes& sizes) {
  const double reach = reach_of_contact * thickness;
  for (std::size_t t = 0; t < ply.triangles.size(); ++t) {
    const Triangle& n = ply.triangles[t];
    const Vec3 &a = ply.x[at(n[0])], &b = ply.x[at(n[1])], &c = ply.x[at(n[2])];
    const Vec3 up = (b - a).cross(c - a);
    const double side = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    const double highest = std::max(offsets.below, offsets.above) + reach;
    if (chords.at((a + b + c) / 3.0).distance > highest + side) continue;
    for (std::size_t k = 0; k < asked_places.size(); ++k) {
      const auto& w = asked_places[k];
      const Vec3 x = w[0] * a + w[1] * b + w[2] * c;
      const SurfacePoint found = chords.at(x);
      const double above = found.normal.dot(up) > 0.0 ? offsets.below : offsets.above;
      if (found.distance > above + reach) continue;
      const bool aside = !chords.drawn_over(found.normal);
      if (aside && found.distance > offsets.own - cut_aside * thickness) continue;
      const double depth = aside                 ? limits.depth_aside
                           : above > offsets.own ? limits.depth_between
                                                 : limits.depth;
      const Vec3 p = x - (found.distance - above) * found.normal;
      sizes[t][k] = size_of_depth(chords, p, found.normal, above, depth * thickness,
                                  limits.smallest * thickness, sizes[t][k]);
    }
  }
}

} // namespace

void lower_to_chords(const Case& data, const Frame& state, const ChordLimits& limits,
                     std::vector<AskedSizes>& sizes) {
  const std::vector<Offsets> offsets = offsets_of(data);
  for (std::size_t p = 0; p < state.plies.size(); ++p)
    for (std::size_t t = 0; t < data.tools.size(); ++t)
      lower_under(ChordDepths(data, t, state.tools[t].displacement), state.plies[p],
                  thickness_of(data, p), offsets[p], limits, sizes[p]);
}

} // namespace plyform
