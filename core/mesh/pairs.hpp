// SPDX-License-Identifier: GPL-3.0-or-later
// Strain groups: pairs of triangles that share one mean strain for each fibre family, or single
// triangles (core/ply/membrane.hpp).
#pragma once

#include "core/mesh/mesh_blank.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace plyform {

constexpr int most_in_group = 2;

/// Group p holds triangles[begin[p]] .. triangles[begin[p + 1] - 1] of the mesh.
struct StrainGroups {
  std::vector<std::int32_t> triangles;
  std::vector<std::int32_t> begin; ///< groups + 1
};

/// Groups of one triangle each, in the order of the mesh.
StrainGroups single_triangles(std::size_t triangles);

/// Pairs triangles across shared sides: longest sides first, which pairs the two halves of a
/// square, then by re-pairing along chains of neighbours until hardly a triangle is single. Single
/// triangles stiffen the mesh, groups of three would soften it: see the table in
/// docs/tried.md. Triangles marked in `alone` (one per triangle, or empty) stay single.
StrainGroups pair_triangles(const BlankMesh& mesh, const std::vector<char>& alone = {});

/// Marks (1, else 0) the triangles for which the plain element does not lock: those that have, as
/// all their neighbours, a side along each family of yarns (to 1e-3 rad), so that neighbours share
/// their constraints; and those that touch such a triangle, since the band between whole cells and
/// the boundary edge is too narrow to lock. yarns: directions of the families, rad from x.
std::vector<char> along_fibres(const BlankMesh& mesh, std::span<const double> yarns);

} // namespace plyform
