// SPDX-License-Identifier: GPL-3.0-or-later
// What tests that nothing has gone through anything look at: heights, and the exact audit. They
// know nothing of the contacts that the run has found.
#pragma once

#include "contact/intersections.hpp"
#include "core/run/run.hpp"

#include <algorithm>
#include <limits>

namespace plyform {

/// Least height (mm) of nodes `x` over the triangles of `ground` right below or above them;
/// infinite where none is. Negative: some node is under it. Brute force, for sheets that do not
/// overhang.
inline double height_over(const std::vector<Vec3>& x, const PlyFrame& ground) {
  double least = std::numeric_limits<double>::infinity();
  const auto across = [](const Vec3& u, const Vec3& v) { return u.x() * v.y() - u.y() * v.x(); };
  for (const Triangle& t : ground.triangles) {
    const Vec3& a = ground.x[t[0]];
    const Vec3 u = ground.x[t[1]] - a;
    const Vec3 v = ground.x[t[2]] - a;
    const double area = across(u, v);
    for (const Vec3& p : x) {
      const Vec3 r = p - a;
      const double s = across(r, v) / area, q = across(u, r) / area;
      if (!(s >= 0.0 && q >= 0.0 && s + q <= 1.0)) continue;
      const double height = r.z() - s * u.z() - q * v.z();
      if (!(height >= least)) least = height; // NaN too
    }
  }
  return least;
}

/// Least vertical gap (mm) between the mid-surfaces of two plies, at nodes of either.
inline double gap_between(const PlyFrame& lower, const PlyFrame& upper) {
  std::vector<Vec3> turned = lower.x; // seen from below
  PlyFrame ceiling = upper;
  for (Vec3& p : turned)
    p.z() = -p.z();
  for (Vec3& p : ceiling.x)
    p.z() = -p.z();
  return std::min(height_over(upper.x, lower), height_over(turned, ceiling));
}

/// Least gap between neighbours of a stack listed from below.
inline double least_gap(const Frame& f) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t p = 1; p < f.plies.size(); ++p)
    least = std::min(least, gap_between(f.plies[p - 1], f.plies[p]));
  return least;
}

/// Pairs of triangles of different plies that cross.
inline std::size_t crossings(const Frame& f) {
  std::vector<MeshView> sheets;
  for (const PlyFrame& ply : f.plies)
    sheets.push_back({ply.x, ply.triangles});
  return find_intersections(sheets).between.size();
}

} // namespace plyform
