// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the parts of a Case from entries that were checked against the table of keys. Each function
// reports errors that the table cannot express (names, files, inconsistent numbers) and fills in
// what is valid: the case is used only if there was no error at all.
#pragma once

#include "core/input/case_file.hpp"
#include "core/input/initial_scene.hpp"
#include "core/input/schema_check.hpp"
#include "core/input/tool_meshes.hpp"
#include "core/model/case.hpp"

#include <filesystem>
#include <vector>

namespace plyform {

/// core/input/fabric_file.cpp: fabric files and tables.
std::vector<Fabric> read_fabrics(const TableView& root, Diagnostics& diagnostics);

/// core/input/blank_file.cpp: one blank. `folder` is the case file's.
BlankSpec read_blank(const TableView& section, const std::filesystem::path& folder,
                     Diagnostics& diagnostics);

/// core/input/zone_file.cpp: the zones of a blank that has its outline; those along tools without
/// their places. Reports zones beside the blank, or with larger elements than its own.
void read_zones(const TableView& section, BlankSpec& blank, Diagnostics& diagnostics);

/// core/input/zone_file.cpp: the places of zones along tools. Reports names of no tool, and zones
/// beside a ply that has the blank.
void place_tool_zones(const TableView& root, Case& built, Diagnostics& diagnostics);

/// core/input/tool_file.cpp: tools, their shapes, places and motions. `folder` is the case file's.
std::vector<Tool> read_tools(const TableView& root, const std::filesystem::path& folder,
                             Diagnostics& diagnostics);

/// core/input/tool_shapes.cpp: the shape of one [[tool]].
ToolShape read_shape(const TableView& tool, const ToolMeshes& meshes, Diagnostics& diagnostics);

/// A direction of the section as a unit vector; reports an error for the zero vector.
Vec3 read_direction(const TableView& section, const std::string& key, Diagnostics& diagnostics);

/// The stages of a programme of the section; reports those that are not in order of time. `largest`
/// becomes the largest value, if that is larger.
std::vector<Stage> read_programme(const TableView& section, const std::string& key, double& largest,
                                  Diagnostics& diagnostics);

/// core/input/boundary_file.cpp: grips, frames, planes of symmetry, springs and grippers.
std::vector<Boundary> read_boundaries(const TableView& root, const std::vector<Ply>& plies,
                                      const std::vector<Tool>& tools, Diagnostics& diagnostics);

/// core/input/boundary_checks.cpp: reports boundaries that prescribe no node or contradict each
/// other, and planes to which blank, fabric or tools are not symmetric. surfaces: of the tools, mm,
/// in space.
void check_boundaries(const Case& scene, const CaseParts& parts, const std::vector<FlatPly>& plies,
                      const std::vector<TriMesh>& surfaces, Diagnostics& diagnostics);

/// core/input/attachment_checks.cpp: reports springs that cannot be as long as they are, and
/// grippers whose nodes others hold too; warns of those that pull into a ply. Only of boundaries
/// that have nodes.
void check_attachments(const Case& scene, const CaseParts& parts, const std::vector<FlatPly>& plies,
                       Diagnostics& diagnostics);

/// core/input/motion_checks.cpp: reports tools of a size that does not fit the plies', moving tools
/// that begin in another one, and those that never reach a ply. surfaces as above.
void check_motions(const Case& scene, const CaseParts& parts, const std::vector<FlatPly>& plies,
                   const std::vector<TriMesh>& surfaces, Diagnostics& diagnostics);

/// core/input/scene_checks.cpp: checks of the whole scene: blanks that cannot be
/// meshed, plies overlapping at the start, tools inside plies, tools closer together than the
/// stack. Returns the meshes, one per ply; none if one of them cannot be.
std::vector<BlankMesh> check_scene(const Case& scene, const CaseParts& parts,
                                   Diagnostics& diagnostics);

/// core/input/resolution_checks.cpp: warns of meshes that do not resolve the lengths of
/// bending_resolution.hpp. meshes: one per ply.
void check_resolution(const Case& scene, const CaseParts& parts,
                      const std::vector<BlankMesh>& meshes, Diagnostics& diagnostics);

} // namespace plyform
