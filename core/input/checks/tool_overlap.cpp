// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/input/checks/tool_overlap.hpp"

#include <algorithm>
#include <cmath>
#include <queue>

namespace plyform {
namespace {

constexpr std::size_t most_corners = 60000; // of a surface that are asked
constexpr int most_halved = 10000;          // faces

/// Signed distance of p to a placed tool.
double distance_to(const PlacedTool& t, const Vec3& p, SurfaceHint& hint) {
  return tool_distance(t.tool, t.shift, p, hint);
}

/// A face, or a part of one, that may be nearer than what has been found.
struct Part {
  double bound; ///< mm
  std::array<Vec3, 3> x;
  bool operator<(const Part& other) const { return bound > other.bound; } // the least first
};

class GapSearch {
public:
  GapSearch(const PlacedTool& a, const PlacedTool& b, const Eigen::AlignedBox2d& area,
            double interest, double resolution)
      : a_(a), b_(b), area_(area), interest_(interest), resolution_(resolution) {}

  LeastGap find() {
    ask_corners();
    for (const Triangle& t : a_.surface.triangles)
      offer({corner(t[0]), corner(t[1]), corner(t[2])});
    for (int i = 0; i < most_halved && !parts_.empty(); ++i) {
      const Part part = parts_.top();
      parts_.pop();
      if (part.bound >= limit()) break;
      const auto& [p, q, r] = part.x;
      const Vec3 pq = 0.5 * (p + q), qr = 0.5 * (q + r), rp = 0.5 * (r + p);
      for (const std::array<Vec3, 3>& x :
           {std::array<Vec3, 3>{p, pq, rp}, {pq, q, qr}, {rp, qr, r}, {pq, qr, rp}})
        offer(x);
    }
    return least_;
  }

private:
  Vec3 corner(std::int32_t n) const { return a_.surface.x[at(n)] + a_.shift; }

  /// What is no nearer than this (mm) need not be looked at.
  double limit() const {
    return std::min(interest_, least_.gap - std::max(resolution_, 0.02 * std::abs(least_.gap)));
  }

  /// The distance of p to b; if p counts, it may become the least one.
  double ask(const Vec3& p) {
    const double distance = distance_to(b_, p, hint_b_);
    if (!area_.contains(p.head<2>()) || distance >= least_.gap) return distance;
    // faces of what is round lie a little below its true surface
    const double gap = distance + std::abs(distance_to(a_, p, hint_a_));
    if (gap < least_.gap) least_ = {gap, p};
    return distance;
  }

  void ask_corners() {
    const std::vector<Vec3>& x = a_.surface.x;
    const std::size_t all = std::max<std::size_t>(1, x.size() / most_corners);
    // A few first: with a small distance known, most of the others need not be asked.
    for (const std::size_t stride : {101 * all, all}) {
      LastDistance last;
      for (std::size_t i = 0; i < x.size(); i += stride) {
        const Vec3 p = x[i] + a_.shift;
        if (!area_.contains(p.head<2>())) continue;
        if (last.at_least(p) >= std::min(interest_, least_.gap)) continue;
        last = {p, ask(p)};
      }
    }
  }

  /// Asks the middle of a part, and keeps the part if it may have what is nearer.
  void offer(const std::array<Vec3, 3>& x) {
    const Vec3 middle = (x[0] + x[1] + x[2]) / 3.0;
    Eigen::AlignedBox2d plan;
    double size = 0.0;
    for (const Vec3& p : x) {
      plan.extend(Vec2(p.head<2>()));
      size = std::max(size, (p - middle).norm());
    }
    if (!area_.intersects(plan) || last_.at_least(middle) - size >= limit()) return;
    last_ = {middle, ask(middle)};
    const double bound = last_.distance - size;
    if (bound < limit()) parts_.push({bound, x});
  }

  const PlacedTool &a_, &b_;
  const Eigen::AlignedBox2d& area_;
  double interest_, resolution_;
  LeastGap least_;
  LastDistance last_; ///< of the last middle
  SurfaceHint hint_a_, hint_b_;
  std::priority_queue<Part> parts_;
};

/// The deepest common point of two solids, searched inwards from the faces of a.
LeastGap deepest_common(const PlacedTool& a, const PlacedTool& b, const Eigen::AlignedBox2d& area) {
  LeastGap found;
  Box3 box;
  for (const Vec3& x : a.surface.x)
    box.extend(x);
  const std::size_t faces = a.surface.triangles.size(),
                    stride = std::max<std::size_t>(1, faces / 500);
  SurfaceHint hint_a, hint_b;
  for (std::size_t f = 0; f < faces; f += stride) {
    const auto& [i, j, k] = a.surface.triangles[f];
    const Vec3 &p = a.surface.x[at(i)], &q = a.surface.x[at(j)], &r = a.surface.x[at(k)];
    const Vec3 normal = (q - p).cross(r - p).stableNormalized();
    for (const double inwards : {1e-4, 1e-3, 1e-2, 0.1, 0.3}) { // of the tool's diagonal
      const Vec3 x = (p + q + r) / 3.0 + a.shift - inwards * box.diagonal().norm() * normal;
      if (!area.contains(x.head<2>())) continue;
      const double gap = std::max(distance_to(a, x, hint_a), distance_to(b, x, hint_b));
      if (gap < found.gap) found = {gap, x};
    }
  }
  return found;
}

/// Whether boxes around both say that they have nothing in common.
bool apart(const PlacedTool& a, const PlacedTool& b) {
  constexpr double rounder = 1e-3; // of its size: what is round lies beyond its facets
  const auto box_of = [](const PlacedTool& t) {
    Box3 box;
    for (const Vec3& x : t.surface.x)
      box.extend(x + t.shift);
    if (box.isEmpty() || std::holds_alternative<MeshShapePtr>(t.tool.shape)) return box;
    const Vec3 more = Vec3::Constant(rounder * box.diagonal().norm());
    return Box3(box.min() - more, box.max() + more);
  };
  if (!bounded_tool(a.tool) || !bounded_tool(b.tool)) return false;
  const Box3 of_a = box_of(a), of_b = box_of(b);
  return !of_a.isEmpty() && !of_b.isEmpty() && !of_a.intersects(of_b);
}

} // namespace

bool is_closed(const TriMesh& surface) {
  const std::vector<FaceSide> sides = sides_by_edge(surface.triangles);
  for (std::size_t k = 0; k < sides.size(); k += 2) {
    const bool two = k + 1 < sides.size() && sides[k].same_edge(sides[k + 1]);
    if (!two || (k + 2 < sides.size() && sides[k].same_edge(sides[k + 2]))) return false;
  }
  return true;
}

LeastGap least_gap(const PlacedTool& a, const PlacedTool& b, const Eigen::AlignedBox2d& area,
                   double interest, double resolution) {
  return GapSearch(a, b, area, interest, resolution).find();
}

LeastGap deepest_overlap(const PlacedTool& a, const PlacedTool& b, const Eigen::AlignedBox2d& area,
                         double touching) {
  if (apart(a, b)) return {};
  LeastGap found = least_gap(a, b, area, -touching, 0.5 * touching);
  if (const LeastGap other = least_gap(b, a, area, -touching, 0.5 * touching);
      other.gap < found.gap)
    found = other;
  if (found.gap < -touching) return found;
  const auto solid = [](const PlacedTool& t) {
    return !std::holds_alternative<Plane>(t.tool.shape) && is_closed(t.surface);
  };
  if (solid(a) && solid(b)) found = deepest_common(a, b, area);
  return found.gap < -touching ? found : LeastGap{};
}

} // namespace plyform
