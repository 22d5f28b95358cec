// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/search/sheet_bvh.hpp"

#include "contact/point_triangle.hpp"
#include "contact/search/float_box.hpp"

#include <algorithm>
#include <cmath>
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/utility.h> // fit(), which BVH_model.h calls without including it
#include <fmt/format.h>
#include <stdexcept>

namespace plyform {

/// A node of the tree, with its box in floats. child: the first of its two children, which follow
/// each other; negative: a leaf, of triangle -1 - child.
struct TreeNode {
  FloatBox box;
  int child;
};

namespace {

using Tree = fcl::BVHModel<fcl::AABB<double>>;

/// By this much, relative to the coordinates of the sheet and to the reach, boxes are enlarged
/// beyond the reach: rounding of floats, and of the point-triangle distance, must not prune a pair.
constexpr double rounding_margin = 1e-6;

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
  FloatBox box;
  int face;
};

/// mm^2, of floats
float squared_distance(const std::array<float, 3>& p, const FloatBox& box) {
  float sum = 0.0F;
  for (std::size_t i = 0; i < 3; ++i) {
    const float apart = std::max({box.low[i] - p[i], p[i] - box.high[i], 0.0F});
    sum += apart * apart;
  }
  return sum;
}

/// Copies the boxes of FCL's tree, which are in doubles.
void copy_boxes(const Tree& tree, std::vector<TreeNode>& nodes) {
  nodes.resize(static_cast<std::size_t>(tree.getNumBVs()));
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const fcl::BVNode<Box>& of = tree.getBV(static_cast<int>(i));
    nodes[i] = {FloatBox(of.bv.min_, of.bv.max_), of.first_child};
  }
}

/// Collects the leaves whose box overlaps the box `asked`.
void leaves_in(std::span<const TreeNode> tree, const FloatBox& asked, std::vector<int>& stack,
               std::vector<Leaf>& leaves) {
  leaves.clear();
  stack.clear();
  if (overlap(asked, tree[0].box)) stack.push_back(0);
  while (!stack.empty()) {
    const TreeNode& node = tree[at(stack.back())];
    stack.pop_back();
    if (node.child < 0) {
      leaves.push_back({node.box, -1 - node.child});
      continue;
    }
    for (const int i : {node.child, node.child + 1})
      if (overlap(asked, tree[at(i)].box)) stack.push_back(i);
  }
}

/// Search distances.
struct Reach {
  double distance; ///< mm, to triangles
  double box;      ///< mm, to boxes, with rounding_margin and what floats round
};

/// Appends the triangles of `leaves` (nodes at x, mm) within reach of p, in no particular order.
void faces_near(const Vec3* x, std::span<const Triangle> triangles, const Vec3& p,
                const Reach& reach, std::span<const Leaf> leaves, std::int32_t node,
                std::vector<Candidate>& out) {
  const Vec3 around = Vec3::Constant(reach.box);
  const FloatBox box(p - around, p + around);
  const auto rounded = [&p](int i) { return static_cast<float>(p[i]); };
  const std::array<float, 3> at_p{rounded(0), rounded(1), rounded(2)};
  const auto reach2 = static_cast<float>(reach.box * reach.box);
  for (const Leaf& leaf : leaves) {
    if (!overlap(box, leaf.box) || squared_distance(at_p, leaf.box) > reach2) continue;
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
  std::vector<TreeNode> nodes;     ///< of the tree, copied when it is refitted
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
  copy_boxes(tree, impl_->nodes);
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
  copy_boxes(tree, impl_->nodes);
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
  const Box3 all = bounds();
  const double largest = std::max(all.min().cwiseAbs().maxCoeff(), all.max().cwiseAbs().maxCoeff());
  const double box_reach = reach + rounding_margin * (largest + reach);
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
    const Vec3 around = Vec3::Constant(box_reach);
    leaves_in(impl_->nodes, FloatBox(box.min_ - around, box.max_ + around), stack, leaves);
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
