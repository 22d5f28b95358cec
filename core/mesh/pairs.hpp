// SPDX-License-Identifier: GPL-3.0-or-later
// Pairs of triangles that share one mean strain for each fibre family (core/ply/membrane.hpp).
#pragma once

#include "core/mesh/mesh_blank.hpp"

#include <cstdint>
#include <vector>

namespace plyform {

constexpr int most_in_group = 2;

/// Patch p holds triangles[begin[p]] .. triangles[begin[p + 1] - 1] of the mesh.
struct StrainGroups {
  std::vector<std::int32_t> triangles;
  std::vector<std::int32_t> begin; ///< groups + 1
};

/// Every triangle alone, in the order of the mesh.
StrainGroups single_triangles(std::size_t triangles);

/// Pairs across shared sides: longest sides first (the two halves of a square find each other),
/// then re-paired along chains of neighbours until hardly a triangle is alone. Triangles alone
/// stiffen the mesh, groups of three soften it: see the table in docs/developers.md. Those marked
/// in `alone` (one a triangle, or empty) stay so.
StrainGroups pair_triangles(const BlankMesh& mesh, const std::vector<char>& alone = {});

/// Triangles (1, else 0) that the plain element suits: with a side along warp and one along weft,
/// to a thousandth of a radian, as have their neighbours, so that they share their constraints; and
/// those that touch such a triangle, since the band between whole cells and a rim is too narrow to
/// lock.
std::vector<char> along_fibres(const BlankMesh& mesh, double warp_angle, double weft_angle);

} // namespace plyform
