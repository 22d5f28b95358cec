// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/cut_outline.hpp"

#include "core/mesh/mesher_parts.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

/// A side of a loop, straight or an arc.
struct CutSide {
  Vec2 from, to;
  Vec2 centre = Vec2::Zero();
  int turn = 0; ///< of an arc: +1 anticlockwise, -1

  /// The point at a share of the way.
  Vec2 at(double share) const {
    if (turn == 0) return from + share * (to - from);
    return centre + Eigen::Rotation2Dd(turn * share * sweep(to)) * (from - centre);
  }
  /// Angle (rad) from its begin to a point on it.
  double sweep(const Vec2& p) const { return sweep_of(centre, turn, from, p); }
};

using CutLoop = std::vector<CutSide>;

struct CutLine {
  Vec2 point, normal;
  double grain; ///< mm: what is nearer is on the line

  double off(const Vec2& p) const {
    const double distance = (p - point).dot(normal);
    return std::abs(distance) <= grain ? 0.0 : distance;
  }
  double along(const Vec2& p) const { return (p - point).dot(Vec2(normal.y(), -normal.x())); }
  Vec2 on(const Vec2& p) const { return p - (p - point).dot(normal) * normal; }
};

CutLoop loop_of(const Outline& outline, int hole) {
  const std::vector<Vec2>& corners =
      hole < 0 ? outline.boundary : outline.holes[static_cast<std::size_t>(hole)];
  CutLoop loop;
  for (std::size_t k = 0; k < corners.size(); ++k)
    loop.push_back({corners[k], corners[(k + 1) % corners.size()]});
  for (const OutlineArc& arc : outline.arcs)
    if (arc.hole == hole && arc.side < loop.size())
      loop[arc.side].centre = arc.centre, loop[arc.side].turn = arc.turn;
  return loop;
}

/// mm^2, by straight pieces; positive anticlockwise.
double loop_area(const CutLoop& loop) {
  constexpr int pieces = 8;
  double twice = 0.0;
  for (const CutSide& side : loop)
    for (int i = 0; i < pieces; ++i)
      twice += cross(side.at(i / double{pieces}), side.at((i + 1) / double{pieces}));
  return 0.5 * twice;
}

/// Anticlockwise or not, so that what the outline encloses is to the left.
CutLoop turned(CutLoop loop, bool anticlockwise) {
  if ((loop_area(loop) > 0.0) == anticlockwise) return loop;
  std::reverse(loop.begin(), loop.end());
  for (CutSide& side : loop)
    std::swap(side.from, side.to), side.turn = -side.turn;
  return loop;
}

/// Shares of a side at which it crosses the line, ascending.
std::vector<double> crossings_of(const CutSide& side, const CutLine& line) {
  std::vector<double> shares;
  if (side.turn == 0) {
    const double a = line.off(side.from), b = line.off(side.to);
    if (a * b < 0.0) shares.push_back(a / (a - b));
    return shares;
  }
  const double radius = (side.from - side.centre).norm(),
               off = (side.centre - line.point).dot(line.normal);
  if (!(std::abs(off) < radius)) return shares;
  const Vec2 foot = line.on(side.centre), way(line.normal.y(), -line.normal.x());
  const double half = std::sqrt(radius * radius - off * off), whole = side.sweep(side.to);
  for (const double sign : {-1.0, 1.0}) {
    const Vec2 p = foot + sign * half * way;
    const double share = side.sweep(p) / whole;
    if ((p - side.from).norm() > line.grain && (p - side.to).norm() > line.grain && share < 1.0)
      shares.push_back(share);
  }
  std::sort(shares.begin(), shares.end());
  return shares;
}

/// The sides of a loop, cut where they cross the line.
CutLoop cut_at(const CutLoop& loop, const CutLine& line) {
  CutLoop cut;
  for (const CutSide& side : loop) {
    CutSide left = side;
    for (const double share : crossings_of(side, line)) {
      CutSide piece = left;
      piece.to = left.from = line.on(side.at(share));
      cut.push_back(piece);
    }
    cut.push_back(left);
  }
  return cut;
}

/// Sides one after the other, from the line to the line.
using Chain = std::vector<CutSide>;

/// Sorts the sides of a loop that lie on the side of the normal into chains, or leaves all of it.
void take_inside(const CutLoop& loop, const CutLine& line, std::vector<Chain>& chains,
                 std::vector<CutLoop>& whole) {
  const CutLoop cut = cut_at(loop, line);
  const auto inside = [&](std::size_t k) {
    return line.off(cut[k % cut.size()].at(0.5)) > 0.0 ||
           (line.off(cut[k % cut.size()].at(0.5)) == 0.0 &&
            line.off(cut[k % cut.size()].from) > 0.0);
  };
  std::size_t first = 0;
  while (first < cut.size() && inside(first))
    ++first;
  if (first == cut.size()) return whole.push_back(loop);
  for (std::size_t k = first; k < first + cut.size(); ++k) {
    if (!inside(k)) continue;
    if (!inside(k + cut.size() - 1)) chains.emplace_back();
    chains.back().push_back(cut[k % cut.size()]);
  }
}

/// Joins chains along the line, in the direction that has the inside to its left.
std::vector<CutLoop> join_chains(std::vector<Chain> chains, const CutLine& line) {
  std::vector<CutLoop> loops;
  while (!chains.empty()) {
    CutLoop loop = std::move(chains.back());
    chains.pop_back();
    for (;;) {
      const double here = line.along(loop.back().to);
      std::size_t next = chains.size(); // the loop's own begin
      double least = line.along(loop.front().from) - here;
      if (least < -line.grain) least = std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < chains.size(); ++k) {
        const double way = line.along(chains[k].front().from) - here;
        if (way >= -line.grain && way < least) least = way, next = k;
      }
      const Vec2 to = next < chains.size() ? chains[next].front().from : loop.front().from;
      if ((to - loop.back().to).norm() > line.grain) loop.push_back({loop.back().to, to});
      if (next == chains.size()) break;
      loop.insert(loop.end(), chains[next].begin(), chains[next].end());
      chains.erase(chains.begin() + static_cast<std::ptrdiff_t>(next));
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

void append_cut(Outline& outline, const CutLoop& loop, int hole) {
  std::vector<Vec2>& corners = hole < 0 ? outline.boundary : outline.holes.emplace_back();
  for (const CutSide& side : loop) {
    if (side.turn != 0) outline.arcs.push_back({hole, corners.size(), side.centre, side.turn});
    corners.push_back(side.from);
  }
}

} // namespace

std::optional<Outline> cut_outline(const Outline& outline, const Vec2& point, const Vec2& normal) {
  Eigen::AlignedBox2d box;
  for (const Vec2& p : outline.boundary)
    box.extend(p);
  const CutLine line{point, normal, 1e-9 * box.diagonal().norm()};
  std::vector<Chain> chains;
  std::vector<CutLoop> borders, holes;
  take_inside(turned(loop_of(outline, -1), true), line, chains, borders);
  for (std::size_t k = 0; k < outline.holes.size(); ++k)
    take_inside(turned(loop_of(outline, static_cast<int>(k)), false), line, chains, holes);
  for (CutLoop& loop : join_chains(std::move(chains), line))
    borders.push_back(std::move(loop));
  if (borders.size() != 1) return std::nullopt;
  Outline part;
  append_cut(part, borders.front(), -1);
  for (std::size_t k = 0; k < holes.size(); ++k)
    append_cut(part, holes[k], static_cast<int>(k));
  return part;
}

} // namespace plyform
