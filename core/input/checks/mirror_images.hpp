// SPDX-License-Identifier: GPL-3.0-or-later
// Mirror images of plies and tools at a vertical plane: whether they are the plies and tools again.
// A direction at an angle phi to the plane's trace goes over to -phi, and a law of shear of both
// signs to that of the other sign, unless both of its families are exchanged.
#pragma once

#include "core/input/checks/initial_scene.hpp"
#include "core/model/mirror.hpp"

#include <string>
#include <utility>
#include <vector>

namespace plyform {

/// Why the mirror image of a ply's fabric is not the fabric again, each as what the image "has" or
/// does; empty if it is.
std::vector<std::string> broken_by_fibres(const Ply& ply, const Fabric& fabric,
                                          const SymmetryPlane& plane);

/// The fabric with all families of yarns as dense and stiff as the first, and by how much that
/// changes one of them, relative to the larger, 0 to 1.
std::pair<Fabric, double> with_families_alike(Fabric fabric);

/// The place at which the mirror image of a tool differs most from `other`, beyond what flat facets
/// make of a curved surface: two nodes that are each other's image on the surface may lie opposite
/// to the middle of a facet. Contact is with the half of the tool on the ply's side, so that this
/// much does nothing.
struct Difference {
  double beyond = 0.0, all = 0.0, of_facets = 0.0; ///< mm
};

/// surface: of `tool`, in space. most: points of it that are asked, evenly over all.
Difference difference_to_image(const Tool& tool, const Tool& other, const TriMesh& surface,
                               const SymmetryPlane& plane,
                               std::size_t most = std::numeric_limits<std::size_t>::max());

} // namespace plyform
