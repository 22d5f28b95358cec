// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/setup/first_contact.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace plyform {
namespace {

constexpr int divisions = 6;              // of a ply: into 64 x 64 boxes
constexpr double coarse = 1.0 / 32.0;     // of such a box: how far all starts go down
constexpr double finest = 1e-7;           // mm; d is off by its square over a radius
constexpr std::size_t starts = 4;         // places from which one goes downhill, of either kind
constexpr std::size_t most_points = 5000; // of a tool's surface

/// A place in a ply's plane with the tool's distance.
struct Spot {
  Vec2 at = Vec2::Zero();
  double distance = std::numeric_limits<double>::infinity();
};

/// The nearest place of one ply to a tool that stands still.
class NearestSpot {
public:
  NearestSpot(const ToolAhead& tool, const Vec3& shift, const FlatPly& ply)
      : tool_(tool), shift_(shift), ply_(ply) {}

  /// Without a look at places that are no nearer than `interest`.
  Spot find(double interest) {
    best_.distance = interest;
    look_in(ply_.bounds.center(), 0.5 * ply_.bounds.sizes(), 0);
    look_at_points();
    const std::vector<Spot> found = std::move(found_);
    std::vector<Spot> low;
    for (const Spot& spot : found)
      low.push_back(go_downhill(spot, coarse * step(), step()));
    std::sort(low.begin(), low.end(),
              [](const Spot& a, const Spot& b) { return a.distance < b.distance; });
    go_down_to_the_end(low);
    return best_;
  }

  /// mm, d at a place of the mid-surface.
  double distance(const Vec2& p) {
    return tool_distance(tool_.tool, shift_, Vec3(p.x(), p.y(), ply_.z), hint_);
  }

private:
  double step() const { return ply_.bounds.diagonal().norm() / (1 << divisions); }

  /// Keeps the nearest few.
  void keep(const Spot& spot, std::vector<Spot>& spots) const {
    const auto place =
        std::upper_bound(spots.begin(), spots.end(), spot,
                         [](const Spot& a, const Spot& b) { return a.distance < b.distance; });
    spots.insert(place, spot);
    if (spots.size() > starts) spots.pop_back();
  }

  void look_in(const Vec2& middle, const Vec2& half, int depth) {
    const Spot spot{middle, distance(middle)};
    if (spot.distance - half.norm() >= best_.distance) return;
    if (spot.distance < best_.distance && covers(ply_, middle)) best_ = spot;
    if (depth == divisions) {
      keep(spot, found_);
      return;
    }
    const Vec2 quarter = 0.5 * half;
    for (const double x : {-1.0, 1.0})
      for (const double y : {-1.0, 1.0})
        look_in(middle + Vec2(x * quarter.x(), y * quarter.y()), quarter, depth + 1);
  }

  /// Corners of the tool that stand nearest above or below the ply: a tip may be narrow.
  void look_at_points() {
    std::vector<Spot> nearest;
    const std::size_t stride = std::max<std::size_t>(1, tool_.points.size() / most_points);
    for (std::size_t i = 0; i < tool_.points.size(); i += stride) {
      const Vec3 x = tool_.points[i] + shift_;
      const Spot spot{x.head<2>(), std::abs(x.z() - ply_.z)};
      if (nearest.size() == starts && spot.distance >= nearest.back().distance) continue;
      if (covers(ply_, spot.at)) keep(spot, nearest);
    }
    for (const Spot& spot : nearest)
      found_.push_back({spot.at, distance(spot.at)});
  }

  /// From each of these places, the nearest first, that may be nearer than what is known and is
  /// not where one of them was.
  void go_down_to_the_end(const std::vector<Spot>& low) {
    const double near = 2.0 * coarse * step();
    for (auto spot = low.begin(); spot != low.end(); ++spot) {
      if (spot->distance - near >= best_.distance) return;
      const auto is_same = [&](const Spot& other) { return (other.at - spot->at).norm() < near; };
      if (std::any_of(low.begin(), spot, is_same)) continue;
      const Spot end = go_downhill(*spot, finest, near);
      if (end.distance < best_.distance) best_ = end;
    }
  }

  /// Compass search: to the best of eight neighbours, or nearer ones where none is better, with
  /// steps (mm) from `reach` down to `end`.
  Spot go_downhill(Spot spot, double end, double reach) {
    constexpr int most_steps = 400;
    if (!covers(ply_, spot.at)) spot = enter(spot);
    if (!std::isfinite(spot.distance)) return spot;
    for (int i = 0; i < most_steps && reach > end; ++i) {
      const Spot next = best_around(spot, reach);
      if (next.distance < spot.distance)
        spot = next;
      else
        reach *= 0.5;
    }
    return spot;
  }

