// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the blanks of a case file.
#include "base/format.hpp"
#include "core/drawing/dxf_outline.hpp"
#include "core/input/keys/key_member.hpp"
#include "core/input/keys/overrides.hpp"
#include "core/input/keys/point_list.hpp"
#include "core/input/parts/case_parts.hpp"
#include "core/mesh/mesh_blank.hpp"

#include <algorithm>

namespace plyform {
namespace {

constexpr PointWords point_words{"point", "x", "y"};

/// Whether the list has corners only, neither rounded nor arcs.
bool is_polygon(const TomlNode& list) {
  return std::none_of(list.children.begin(), list.children.end(), [](const TomlNode& entry) {
    return entry.kind == TomlNode::Kind::table ||
           (entry.children.size() > 2 && entry.children[2].number != 0.0);
  });
}

/// Appends the loop of a list of points, to the outline as its boundary or as a hole.
void read_loop(const TomlNode& list, const std::string& item, bool hole, Outline& outline,
               Diagnostics& diagnostics) {
  if (!is_polygon(list)) {
    const Profile chain = read_points(list, item, point_words, true, diagnostics);
    if (!chain.empty() && (!hole || !outline.boundary.empty())) append_loop(outline, chain);
    return;
  }
  std::vector<Vec2>& corners = hole ? outline.holes.emplace_back() : outline.boundary;
  for (const TomlNode& corner : list.children)
    corners.emplace_back(corner.children[0].number, corner.children[1].number);
}

void read_rectangle(const TableView& section, Outline& outline, Diagnostics& diagnostics) {
  const Vec2 size = vector2(section, "size"), half = 0.5 * size;
  const double radius = number(section, "corner_radius");
  if (radius == 0.0) {
    outline.boundary = {
        {-half.x(), -half.y()}, {half.x(), -half.y()}, {half.x(), half.y()}, {-half.x(), half.y()}};
  } else if (radius > half.minCoeff()) {
    value_error(section, "corner_radius",
                fmt::format("must be at most {:g}, half the shorter side", half.minCoeff()),
                "make it smaller, or the blank larger", diagnostics);
  } else if (radius > 0.0) {
    append_loop(outline, round_corners({{-half.x(), -half.y(), radius},
                                        {half.x(), -half.y(), radius},
                                        {half.x(), half.y(), radius},
                                        {-half.x(), half.y(), radius}},
                                       true, point_words));
  }
}

void read_drawing(const TableView& section, const std::filesystem::path& folder, BlankSpec& blank,
                  Diagnostics& diagnostics) {
  const TomlNode* file = given(section, "outline_file");
  DxfRequest request{resolve_path(*file, folder).lexically_normal(), text(section, "layer"), {}};
  if (const double size = number(section, "element_size"); size > 0.0) request.spacing = size;
  if (given(section, "scale")) request.scale = number(section, "scale");
  try {
    DxfOutline drawing = read_dxf_outline(request);
    blank.outline = std::move(drawing.outline);
    blank.drawing = std::move(drawing.description);
  } catch (const std::exception& error) {
    diagnostics.error_from(file->at, item_of(section, "outline_file"), file->source_text, "",
                           error.what());
  }
}

/// Reports keys that say more about a key that is not there.
void check_company(const TableView& section, Diagnostics& diagnostics) {
  for (const auto& [key, with] : {std::pair{"layer", "outline_file"}, {"scale", "outline_file"}})
    if (given(section, key) && !given(section, with))
      value_error(section, key, fmt::format("belongs to {}, which is not given", with),
                  fmt::format("take it out, or give {}", with), diagnostics);
  if (number(section, "corner_radius") > 0.0 && !given(section, "size"))
    value_error(section, "corner_radius", "belongs to size, which is not given",
                "round the corners of an outline by a third number", diagnostics);
}

void read_outline(const TableView& section, const std::filesystem::path& folder, BlankSpec& blank,
                  Diagnostics& diagnostics) {
  Outline& outline = blank.outline;
  check_company(section, diagnostics);
  if (given(section, "size")) read_rectangle(section, outline, diagnostics);
  if (given(section, "radius")) append_circle(outline, Vec2::Zero(), number(section, "radius"));
  if (const TomlNode* list = given(section, "outline"))
    read_loop(*list, item_of(section, "outline"), false, outline, diagnostics);
  if (given(section, "outline_file")) read_drawing(section, folder, blank, diagnostics);
  const TomlNode* holes = given(section, "holes");
  for (std::size_t k = 0; holes && k < holes->children.size(); ++k) {
    const TomlNode& hole = holes->children[k];
    if (hole.kind != TomlNode::Kind::table) {
      read_loop(hole, fmt::format("{}.{}", item_of(section, "holes"), k), true, outline,
                diagnostics);
    } else if (!outline.boundary.empty()) {
      const std::vector<TomlNode>& centre = hole.find("centre")->children;
      append_circle(outline, Vec2(centre[0].number, centre[1].number), hole.find("radius")->number);
    }
  }
  shift(outline, vector2(section, "centre"));
}

/// mesh_from, and whether there is a run at it.
void read_mesh_from(const TableView& section, const std::filesystem::path& folder, BlankSpec& blank,
                    Diagnostics& diagnostics) {
  const std::string from = text(section, "mesh_from");
  if (from.empty() || from == "element_size") return;
  blank.mesh_from = from;
  if (from == mesh_from_scene_word) return;
  const std::filesystem::path path =
      resolve_path(*given(section, "mesh_from"), folder).lexically_normal();
  if (std::error_code none; !std::filesystem::exists(path, none)) // others: when it is read
    value_error(section, "mesh_from",
                "is neither \"scene\", \"element_size\" nor the folder of a run: there is no " +
                    path.string(),
                "write \"scene\", or give the folder of results, seen from the file that names it",
                diagnostics);
  blank.mesh_from = path.string();
}

} // namespace

BlankSpec read_blank(const TableView& section, const std::filesystem::path& folder,
                     Diagnostics& diagnostics) {
  BlankSpec blank;
  read_members(section, blank);
  if (text(section, "mesh").empty()) return blank;
  if (blank.mesh != MeshKind::file) {
    read_outline(section, folder, blank, diagnostics);
    read_zones(section, blank, diagnostics);
    read_mesh_from(section, folder, blank, diagnostics);
    return blank;
  }
  read_zones(section, blank, diagnostics);
  const TomlNode* file = given(section, "file");
  if (!file) return blank;
  blank.file = resolve_path(*file, folder).lexically_normal();
  if (std::error_code none; !std::filesystem::exists(blank.file, none)) // others: when it is read
    value_error(section, "file", "there is no file " + blank.file.string(),
                "give the path of a blank's mesh, seen from the file that names it", diagnostics);
  return blank;
}

} // namespace plyform
