// SPDX-License-Identifier: GPL-3.0-or-later
// How the surface is curved that a mesh of flat triangles stands for. Its nodes lie on that
// surface, as those of tessellated solids do.
//
//   u, v   mm    nodes of a side;  n unit normal of the surface at u;  d = v - u
//   k = 2 n . d / d^2          1/mm  curvature of the circle through u and v with normal n at u;
//                                    Moreton and Sequin, SIGGRAPH 1992                        (1)
//   k = m + h cos 2 t + b sin 2 t    with the direction t of the side in the plane at right angles
//                                    to n (Euler), m, h, b by least squares over the sides at u;
//                                    m -+ sqrt(h^2 + b^2) are the principal curvatures        (2)
//   n = sum (d_i x d_j) / (d_i^2 d_j^2) over the triangles at u, exact on spheres; Max, Journal
//                                    of Graphics Tools 4, 1999                                (3)
//   sag = |n . d| / 3          mm    of a triangle below a sphere through its corners: e^2 / (6 R)
//                                    of an equilateral one with sides e; on a cylinder less   (4)
// Sides at which the faces turn by more than `sharp` are edges: (1) to (3) are of the triangles on
// one side of them. (1) is exact on spheres and across cylinders however coarse the mesh is.
#pragma once

#include "base/geometry.hpp"

#include <vector>

namespace plyform {

/// rad. CAD programs turn by 0.5 rad from facet to facet at most where they mesh what is round.
inline constexpr double sharp_turn = 35.0 * degree;

struct MeshCurvature {
  /// mm, of each node: the tightest convex radius of the surface there; infinite where it is flat
  /// or hollow, 0 on sharp convex edges
  std::vector<double> radius;
  /// mm, of each triangle: how far the surface may be from it, (4)
  std::vector<double> deflection;
};

/// surface: consistently oriented; normals point out of the material.
MeshCurvature mesh_curvature(const TriMesh& surface);

} // namespace plyform
