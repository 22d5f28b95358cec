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

  /// Signed distance (mm) and normal at p (mm, tool frame), as plyform::signed_distance. `hint`:
  /// triangle to begin with, or -1; becomes the closest triangle. Thread-safe; allocates nothing.
  SurfacePoint signed_distance(const Vec3& p, int& hint) const;

  const TriMesh& surface() const { return surface_; }

private:
  struct Tree;
  TriMesh surface_;
  Box3 bounds_;
  std::vector<std::array<Vec3, 3>> corners_; ///< mm, of each triangle, contiguous for the search
  std::vector<std::array<Vec3, 7>> normals_; ///< unit pseudo-normals by ClosestPoint::feature
  std::unique_ptr<const Tree> tree_;
};

} // namespace plyform
