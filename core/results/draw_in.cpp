// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/results/draw_in.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

namespace plyform {
namespace {

using Loop = std::vector<std::int32_t>;

/// The two neighbours of each node along the border, whose edges belong to one triangle each, by
/// ascending node. Nothing if the border meets itself at a node.
std::optional<std::map<std::int32_t, std::pair<std::int32_t, std::int32_t>>>
border_neighbours(const std::vector<Triangle>& triangles, std::size_t nodes) {
  std::vector<std::size_t> begin(nodes + 1, 0); // edges by the lower number of their nodes
  const auto each_edge = [&](const auto& f) {
    for (const Triangle& t : triangles)
      for (std::size_t k = 0; k < 3; ++k) {
        const auto [low, high] = std::minmax(t[k], t[(k + 1) % 3]);
        f(at(low), high);
      }
  };
  each_edge([&](std::size_t low, std::int32_t) { ++begin[low + 1]; });
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<std::int32_t> ends(begin.back());
  std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
  each_edge([&](std::size_t low, std::int32_t high) { ends[next[low]++] = high; });
  std::map<std::int32_t, std::vector<std::int32_t>> beside;
  for (std::size_t low = 0; low < nodes; ++low) {
    const auto first = ends.begin() + static_cast<std::ptrdiff_t>(begin[low]),
               last = ends.begin() + static_cast<std::ptrdiff_t>(begin[low + 1]);
    std::sort(first, last);
    for (auto high = first; high != last;) {
      const auto same = std::find_if(high, last, [&](std::int32_t n) { return n != *high; });
      if (same - high == 1) {
        beside[static_cast<std::int32_t>(low)].push_back(*high);
        beside[*high].push_back(static_cast<std::int32_t>(low));
      }
      high = same;
    }
  }
  std::map<std::int32_t, std::pair<std::int32_t, std::int32_t>> pairs;
  for (const auto& [node, others] : beside) {
    if (others.size() != 2) return std::nullopt;
    pairs[node] = {others[0], others[1]};
  }
  return pairs;
}

double enclosed_area(const PlyFrame& ply, const Loop& loop) {
  double twice = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec3 &a = ply.x0[at(loop[i])], &b = ply.x0[at(loop[(i + 1) % loop.size()])];
    twice += a.x() * b.y() - b.x() * a.y();
  }
  return 0.5 * std::abs(twice);
}

/// Nodes of the outer border in order: of the closed loops of edges that with the largest area.
std::optional<Loop> outer_border(const PlyFrame& ply) {
  auto beside = border_neighbours(ply.triangles, ply.x0.size());
  if (!beside || beside->empty()) return std::nullopt;
  Loop best;
  double best_area = -1.0;
  while (!beside->empty()) {
    Loop loop{beside->begin()->first};
    auto ahead = beside->begin()->second;
    beside->erase(beside->begin());
    for (;;) {
      auto next = beside->find(ahead.first);
      if (next == beside->end()) next = beside->find(ahead.second);
      if (next == beside->end()) break;
      loop.push_back(next->first);
      ahead = next->second;
      beside->erase(next);
    }
    if (const double area = enclosed_area(ply, loop); area > best_area)
      best = std::move(loop), best_area = area;
  }
  return best;
}

/// Draw-in (mm) of one walk; NaN if the middle is not inside the border.
double draw_in_of_walk(const PlyFrame& ply, const Loop& loop, const Vec2& middle, double angle) {
  const Vec2 u(std::cos(angle), std::sin(angle)), side(-u.y(), u.x());
  double nearest = std::numeric_limits<double>::infinity(),
         formed = std::numeric_limits<double>::quiet_NaN();
  int ahead = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const std::size_t a = at(loop[i]), b = at(loop[(i + 1) % loop.size()]);
    const Vec2 from = ply.x0[a].head<2>() - middle, to = ply.x0[b].head<2>() - middle;
    const double across = from.dot(side), following = to.dot(side);
    if ((across < 0.0) == (following < 0.0)) continue; // so that a corner counts once
    const double w = across / (across - following);
    const double met = ((1.0 - w) * from + w * to).dot(u);
    if (met <= 0.0) continue;
    ++ahead;
    if (met >= nearest) continue;
    nearest = met;
    formed = ((1.0 - w) * ply.x[a] + w * ply.x[b]).head<2>().operator-(middle).norm();
  }
  return ahead % 2 == 0 ? std::numeric_limits<double>::quiet_NaN() : nearest - formed;
}

} // namespace

double DrawIn::mean() const {
  return (std::accumulate(yarns.begin(), yarns.end(), 0.0) +
          std::accumulate(bisectors.begin(), bisectors.end(), 0.0)) /
         8.0;
}

double DrawIn::largest() const {
  return std::max(*std::max_element(yarns.begin(), yarns.end()),
                  *std::max_element(bisectors.begin(), bisectors.end()));
}

DrawIn draw_in(const PlyFrame& ply) {
  DrawIn found;
  const double warp = ply.families.empty() ? ply.angle_deg : ply.families[0].angle_deg;
  const double weft = ply.families.size() > 1 ? ply.families[1].angle_deg : warp + 90.0;
  found.yarns_deg = {warp, weft, warp + 180.0, weft + 180.0};
  for (std::size_t k = 0; k < 4; ++k)
    found.bisectors_deg[k] = 0.5 * (warp + weft) + 90.0 * static_cast<double>(k);
  const std::optional<Loop> loop = outer_border(ply);
  if (!loop) {
    found.unknown = "its border meets itself";
    return found;
  }
  Vec2 low = ply.x0.front().head<2>(), high = low;
  for (const Vec3& x : ply.x0)
    low = low.cwiseMin(x.head<2>()), high = high.cwiseMax(x.head<2>());
  const Vec2 middle = 0.5 * (low + high);
  for (std::size_t k = 0; k < 4; ++k) {
    found.yarns[k] = draw_in_of_walk(ply, *loop, middle, degree * found.yarns_deg[k]);
    found.bisectors[k] = draw_in_of_walk(ply, *loop, middle, degree * found.bisectors_deg[k]);
  }
  if (!std::isfinite(found.mean())) found.unknown = "the middle of its bounding box is outside";
  return found;
}

} // namespace plyform
