// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/search/unfolded.hpp"

#include "base/node_normals.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/convex_hull_2.h>
#include <algorithm>
#include <cmath>
#include <iterator>

namespace plyform {
namespace {

using Plane = CGAL::Exact_predicates_inexact_constructions_kernel;

/// (C) at the search. Until the next one sides of triangles turn by up to half a skin at either end
/// over their length, with a skin of 0.3 elements some 30 degrees of the 60.
constexpr double cosine = 0.86;

/// The triangles of a patch: those with an edge in it.
struct Patch {
  Box3 box, undeformed;        ///< mm
  Vec3 normal = Vec3::Zero();  ///< unit mean of its triangles' normals
  bool rim = false;            ///< has a free edge
  std::vector<Vec3> normals{}; ///< of its triangles
};

std::vector<Patch> patches_of(const UndeformedSheet& sheet, const SheetEdges& edges,
                              std::span<const Vec3> x) {
  std::vector<Patch> patches(edges.patch_nodes.size());
  for (std::size_t t = 0; t < sheet.triangles.size(); ++t) {
    const Triangle& nodes = sheet.triangles[t];
    const Vec3 normal = (x[nodes[1]] - x[nodes[0]]).cross(x[nodes[2]] - x[nodes[0]]).normalized();
    std::array<std::int32_t, 3> of = edges.patches_of_triangle[t];
    std::sort(of.begin(), of.end());
    for (std::size_t k = 0; k < 3; ++k) {
      if (k > 0 && of[k] == of[k - 1]) continue;
      Patch& patch = patches[of[k]];
      for (const std::int32_t n : nodes)
        patch.box.extend(x[n]), patch.undeformed.extend(sheet.x0[n]);
      patch.normals.push_back(normal);
      patch.normal += normal;
    }
  }
  for (Patch& patch : patches)
    patch.normal.normalize();
  for (std::size_t e = 0; e < edges.all.size(); ++e)
    if (edges.all[e].is_free()) patches[edges.patch[e]].rim = true;
  return patches;
}

/// Whether two patches near each other are neighbours that fulfil (C).
bool are_graph(const Patch& a, const Patch& b, bool convex) {
  if (!convex && (a.rim || b.rim)) return false;
  const double apart = std::sqrt(a.undeformed.squaredExteriorDistance(b.undeformed));
  if (apart > std::max(a.undeformed.diagonal().norm(), b.undeformed.diagonal().norm()))
    return false;
  const Vec3 d = (a.normal + b.normal).normalized();
  const auto inside = [&d](const Vec3& n) { return n.dot(d) >= cosine; };
  return std::all_of(a.normals.begin(), a.normals.end(), inside) &&
         std::all_of(b.normals.begin(), b.normals.end(), inside);
}

} // namespace

bool is_convex(std::span<const Vec3> x0, std::span<const Triangle> triangles) {
  if (x0.empty()) return false;
  std::vector<Plane::Point_2> points, hull;
  for (const Vec3& x : x0) {
    if (x.z() != x0[0].z()) return false;
    points.emplace_back(x.x(), x.y());
  }
  CGAL::convex_hull_2(points.begin(), points.end(), std::back_inserter(hull));
  double within = 0.0, area = 0.0;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const auto &p = hull[i], &q = hull[(i + 1) % hull.size()];
    within += 0.5 * (p.x() * q.y() - p.y() * q.x());
  }
  for (const Triangle& t : triangles)
    area += triangle_area(x0, t);
  return area >= (1.0 - 1e-6) * within;
}

void find_unfolded(const UndeformedSheet& sheet, const SheetEdges& edges, std::span<const Vec3> x,
                   double distance, double skin, std::vector<char>& unfolded) {
  const std::vector<Patch> patches = patches_of(sheet, edges, x);
  using Box = CGAL::Box_intersection_d::Box_d<double, 3>;
  class Numbered : public Box {
  public:
    Numbered(const CGAL::Bbox_3& box, std::size_t patch_) : Box(box), patch(patch_) {}
    std::size_t patch;
  };
  std::vector<char> folded(patches.size(), 0);
  std::vector<Numbered> boxes;
  const double half = 0.5 * (distance + skin);
  for (std::size_t p = 0; p < patches.size(); ++p) {
    const Patch& patch = patches[p];
    if (patch.normals.empty()) continue;
    folded[p] = are_graph(patch, patch, true) ? 0 : 1;
    const Vec3 low = patch.box.min().array() - half, high = patch.box.max().array() + half;
    boxes.emplace_back(CGAL::Bbox_3(low.x(), low.y(), low.z(), high.x(), high.y(), high.z()), p);
  }
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(),
                                [&](const Numbered& a, const Numbered& b) {
                                  if (folded[a.patch] && folded[b.patch]) return;
                                  if (are_graph(patches[a.patch], patches[b.patch], sheet.convex))
                                    return;
                                  folded[a.patch] = folded[b.patch] = 1;
                                });
  unfolded.assign(x.size(), 1);
  for (std::size_t t = 0; t < sheet.triangles.size(); ++t)
    for (const std::int32_t patch : edges.patches_of_triangle[t])
      if (folded[patch])
        for (const std::int32_t n : sheet.triangles[t])
          unfolded[n] = 0;
}

} // namespace plyform
