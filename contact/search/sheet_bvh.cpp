// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/search/sheet_bvh.hpp"

#include "base/cpu_features.hpp"
#include "base/format.hpp"
#include "contact/point_triangle.hpp"
#include "contact/search/float_box.hpp"
#include "contact/simd/point_face_kernel.hpp"

#include <algorithm>
#include <cmath>
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/utility.h> // fit(), which BVH_model.h calls without including it
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
  FloatBox box;
  std::int32_t face;
};

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
      // primitiveId(), without a call
      leaves.push_back({FloatBox(box.bv.min_, box.bv.max_), -1 - child});
      continue;
    }
    for (const int i : {child, child + 1})
      if (meet(asked, tree.getBV(i).bv)) stack.push_back(i);
  }
}

/// A node and a triangle whose boxes are near each other.
using Pair = std::array<std::int32_t, 2>;

/// Appends the pairs of the node and the leaves whose box is within `reach` (mm) of it, at p.
void append_pairs(const Vec3& p, std::int32_t node, double reach, std::span<const Leaf> leaves,
                  std::vector<Pair>& pairs) {
  const Vec3 around = Vec3::Constant(reach);
  const FloatBox near(p - around, p + around);
  std::size_t count = pairs.size();
  pairs.resize(count + leaves.size());
  for (const Leaf& leaf : leaves) { // without a branch, which would often be mispredicted
    pairs[count] = {node, leaf.face};
    count += overlap(near, leaf.box) ? 1 : 0;
  }
  pairs.resize(count);
}

/// Appends those of the pairs that are within `reach` (mm), of each node by triangles. x: mm, of
/// the triangles' nodes.
void append_near(std::span<const Vec3> nodes, const Vec3* x, std::span<const Triangle> triangles,
                 double reach, std::span<const Pair> pairs,
                 std::vector<PointFaceDistance>& distances, std::vector<Candidate>& out) {
  const auto measure =
      fastest(point_face_kernel_generic, point_face_kernel_avx2, point_face_kernel_avx512);
  distances.resize(pairs.size());
  if (pairs.empty()) return;
  measure({pairs.data()->data(), static_cast<int>(pairs.size()), nodes.data()->data(), x->data(),
           triangles.data()->data()},
          distances.data());
  auto first = static_cast<std::ptrdiff_t>(out.size()); // of the node
  const auto sort_node = [&] {
    std::sort(out.begin() + first, out.end(),
              [](const Candidate& a, const Candidate& b) { return a.face < b.face; });
    first = static_cast<std::ptrdiff_t>(out.size());
  };
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto [node, face] = pairs[i];
    const PointFaceDistance& d = distances[i];
    Candidate candidate{node, face, d.distance2, {d.w[0], d.w[1], d.w[2]}};
    if (std::isnan(d.distance2)) {
      const Triangle& t = triangles[face];
      const ClosestPoint q = closest_point_on_triangle(nodes[node], x[t[0]], x[t[1]], x[t[2]]);
      candidate.distance2 = q.distance2, candidate.w = q.w;
    }
    if (i > 0 && node != pairs[i - 1][0]) sort_node();
    if (candidate.distance2 <= reach * reach) out.push_back(candidate);
  }
  sort_node();
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
  std::vector<Pair> pairs;
  std::vector<PointFaceDistance> distances;
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
    pairs.clear();
    for (std::size_t n = i; n < end; ++n)
      if (skip.empty() || !skip[n])
        append_pairs(nodes[n], static_cast<std::int32_t>(n), box_reach, leaves, pairs);
    append_near(nodes, tree.vertices, impl_->triangles, reach, pairs, distances, out);
  }
}

} // namespace plyform
