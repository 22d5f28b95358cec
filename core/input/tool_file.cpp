// SPDX-License-Identifier: GPL-3.0-or-later
// Tools: shapes, places and motions.
#include "core/input/case_parts.hpp"
#include "core/input/choices.hpp"
#include "core/input/overrides.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace plyform {

Vec3 read_direction(const TableView& tool, const std::string& key, Diagnostics& diagnostics) {
  const Vec3 v = vector3(tool, key);
  const double length = v.norm();
  if (length > 0.0 && std::isfinite(length)) return v / length;
  value_error(tool, key, length > 0.0 ? "is too long" : "must not be the zero vector",
              "give a vector that points the way", diagnostics);
  return Vec3::UnitZ();
}

namespace {

/// Straight points with fillets and arcs, put together into one profile.
struct ProfileReader {
  const TableView& tool;
  Diagnostics& diagnostics;
  RevolvedProfile profile{};
  std::vector<std::array<double, 3>> run{};   ///< points joined by straight lines so far
  std::vector<const TomlNode*> run_entries{}; ///< and where they stand

  void fail(const TomlNode& at, std::size_t index, const std::string& rule,
            const std::string& remedy) {
    diagnostics.error(at.at, fmt::format("{}.{}", item_of(tool, "points"), index), at.source_text,
                      rule, remedy);
  }
  void straight(const TomlNode& entry);
  void arc(const TomlNode& entry, std::size_t index);
  void finish_run();
};

void ProfileReader::straight(const TomlNode& entry) {
  const double fillet = entry.children.size() > 2 ? entry.children[2].number : 0.0;
  run.push_back({entry.children[0].number, entry.children[1].number, fillet});
  run_entries.push_back(&entry);
}

/// Hands the straight points over; a fillet needs a line on both sides.
void ProfileReader::finish_run() {
  for (const std::size_t end : {std::size_t{0}, run.size() - 1}) {
    if (run[end][2] == 0.0) continue;
    const TomlNode& entry = *run_entries[end];
    const auto index = &entry - given(tool, "points")->children.data();
    return fail(entry, static_cast<std::size_t>(index),
                "rounds a corner that has no straight line on both sides",
                "take the third number out, or give the rounding as an arc");
  }
  if (run.size() < 2) return;
  try {
    const RevolvedProfile part = make_profile(run);
    profile.segments.insert(profile.segments.end(), part.segments.begin(), part.segments.end());
  } catch (const std::exception& error) {
    const TomlNode* points = given(tool, "points");
    diagnostics.error_from(points->at, item_of(tool, "points"), points->source_text, "",
                           error.what());
  }
}

/// {to = [r, z], centre = [r, z], turn = "left" or "right"}, from the point before.
void ProfileReader::arc(const TomlNode& entry, std::size_t index) {
  const auto point = [&](const char* key) {
    const TomlNode* list = entry.find(key);
    return Vec2(list->children[0].number, list->children[1].number);
  };
  const Vec2 a(run.back()[0], run.back()[1]), b = point("to"), centre = point("centre");
  const double radius = (a - centre).norm();
  constexpr double tolerance = 1e-3; // of the radius: numbers rounded to some digits
  if (!(std::abs((b - centre).norm() - radius) <= tolerance * radius) || !(radius > 0.0))
    return fail(entry, index,
                fmt::format("is no arc: its start is {:g} mm from the centre, its end {:g} mm",
                            radius, (b - centre).norm()),
                "correct centre or to: both must have one distance");
  finish_run();
  const int turn = entry.find("turn")->text == "left" ? 1 : -1;
  profile.segments.push_back({ProfileSegment::Kind::arc, a, b, centre, turn});
  run = {{b.x(), b.y(), 0.0}};
  run_entries = {&entry};
}

RevolvedProfile read_profile(const TableView& tool, Diagnostics& diagnostics) {
  ProfileReader reader{tool, diagnostics};
  const TomlNode* points = given(tool, "points");
  if (!points) return {};
  for (std::size_t i = 0; i < points->children.size(); ++i) {
    const TomlNode& entry = points->children[i];
    if (entry.kind != TomlNode::Kind::table) {
      reader.straight(entry);
    } else if (i == 0) {
      reader.fail(entry, i, "is an arc without a point before it", "start with a point [r, z]");
      return {};
    } else {
      reader.arc(entry, i);
    }
  }
  reader.finish_run();
  return reader.profile;
}

Annulus read_ring(const TableView& tool, bool disc, Diagnostics& diagnostics) {
  const double inner = disc ? 0.0 : number(tool, "inner_radius");
  const double outer = number(tool, disc ? "radius" : "outer_radius");
  const double thickness = number(tool, "thickness"), edge = number(tool, "edge_radius");
  if (inner >= outer)
    value_error(tool, "inner_radius",
                fmt::format("must be less than outer_radius, which is {:g}", outer),
                "exchange the two, or use shape disc for a ring without a hole", diagnostics);
  const double width = disc ? outer : (outer - inner) / 2.0; // that one rounding may take
  const double room = std::min(thickness / 2.0, width);
  if (room > 0.0 && edge > room)
    value_error(tool, "edge_radius",
                fmt::format("must be at most {:g}, for the roundings to fit the section", room),
                "make it smaller or the section larger", diagnostics);
  return {inner, outer, thickness, edge};
}

/// The rounding of all edges of a box or cylinder whose smallest dimension is given: below half of
/// it, so that something flat is left on every side.
double read_edge(const TableView& tool, double smallest, Diagnostics& diagnostics) {
  const double edge = number(tool, "edge_radius");
  if (smallest > 0.0 && edge >= 0.5 * smallest)
    value_error(tool, "edge_radius",
                fmt::format("must be less than {:g}, half the smallest dimension of the {}",
                            0.5 * smallest, text(tool, "shape")),
                "make it smaller or the " + text(tool, "shape") + " larger", diagnostics);
  return edge;
}

Cylinder read_cylinder(const TableView& tool, Diagnostics& diagnostics) {
  const double radius = number(tool, "radius"), length = number(tool, "length");
  return {radius, length, read_edge(tool, std::min(2.0 * radius, length), diagnostics)};
}

Box read_box(const TableView& tool, Diagnostics& diagnostics) {
  const Vec3 size = vector3(tool, "size");
  return {size, read_edge(tool, size.minCoeff(), diagnostics)};
}

ToolShape read_mesh(const TableView& tool, const std::filesystem::path& folder,
                    Diagnostics& diagnostics) {
  const TomlNode* file = given(tool, "file");
  const double scale = number(tool, "scale");
  if (!file || std::isnan(scale)) return Plane{};
  try {
    return load_tool_mesh(resolve_path(*file, folder).lexically_normal(), scale, nullptr);
  } catch (const std::exception& error) {
    diagnostics.error_from(file->at, item_of(tool, "file"), file->source_text,
                           "cannot be used: ", error.what());
    return Plane{};
  }
}

ToolShape read_shape(const TableView& tool, const std::filesystem::path& folder,
                     Diagnostics& diagnostics) {
  const std::string shape = text(tool, "shape");
  if (shape == "sphere") return Sphere{number(tool, "radius")};
  if (shape == "cylinder") return read_cylinder(tool, diagnostics);
  if (shape == "box") return read_box(tool, diagnostics);
  if (shape == "disc" || shape == "annulus") return read_ring(tool, shape == "disc", diagnostics);
  if (shape == "profile") return read_profile(tool, diagnostics);
  if (shape == "mesh") return read_mesh(tool, folder, diagnostics);
  return Plane{};
}

/// Turn about z first, then the shortest rotation that brings z to the axis.
Eigen::Matrix3d read_rotation(const TableView& tool, Diagnostics& diagnostics) {
  const double turn = number(tool, "turn");
  const Eigen::Matrix3d turned = Eigen::AngleAxisd(turn, Vec3::UnitZ()).toRotationMatrix();
  if (!given(tool, "axis")) return turned;
  const Vec3 axis = read_direction(tool, "axis", diagnostics);
  if (axis.z() > 1.0 - 1e-14) return turned; // no rounding for tools that stand upright
  Eigen::Quaterniond tilt = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), axis);
  // Half a turn has no shortest way: about x.
  if (axis.z() < -1.0 + 1e-12) tilt = Eigen::Quaterniond(0.0, 1.0, 0.0, 0.0);
  return tilt.toRotationMatrix() * turned;
}

Tool read_tool(const TableView& section, const std::filesystem::path& folder,
               Diagnostics& diagnostics) {
  Tool tool;
  tool.name = text(section, "name");
  tool.shape = read_shape(section, folder, diagnostics);
  tool.position = vector3(section, "position");
  tool.rotation = read_rotation(section, diagnostics);
  tool.motion = value_of(motion_choices, text(section, "motion"));
  if (tool.motion == Motion::fixed) return tool;
  if (given(section, "direction"))
    tool.direction = read_direction(section, "direction", diagnostics);
  if (tool.motion == Motion::driven) {
    tool.stroke = number(section, "stroke");
  } else {
    tool.force = number(section, "force");
    tool.mass = number(section, "mass");
  }
  return tool;
}

} // namespace

std::vector<Tool> read_tools(const TableView& root, const std::filesystem::path& folder,
                             Diagnostics& diagnostics) {
  std::vector<Tool> tools;
  for (const TableView& section : subsections(root, "tool"))
    tools.push_back(read_tool(section, folder, diagnostics));
  return tools;
}

} // namespace plyform
