// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers that are allowed, and each of which some scene has, but that make no sense beside the
// others of theirs: most come from another unit. Each is a warning with what is usual, and what to
// do.
#pragma once

#include "core/input/checks/motion_checks.hpp"
#include "core/input/checks/source_location.hpp"
#include "core/input/keys/schema_check.hpp"

namespace plyform {

/// Of a fabric as it was read from `section`: its stiffness in shear, the sign of its torque, the
/// stiffness of its yarns and its thickness for their mass. A torque that would shear the ply by
/// itself before 45 degrees is an error.
void check_fabric_sense(const TableView& section, const Fabric& fabric, Diagnostics& diagnostics);

/// Of the whole case: gravity of another planet, a stroke so fast that no shape comes out.
void check_case_sense(const Case& scene, const CaseParts& parts, Diagnostics& diagnostics);

/// Of a tool that moves: a stroke that forms nothing or leaves its die behind, a force that holds
/// nothing, a long fall, a rim that few nodes will feel. ways, surfaces: of all tools.
void check_tool_sense(const Case& scene, const CaseParts& parts, const std::vector<FlatPly>& plies,
                      const std::vector<ToolWay>& ways, const std::vector<TriMesh>& surfaces,
                      Diagnostics& diagnostics);

} // namespace plyform
