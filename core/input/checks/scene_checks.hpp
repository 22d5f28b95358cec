// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of a case as a scene: what stands where, and what goes where.
#pragma once

#include "core/input/checks/initial_scene.hpp"
#include "core/input/checks/source_location.hpp"

#include <vector>

namespace plyform {

/// core/input/checks/boundary_checks.cpp: reports boundaries that prescribe no node or contradict
/// each other, and planes to which blank, fabric or tools are not symmetric. surfaces: of the
/// tools, mm, in space.
void check_boundaries(const Case& scene, const CaseParts& parts, const std::vector<FlatPly>& plies,
                      const std::vector<TriMesh>& surfaces, Diagnostics& diagnostics);

/// core/input/checks/attachment_checks.cpp: reports springs that cannot be as long as they are, and
/// grippers whose nodes others hold too; warns of those that pull into a ply. Only of boundaries
/// that have nodes.
void check_attachments(const Case& scene, const CaseParts& parts, const std::vector<FlatPly>& plies,
                       Diagnostics& diagnostics);

/// core/input/checks/motion_checks.cpp: reports tools of a size that does not fit the plies',
/// moving tools that begin in another one, and those that never reach a ply. surfaces as above.
void check_motions(const Case& scene, const CaseParts& parts, const std::vector<FlatPly>& plies,
                   const std::vector<TriMesh>& surfaces, Diagnostics& diagnostics);

/// core/input/checks/scene_checks.cpp: checks of the whole scene: blanks that cannot be
/// meshed, plies overlapping at the start, tools inside plies, tools closer together than the
/// stack. Returns the meshes, one per ply; none if one of them cannot be.
std::vector<BlankMesh> check_scene(const Case& scene, const CaseParts& parts,
                                   Diagnostics& diagnostics);

/// core/input/checks/resolution_checks.cpp: warns of meshes that do not resolve the lengths of
/// bending_resolution.hpp. meshes: one per ply.
void check_resolution(const Case& scene, const CaseParts& parts,
                      const std::vector<BlankMesh>& meshes, Diagnostics& diagnostics);

} // namespace plyform
