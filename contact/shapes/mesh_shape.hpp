// SPDX-License-Identifier: GPL-3.0-or-later
// Internal to contact/: a triangle mesh as a tool. The search tree (CGAL) stays in mesh_shape.cpp.
#pragma once

#include "contact/shapes/tool_shape.hpp"

namespace plyform {

class MeshShape {
public:
  /// surface: consistently oriented, manifold, no zero-area triangles; closed ones outward and free
  /// of self-intersections (as make_mesh_shape and load_tool_mesh make them). Builds the tree.
  explicit MeshShape(TriMesh surface);
  ~MeshShape();

  /// Signed distance (mm) and normal at p (mm, tool frame), as plyform::signed_distance. Sets
  /// `hint` where it searches the closest facet. Thread-safe; allocates nothing.
  SurfacePoint signed_distance(const Vec3& p, SurfaceHint& hint) const;

  const TriMesh& surface() const { return surface_; }

private:
  struct Tree;
  /// SurfaceHint::clear of p (mm, tool frame), whose closest triangle is `face`, at this distance
  /// (mm).
  float clear_way(const Vec3& p, int face, double distance) const;

  TriMesh surface_;
  Box3 bounds_;
  std::vector<std::array<Vec3, 3>> corners_; ///< mm, of each triangle, contiguous for the search
  std::vector<std::array<Vec3, 7>> normals_; ///< unit pseudo-normals by ClosestPoint::feature
  std::vector<std::vector<std::int32_t>> faces_of_node_;
  std::unique_ptr<const Tree> tree_;
};

} // namespace plyform
