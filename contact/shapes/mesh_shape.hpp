// SPDX-License-Identifier: GPL-3.0-or-later
// Internal to contact/: a triangle mesh as a tool. The search tree (CGAL) stays in mesh_shape.cpp.
#pragma once

#include "contact/point_triangle.hpp"
#include "contact/shapes/mesh_curvature.hpp"
#include "contact/shapes/tool_shape.hpp"

#include <mutex>

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

  /// Asks memory for the facet that signed_distance(p, hint) will most likely measure.
  void prefetch(const SurfaceHint& hint) const {
    if (hint.nearest < 0) return;
    const auto f = static_cast<std::size_t>(hint.nearest);
    __builtin_prefetch(&corners_[f]);
    __builtin_prefetch(&corners_[f][2]);
    __builtin_prefetch(&normals_[f]);
  }

  const TriMesh& surface() const { return surface_; }

  /// Found when it is first asked for. Thread-safe.
  const MeshCurvature& curvature() const;

private:
  struct Tree;
  /// Calls visit(face) once for it and for each face that shares a node with it.
  template <class Visit>
  void visit_around(int face, const Visit& visit) const;
  /// SurfaceHint::clear of p (mm, tool frame), whose closest triangle is `face`, at this distance
  /// (mm). off: mm, from p to SurfaceHint::at, which is rounded.
  float clear_way(const Vec3& p, int face, double distance, double off) const;
  /// Sets the hint of a point whose closest triangle, at this signed distance (mm), was searched.
  /// slides: its next search will be near.
  void remember(const Vec3& p, int face, double distance, bool slides, SurfaceHint& hint) const;
  /// on_surface: mm, within which the pseudo-normal serves as normal.
  SurfacePoint at_closest(const Vec3& p, int face, const ClosestPoint& closest,
                          double on_surface) const;
  /// Makes `face`, hint.facet or one around it, the hint's `nearest`, with its `concavity`.
  void compare_with_neighbours(int face, SurfaceHint& hint) const;
  /// Sets `found` and returns true if hint.nearest alone tells that it is closest to p.
  bool found_at_once(const Vec3& p, const SurfaceHint& hint, SurfacePoint& found) const;

  TriMesh surface_;
  double largest_ = 0.0;                     ///< mm, coordinate
  std::vector<std::array<Vec3, 3>> corners_; ///< mm, of each triangle, contiguous for the search
  std::vector<std::array<Vec3, 7>> normals_; ///< unit pseudo-normals by ClosestPoint::feature
  std::vector<std::vector<std::int32_t>> faces_of_node_;
  std::unique_ptr<const Tree> tree_;
  mutable std::once_flag curvature_asked_;
  mutable MeshCurvature curvature_;
};

} // namespace plyform
