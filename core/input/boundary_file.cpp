// SPDX-License-Identifier: GPL-3.0-or-later
// Reads boundaries: grips, frames and planes of symmetry.
#include "core/input/case_parts.hpp"
#include "core/input/key_member.hpp"
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

void read_grip(const TableView& section, Boundary& b, Diagnostics& diagnostics) {
  b.on_edge = given(section, "edge") != nullptr;
  const char* key = b.on_edge ? "edge" : "box";
  b.place = read_points<2>(section, key, diagnostics);
  if (given(section, key) && b.on_edge && b.place[0] == b.place[1])
    value_error(section, key, "has both ends in one place", "give two different ends", diagnostics);
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
    value_error(section, "stroke",
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

} // namespace

std::vector<Boundary> read_boundaries(const TableView& root, const std::vector<Ply>& plies,
                                      Diagnostics& diagnostics) {
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
      if (b.kind == BoundaryKind::grip) read_grip(section, b, diagnostics);
      if (b.kind == BoundaryKind::frame) read_frame(section, b, diagnostics);
      if (b.kind == BoundaryKind::symmetry) read_plane(section, b, diagnostics);
    }
    boundaries.push_back(b);
  }
  return boundaries;
}

} // namespace plyform
