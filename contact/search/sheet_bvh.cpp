// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/search/sheet_bvh.hpp"

#include "contact/point_triangle.hpp"

#include <algorithm>
#include <cmath>
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/utility.h> // fit(), which BVH_model.h calls without including it
#include <fmt/format.h>
#include <stdexcept>

namespace plyform {

namespace {

using Tree = fcl::BVHModel<fcl::AABB<double>>;

/// By this much, relative to the size of sheet and reach, boxes are enlarged beyond the reach:
/// rounding of the point-triangle distance (some 1e-15 of the triangle's size) must not prune a
/// pair.
constexpr double rounding_margin = 1e-12;

void require_finite(std::span<const Vec3> x, const char* what) {
  for (std::size_t i = 0; i < x.size(); ++i)
    if (!x[i].allFinite())
      throw std::invalid_argument(
          fmt::format("SheetTree: position of {} {} is not finite ({}, {}, {}); a box tree cannot "
                      "hold it: stop the simulation before the broad phase",
                      what, i, x[i].x(), x[i].y(), x[i].z()));
}

void require_ok(int fcl_code, const char* step) {
  if (fcl_code != fcl::BVH_OK)
    throw std::runtime_error(fmt::format("SheetTree: FCL refused to {} (code {})", step, fcl_code));
}

using Box = fcl::AABB<double>;

/// A leaf of the tree that is near a group of nodes: its box and triangle.
struct Leaf {
  Vec3 low, high;
  int face;
};

double squared_distance(const Vec3& p, const Leaf& box) {
  return (box.low - p).cwiseMax(p - box.high).cwiseMax(0.0).squaredNorm();
}

/// Whether p is further than `reach` from the box along x or y: true for most, and soon known.
bool is_beside(const Vec3& p, const Leaf& box, double reach) {
  return p.x() < box.low.x() - reach || p.x() > box.high.x() + reach ||
         p.y() < box.low.y() - reach || p.y() > box.high.y() + reach;
}

bool meet(const Box& a, const Box& b) {
  return overlap(a.min_, a.max_, b.min_, b.max_);
}

/// Collects the leaves whose box overlaps the box `asked`.
void leaves_in(const Tree& tree, const Box& asked, std::vector<int>& stack,
               std::vector<Leaf>& leaves) {
  leaves.clear();
  stack.clear();
  if (meet(asked, tree.getBV(0).bv)) stack.push_back(0);
  while (!stack.empty()) {
    const fcl::BVNode<Box>& box = tree.getBV(stack.back());
    stack.pop_back();
    const int child = box.first_child; // negative: a leaf; isLeaf() says the same in a call
    if (child < 0) {
      leaves.push_back({box.bv.min_, box.bv.max_, -1 - child}); // primitiveId(), without a call
      continue;
    }
    for (const int i : {child, child + 1})
      if (meet(asked, tree.getBV(i).bv)) stack.push_back(i);
  }
}

/// Search distances.
struct Reach {
  double distance; ///< mm, to triangles
  double box;      ///< mm, to boxes, which includes rounding_margin
};

/// Appends the triangles of `leaves` (nodes at x, mm) within reach of p, in no particular order.
void faces_near(const Vec3* x, std::span<const Triangle> triangles, const Vec3& p,
                const Reach& reach, std::span<const Leaf> leaves, std::int32_t node,
                std::vector<Candidate>& out) {
  for (const Leaf& leaf : leaves) {
    if (is_beside(p, leaf, reach.box) || squared_distance(p, leaf) > reach.box * reach.box)
      continue;
    const Triangle& t = triangles[leaf.face];
    const ClosestPoint q = closest_point_on_triangle(p, x[t[0]], x[t[1]], x[t[2]]);
    if (q.distance2 <= reach.distance * reach.distance)
      out.push_back({node, leaf.face, q.distance2, q.w});
  }
}

/// Groups nodes for one traversal of the tree: returns the end of the group that begins at `first`,
/// and its box. On most meshes nodes of neighbouring numbers are close to each other: rows of them
/// on structured ones. size: mm, of an element.
std::size_t group_end(std::span<const Vec3> nodes, std::size_t first, double size, Box& box) {
  constexpr std::size_t most = 16;
  constexpr double longest = 12.0, largest = 16.0; // sizes along an axis, squared sizes along two
  box = Box(nodes[first]);
  std::size_t end = first + 1;
  for (; end < std::min(nodes.size(), first + most); ++end) {
    Box larger = box;
    larger += nodes[end];
    const Vec3 extent = larger.max_ - larger.min_;
    const double length = extent.maxCoeff();
    const double width = extent.sum() - length - extent.minCoeff(); // the second largest
    if (length > longest * size || length * width > largest * size * size) break;
    box = larger;
  }
  return end;
}

} // namespace

struct SheetTree::Impl {
  Tree tree;
  std::vector<Triangle> triangles; ///< a copy: reading those of FCL costs a function call each
  double area = 0.0;               ///< mm^2, as built
};

SheetTree::SheetTree(std::span<const Vec3> x, std::span<const Triangle> triangles)
    : impl_(std::make_unique<Impl>()) {
  if (triangles.empty()) throw std::invalid_argument("SheetTree: a sheet needs a triangle");
  require_finite(x, "node");
  std::vector<fcl::Triangle> faces;
  faces.reserve(triangles.size());
  for (const Triangle& t : triangles) {
    for (const std::int32_t node : t)
      if (node < 0 || std::size_t(node) >= x.size())
        throw std::invalid_argument(fmt::format("SheetTree: triangle {} names node {} of {}",
                                                faces.size(), node, x.size()));
    faces.emplace_back(t[0], t[1], t[2]);
  }
  Tree& tree = impl_->tree;
  require_ok(tree.beginModel(int(faces.size()), int(x.size())), "begin the tree");
  require_ok(tree.addSubModel({x.begin(), x.end()}, faces), "take the triangles");
  require_ok(tree.endModel(), "build the tree");
  impl_->triangles.assign(triangles.begin(), triangles.end());
  for (const Triangle& t : triangles) {
    const auto at = [&](std::size_t k) -> const Vec3& { return x[t[k]]; };
    impl_->area += 0.5 * (at(1) - at(0)).cross(at(2) - at(0)).norm();
  }
}

SheetTree::~SheetTree() = default;
SheetTree::SheetTree(SheetTree&&) noexcept = default;
SheetTree& SheetTree::operator=(SheetTree&&) noexcept = default;

void SheetTree::refit(std::span<const Vec3> x) {
  Tree& tree = impl_->tree;
  if (x.size() != std::size_t(tree.num_vertices))
    throw std::invalid_argument(fmt::format("SheetTree: refit with {} positions, built with {}",
                                            x.size(), tree.num_vertices));
  require_finite(x, "node");
  // Replace, never Update: after an Update FCL refuses to Replace and keeps both positions' boxes.
  require_ok(tree.beginReplaceModel(), "begin replacing");
  for (const Vec3& position : x)
    require_ok(tree.replaceVertex(position), "replace a vertex");
  require_ok(tree.endReplaceModel(/*refit=*/true, /*bottomup=*/true), "refit");
}

Box3 SheetTree::bounds() const {
  // The root's box, not FCL's aabb_local: Replace leaves that stale.
  const fcl::AABB<double>& root = impl_->tree.getBV(0).bv;
  return {root.min_, root.max_};
}

void SheetTree::candidates(std::span<const Vec3> nodes, double reach, std::vector<Candidate>& out,
                           std::span<const char> skip) const {
  if (!(reach >= 0.0 && std::isfinite(reach)))
    throw std::invalid_argument(fmt::format("SheetTree: reach {} mm is no distance", reach));
  require_finite(nodes, "asked node");
  const Tree& tree = impl_->tree;
  const double box_reach = reach + rounding_margin * (bounds().diagonal().norm() + reach);
  const double size = std::sqrt(impl_->area / static_cast<double>(tree.num_tris));
  std::vector<int> stack;
  std::vector<Leaf> leaves;
  Box box;
  for (std::size_t i = 0, end = 0; i < nodes.size(); i = end) {
    end = group_end(nodes, i, size, box);
    if (!skip.empty() &&
        std::all_of(skip.begin() + static_cast<std::ptrdiff_t>(i),
                    skip.begin() + static_cast<std::ptrdiff_t>(end), [](char s) { return s != 0; }))
      continue;
    box.min_.array() -= box_reach;
    box.max_.array() += box_reach;
    leaves_in(tree, box, stack, leaves);
    if (leaves.empty()) continue;
    for (std::size_t n = i; n < end; ++n) {
      if (!skip.empty() && skip[n]) continue;
      const auto first = std::ptrdiff_t(out.size());
      faces_near(tree.vertices, impl_->triangles, nodes[n], {reach, box_reach}, leaves,
                 std::int32_t(n), out);
      std::sort(out.begin() + first, out.end(),
                [](const Candidate& a, const Candidate& b) { return a.face < b.face; });
    }
  }
}

} // namespace plyform
