// SPDX-License-Identifier: GPL-3.0-or-later
// Reads boundaries: grips, frames, planes of symmetry, springs and grippers.
#include "core/input/keys/key_member.hpp"
#include "core/input/parts/case_parts.hpp"
#include "core/model/boundary.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace plyform {

namespace {

/// Reads a fixed number of points; reports an error if there are more (check_section has reported
/// if there are fewer).
template <std::size_t count>
std::array<Vec2, count> read_points(const TableView& section, const std::string& key,
                                    Diagnostics& diagnostics) {
  std::array<Vec2, count> points;
  points.fill(Vec2::Zero());
  const std::vector<Vec2> found = pairs(section, key);
  if (found.size() > count)
    value_error(section, key, fmt::format("must have {} points, not {}", count, found.size()),
                "take the others out", diagnostics);
  for (std::size_t i = 0; i < std::min(count, found.size()); ++i)
    points[i] = found[i];
  return points;
}

void read_place(const TableView& section, Boundary& b, Diagnostics& diagnostics) {
  b.on_edge = given(section, "edge") != nullptr;
  const char* key = b.on_edge ? "edge" : "box";
  b.place = read_points<2>(section, key, diagnostics);
  if (given(section, key) && b.on_edge && b.place[0] == b.place[1])
    value_error(section, key, "has both ends in one place", "give two different ends", diagnostics);
}

/// The stroke or its programme, of a boundary that has either.
void read_stroke(const TableView& section, Boundary& b, Diagnostics& diagnostics) {
  if (given(section, "stroke_programme"))
    b.programme = read_programme(section, "stroke_programme", b.stroke, diagnostics);
}

void read_grip(const TableView& section, Boundary& b, Diagnostics& diagnostics) {
  const std::string hold = text(section, "hold");
  for (std::size_t k = 0; k < 3; ++k)
    b.held[k] = hold.find("xyz"[k]) != std::string::npos;
  b.direction = read_direction(section, "direction", diagnostics);
  for (int k = 0; k < 3; ++k)
    if (b.stroke > 0.0 && !hold.empty() && !b.held[k] && b.direction[k] != 0.0)
      return value_error(section, "direction",
                         fmt::format("has a part along {}, where hold = \"{}\" leaves the nodes "
                                     "free",
                                     "xyz"[k], hold),
                         "hold that direction too, or point the stroke elsewhere", diagnostics);
}

void read_frame(const TableView& section, Boundary& b, Diagnostics& diagnostics) {
  b.hinges = read_points<4>(section, "hinges", diagnostics);
  if (!given(section, "hinges")) return;
  const Vec2 u = b.hinges[1] - b.hinges[0], v = b.hinges[3] - b.hinges[0];
  const double size = u.norm() + v.norm(), area = u.x() * v.y() - u.y() * v.x();
  constexpr double rounding = 1e-6; // of the size
  if ((b.hinges[0] + u + v - b.hinges[2]).norm() > rounding * size)
    return value_error(section, "hinges", "are not the corners of a parallelogram in order",
                       "opposite bars must be parallel and of the same length", diagnostics);
  if (std::abs(area) <= rounding * size * size)
    return value_error(section, "hinges", "lie on one line", "open the frame", diagnostics);
  if (b.stroke >= longest_stroke(b))
    value_error(section, b.programme.empty() ? "stroke" : "stroke_programme",
                fmt::format("must be less than {:.4g} mm, where the bars are in one line",
                            longest_stroke(b)),
                "make the stroke shorter", diagnostics);
}

void read_plane(const TableView& section, Boundary& b, Diagnostics& diagnostics) {
  b.point = vector2(section, "point");
  const Vec2 normal = vector2(section, "normal");
  const double length = normal.norm();
  if (!std::isfinite(length)) return; // missing or invalid; has been reported
  if (length > 0.0)
    b.normal = normal / length;
  else
    value_error(section, "normal", "must not be the zero vector", "give a vector across the plane",
                diagnostics);
}

void read_gripper(const TableView& section, Boundary& b, Diagnostics& diagnostics) {
  b.direction = read_direction(section, "direction", diagnostics);
  if (given(section, "force_programme")) {
    b.programme = read_programme(section, "force_programme", b.force, diagnostics);
    if (b.force == 0.0)
      value_error(section, "force_programme", "has no force above 0",
                  "give the gripper a force, or take it out", diagnostics);
  }
  for (const char* key : {"stroke", "stroke_programme"})
    if (given(section, key) && !given(section, "stiffness"))
      value_error(
          section, key, "belongs to a gripper with a drive, this one is pulled by a force",
          "take one of the two out, or give the drive's stiffness in the place of the force",
          diagnostics);
}

void read_spring(const TableView& section, Boundary& b, const std::vector<Tool>& tools,
                 Diagnostics& diagnostics) {
  if (b.preload > b.max_force)
    value_error(section, "preload", fmt::format("is more than max_force, {:g} N", b.max_force),
                "preload it less, or raise max_force", diagnostics);
  if (!given(section, "carried_by")) return;
  const auto it = std::find_if(tools.begin(), tools.end(), [&](const Tool& tool) {
    return tool.name == text(section, "carried_by");
  });
  b.carrier = static_cast<int>(it - tools.begin());
  if (it == tools.end())
    value_error(section, "carried_by", "names no tool of this case",
                "leave it out to keep the anchor where it is", diagnostics);
  else if (it->motion == Motion::force)
    value_error(section, "carried_by",
                "names a tool under a force, which does not feel what the spring pulls it with",
                "name a driven tool, or leave it out to keep the anchor where it is", diagnostics);
}

} // namespace

std::vector<Boundary> read_boundaries(const TableView& root, const std::vector<Ply>& plies,
                                      const std::vector<Tool>& tools, Diagnostics& diagnostics) {
  std::vector<Boundary> boundaries;
  for (const TableView& section : subsections(root, "boundary")) {
    Boundary b;
    read_members(section, b);
    if (given(section, "ply")) {
      const auto it = std::find_if(plies.begin(), plies.end(), [&](const Ply& ply) {
        return ply.name == text(section, "ply");
      });
      if (it == plies.end())
        value_error(section, "ply", "names no ply of this case", "leave it out to hold all plies",
                    diagnostics);
      else
        b.ply = static_cast<int>(it - plies.begin());
    }
    if (given(section, "kind")) {
      const bool spring = b.kind == BoundaryKind::spring, gripper = b.kind == BoundaryKind::gripper;
      if (b.kind == BoundaryKind::grip || spring || gripper) read_place(section, b, diagnostics);
      if (b.kind != BoundaryKind::symmetry && !spring) read_stroke(section, b, diagnostics);
      if (spring) read_spring(section, b, tools, diagnostics);
      if (gripper) read_gripper(section, b, diagnostics);
      if (b.kind == BoundaryKind::grip) read_grip(section, b, diagnostics);
      if (b.kind == BoundaryKind::frame) read_frame(section, b, diagnostics);
      if (b.kind == BoundaryKind::symmetry) read_plane(section, b, diagnostics);
    }
    boundaries.push_back(b);
  }
  return boundaries;
}

} // namespace plyform
