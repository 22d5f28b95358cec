// SPDX-License-Identifier: GPL-3.0-or-later
// Reads tools: position and motion; their shapes are in tool_shapes.cpp.
#include "base/format.hpp"
#include "core/input/keys/key_member.hpp"
#include "core/input/keys/tool_shapes.hpp"
#include "core/input/parts/case_parts.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {

namespace {

/// Rotation of a tool: first by `turn` about z, then the shortest rotation from z to the axis.
Eigen::Matrix3d read_rotation(const TableView& tool, Diagnostics& diagnostics) {
  const double turn = number(tool, "turn");
  const Eigen::Matrix3d turned = Eigen::AngleAxisd(turn, Vec3::UnitZ()).toRotationMatrix();
  if (!given(tool, "axis")) return turned;
  const Vec3 axis = read_direction(tool, "axis", diagnostics);
  if (axis.z() > 1.0 - 1e-14) return turned; // no rounding errors for vertical tools
  Eigen::Quaterniond tilt = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), axis);
  // For the axis -z the shortest rotation is not unique: half a turn about x.
  if (axis.z() < -1.0 + 1e-12) tilt = Eigen::Quaterniond(0.0, 1.0, 0.0, 0.0);
  return tilt.toRotationMatrix() * turned;
}

/// The stroke or force of a tool, or its programme.
void read_motion(const TableView& section, Tool& tool, Diagnostics& diagnostics) {
  if (tool.motion == Motion::fixed) return;
  const bool driven = tool.motion == Motion::driven;
  const char* key = driven ? "stroke_programme" : "force_programme";
  double& largest = driven ? tool.stroke : tool.force;
  tool.programme = read_programme(section, key, largest, diagnostics);
  if (driven && !tool.programme.empty() && largest == 0.0)
    value_error(section, key, "has no stroke above 0", "give the tool a stroke, or leave it fixed",
                diagnostics);
}

Tool read_tool(const TableView& section, const ToolMeshes& meshes, Diagnostics& diagnostics) {
  Tool tool;
  read_members(section, tool);
  tool.shape = read_shape(section, meshes, diagnostics);
  tool.rotation = read_rotation(section, diagnostics);
  read_motion(section, tool, diagnostics);
  if (given(section, "direction") && tool.motion != Motion::fixed)
    tool.direction = read_direction(section, "direction", diagnostics);
  return tool;
}

} // namespace

std::vector<Tool> read_tools(const TableView& root, const std::filesystem::path& folder,
                             Diagnostics& diagnostics) {
  const ToolMeshes meshes(root, folder);
  std::vector<Tool> tools;
  for (const TableView& section : subsections(root, "tool"))
    tools.push_back(read_tool(section, meshes, diagnostics));
  return tools;
}

} // namespace plyform
