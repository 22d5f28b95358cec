// SPDX-License-Identifier: GPL-3.0-or-later
// Second derivatives of a function given at the nodes of a mesh, as means over the cells of nodes.
//
//   A0         mm^2   cell of a node: of each triangle around the part between its centroid and the
//                     midpoints of two sides, a third of it; cells fill the sheet
//   H_ab       1/mm^2 mean second derivative over the cell, by the gradient on the cell's boundary:
//                     A0 H_ab = integral of (w_,a l_b + w_,b l_a)/2, l its outward normal      (H)
//   C          mm^2   on each side between two cells the gradient of the linear interpolant of a
//                     triangle, and as much more as a quadratic polynomial with the second
//                     derivatives of a patch of triangles around the side has there:
//                     flux = g l + C : H_patch, with C from exactness for all quadratics       (C)
//
// What leaves one cell enters the next. So a constant moment over the sheet puts no force on inner
// nodes, and on the rim it puts there what holds such a moment in balance: forces at corners for a
// twisted plate. With second derivatives that are exact for quadratics, but do not add up like
// this, forces on inner nodes of an irregular mesh are left, and the plate gives way to them: it is
// too soft, on meshes of any size. C is zero where the two triangles of a side form a
// parallelogram.
//
// On the rim no moment acts on the plane across it: the curvature in the direction of the rim's
// normal is not taken from the nodes, but as the one that makes the energy least, by the law at no
// curvature. At corners this goes for the normals of both sides.                               (R)
//
// Sources: mean gradients over the cells of nodes: Phaal and Calladine (1992), Onate and Zarate
// (2000); why integrals of the derivatives have to add up: Chen, Wu, Yoon and You (2001).
#pragma once

#include "base/geometry.hpp"
#include "core/model/fabric.hpp"

#include <span>
#include <utility>
#include <vector>

namespace plyform {

/// The undeformed ply, in coordinates along the first material axis and normal to it.
struct UndeformedSheet {
  std::vector<Vec2> x; ///< mm
  const std::vector<Triangle>& triangles;
  std::vector<std::vector<int>> around; ///< triangles of each node
  std::vector<double> area;             ///< mm^2, A0
  double axes_angle;                    ///< rad, from the first material axis to the second
};

/// Weights of nodes in H_11, H_22, H_12 at one node, 1/mm^2.
using CurvatureRow = std::vector<std::pair<int, std::array<double, 3>>>;

/// (H) with (R) of each node, in the sheet's coordinates.
std::vector<CurvatureRow> curvature_rows(const UndeformedSheet& sheet, const BendingLaw& law);

/// Second derivatives along the material axes from those in the sheet's coordinates: rows 11, 22
/// and 12.
Eigen::Matrix3d along_axes(double axes_angle);

} // namespace plyform