  /// The ply's place nearest to a spot beside it: a box on its rim has its middle there.
  Spot enter(const Spot& spot) {
    const Spot inside = best_around({spot.at, std::numeric_limits<double>::infinity()}, step());
    if (std::isfinite(inside.distance)) return inside;
    return best_around({spot.at, std::numeric_limits<double>::infinity()}, 0.5 * step());
  }

  Spot best_around(const Spot& spot, double reach) {
    constexpr double diagonal = std::numbers::sqrt2 / 2.0;
    constexpr std::array<std::array<double, 2>, 8> ways = {{{1.0, 0.0},
                                                            {diagonal, diagonal},
                                                            {0.0, 1.0},
                                                            {-diagonal, diagonal},
                                                            {-1.0, 0.0},
                                                            {-diagonal, -diagonal},
                                                            {0.0, -1.0},
                                                            {diagonal, -diagonal}}};
    Spot best = spot;
    for (const auto& [x, y] : ways) {
      const Vec2 p = spot.at + reach * Vec2(x, y);
      const double d = distance(p);
      if (d < best.distance && covers(ply_, p)) best = {p, d};
    }
    return best;
  }

  const ToolAhead& tool_;
  const Vec3& shift_;
  const FlatPly& ply_;
  SurfaceHint hint_;
  Spot best_;
  std::vector<Spot> found_;
};

/// On the face of the ply towards the tool.
Vec3 face_at(const ToolAhead& tool, const Vec3& shift, const FlatPly& ply, const Vec2& p) {
  SurfaceHint hint;
  const double above = tool_distance(tool.tool, shift, Vec3(p.x(), p.y(), ply.z + ply.half), hint);
  const double below = tool_distance(tool.tool, shift, Vec3(p.x(), p.y(), ply.z - ply.half), hint);
  return {p.x(), p.y(), ply.z + (above <= below ? ply.half : -ply.half)};
}

/// nearest_ply of one ply; infinite if it is no nearer than `interest`.
PlyGap gap_of(const ToolAhead& tool, const Vec3& shift, const std::vector<FlatPly>& plies,
              std::size_t ply, double interest) {
  const FlatPly& flat = plies[ply];
  const Spot spot = NearestSpot(tool, shift, flat).find(interest + flat.half);
  PlyGap found;
  if (!(spot.distance - flat.half < interest)) return found;
  const double gap = spot.distance - flat.half;
  constexpr double rounding = 1e-9; // mm
  return {std::abs(gap) < rounding ? 0.0 : gap, ply, face_at(tool, shift, flat, spot.at)};
}

} // namespace

PlyGap nearest_ply(const ToolAhead& tool, const Vec3& shift, const std::vector<FlatPly>& plies) {
  std::vector<std::pair<double, std::size_t>> order; // the nearest first: it spares the others
  SurfaceHint hint;
  for (std::size_t i = 0; i < plies.size(); ++i) {
    const Vec2 middle = plies[i].bounds.center();
    const Vec3 p(middle.x(), middle.y(), plies[i].z);
    order.emplace_back(tool_distance(tool.tool, shift, p, hint), i);
  }
  std::sort(order.begin(), order.end());
  PlyGap least;
  for (const auto& [distance, i] : order)
    if (const PlyGap found = gap_of(tool, shift, plies, i, least.gap); found.gap < least.gap)
      least = found;
  return least;
}

std::optional<FirstContact> first_contact(const ToolAhead& tool, double stroke, const PlyGap& start,
                                          const std::vector<FlatPly>& plies) {
  constexpr double touch = 1e-6, little = 0.05, cosine = 0.1; // mm, mm of the way on
  constexpr double infinite = std::numeric_limits<double>::infinity();
  constexpr int most_steps = 100;
  const Vec3& way = tool.tool.direction;
  double travel = 0.0;
  bool corrected = false;
  PlyGap now = start;
  for (int i = 0; i < most_steps && std::isfinite(now.gap); ++i) {
    if (now.gap > touch) {
      travel += now.gap;
    } else if (now.gap < -touch && travel > 0.0 && !corrected) { // the gap before was not the least
      travel = std::max(0.0, travel + now.gap);
      corrected = true;
    } else {
      const double next = gap_of(tool, (travel + little) * way, plies, now.ply, infinite).gap;
      if (next - now.gap <= cosine * little) return FirstContact{travel, now.ply, now.where, {}};
      travel += little;
    }
    if (travel > stroke + touch) return std::nullopt;
    now = nearest_ply(tool, travel * way, plies);
  }
  return std::nullopt;
}

} // namespace plyform
