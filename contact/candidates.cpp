// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/candidates.hpp"

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

/// Boxes are asked with this much more reach, relative to the size of sheet and reach: rounding
/// of the point-triangle distance (some 1e-15 of the triangle's size) must not prune a pair.
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

double squared_distance(const Vec3& p, const fcl::AABB<double>& box) {
  return (box.min_ - p).cwiseMax(p - box.max_).cwiseMax(0.0).squaredNorm();
}

/// Appends the triangles within `reach` of p, in no particular order. `stack` is scratch.
void faces_near(const Tree& tree, const Vec3& p, double reach, double box_reach2,
                std::vector<int>& stack, std::int32_t node, std::vector<Candidate>& out) {
  if (squared_distance(p, tree.getBV(0).bv) > box_reach2) return;
  stack.assign(1, 0);
  while (!stack.empty()) {
    const fcl::BVNode<fcl::AABB<double>>& box = tree.getBV(stack.back());
    stack.pop_back();
    if (!box.isLeaf()) {
      for (const int child : {box.leftChild(), box.rightChild()})
        if (squared_distance(p, tree.getBV(child).bv) <= box_reach2) stack.push_back(child);
      continue;
    }
    const fcl::Triangle& t = tree.tri_indices[box.primitiveId()];
    const ClosestPoint q =
        closest_point_on_triangle(p, tree.vertices[t[0]], tree.vertices[t[1]], tree.vertices[t[2]]);
    if (q.distance2 <= reach * reach) out.push_back({node, box.primitiveId()});
  }
}

} // namespace

struct SheetTree::Impl {
  Tree tree;
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

void SheetTree::candidates(std::span<const Vec3> nodes, double reach,
                           std::vector<Candidate>& out) const {
  if (!(reach >= 0.0 && std::isfinite(reach)))
    throw std::invalid_argument(fmt::format("SheetTree: reach {} mm is no distance", reach));
  require_finite(nodes, "asked node");
  const double box_reach = reach + rounding_margin * (bounds().diagonal().norm() + reach);
  std::vector<int> stack;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto first = std::ptrdiff_t(out.size());
    faces_near(impl_->tree, nodes[i], reach, box_reach * box_reach, stack, std::int32_t(i), out);
    std::sort(out.begin() + first, out.end(),
              [](const Candidate& a, const Candidate& b) { return a.face < b.face; });
  }
}

} // namespace plyform
