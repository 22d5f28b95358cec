// SPDX-License-Identifier: GPL-3.0-or-later
// From checked entries to the parts of a Case. Each function reports what the table of keys cannot
// know (names, files, numbers that do not fit together) and fills in what it can: the case is only
// used when no mistake was found.
#pragma once

#include "core/input/case_file.hpp"
#include "core/input/initial_scene.hpp"
#include "core/input/schema_check.hpp"
#include "core/model/case.hpp"

#include <filesystem>
#include <vector>

namespace plyform {

/// core/input/fabric_file.cpp: fabric files and tables.
std::vector<Fabric> read_fabrics(const TableView& root, Diagnostics& diagnostics);

/// core/input/tool_file.cpp: tools, their shapes, places and motions. `folder` is the case file's.
std::vector<Tool> read_tools(const TableView& root, const std::filesystem::path& folder,
                             Diagnostics& diagnostics);

/// core/input/tool_shapes.cpp: the shape of one [[tool]].
ToolShape read_shape(const TableView& tool, const std::filesystem::path& folder,
                     Diagnostics& diagnostics);

/// A direction of the section made a unit vector; the zero vector is reported.
Vec3 read_direction(const TableView& section, const std::string& key, Diagnostics& diagnostics);

/// core/input/boundary_file.cpp: grips, frames, planes of symmetry.
std::vector<Boundary> read_boundaries(const TableView& root, const std::vector<Ply>& plies,
                                      Diagnostics& diagnostics);

/// core/input/boundary_checks.cpp: boundaries that hold nothing or contradict each other, and
/// planes of symmetry that blank, fabric or tools do not have. `surfaces`: of the tools, in space.
void check_boundaries(const Case& scene, const CaseParts& parts, const std::vector<FlatPly>& plies,
                      const std::vector<TriMesh>& surfaces, Diagnostics& diagnostics);

/// core/input/scene_checks.cpp: mistakes that only the whole scene shows: blanks that cannot be
/// meshed, plies overlapping at the start, tools inside plies, tools closer together than the
/// stack. Returns the meshes, one a ply; none if one of them cannot be.
std::vector<BlankMesh> check_scene(const Case& scene, const CaseParts& parts,
                                   Diagnostics& diagnostics);

/// core/input/resolution_checks.cpp: meshes too coarse for what yarns' bending decides; warnings.
/// meshes: of the plies, one each.
void check_resolution(const Case& scene, const CaseParts& parts,
                      const std::vector<BlankMesh>& meshes, Diagnostics& diagnostics);

} // namespace plyform
