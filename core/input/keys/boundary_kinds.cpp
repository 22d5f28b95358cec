// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/input/keys/boundary_kinds.hpp"

#include "base/format.hpp"
#include "core/input/keys/key_member.hpp"
#include "core/input/keys/motion_keys.hpp"
#include "core/model/boundary.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {

namespace {

/// Arguments of the readers of kinds.
struct BoundarySection {
  const TableView& section;
  const NamedTools& named;
  Diagnostics& diagnostics;

  void error(const char* key, const std::string& rule, const std::string& remedy) const {
    value_error(section, key, rule, remedy, diagnostics);
  }
};

/// Reads a fixed number of points; reports an error if there are more (check_section has reported
/// if there are fewer).
template <std::size_t count>
std::array<Vec2, count> fixed_points(const BoundarySection& s, const char* key) {
  std::array<Vec2, count> points;
  points.fill(Vec2::Zero());
  const std::vector<Vec2> found = pairs(s.section, key);
  if (found.size() > count)
    s.error(key, fmt::format("must have {} points, not {}", count, found.size()),
            "take the others out");
  for (std::size_t i = 0; i < std::min(count, found.size()); ++i)
    points[i] = found[i];
  return points;
}

HeldPlace read_place(const BoundarySection& s) {
  HeldPlace place;
  place.on_edge = given(s.section, "edge") != nullptr;
  const char* key = place.on_edge ? "edge" : "box";
  place.ends = fixed_points<2>(s, key);
  if (given(s.section, key) && place.on_edge && place.ends[0] == place.ends[1])
    s.error(key, "has both ends in one place", "give two different ends");
  return place;
}

/// The programme of a stroke, if there is one.
template <class Kind>
void read_stroke(const BoundarySection& s, Kind& kind) {
  if (given(s.section, "stroke_programme"))
    kind.programme = read_programme(s.section, "stroke_programme", kind.stroke, s.diagnostics);
}

BoundaryKind read_grip(const BoundarySection& s) {
  Grip grip;
  read_members(s.section, grip);
  grip.place = read_place(s);
  read_stroke(s, grip);
  const std::string hold = text(s.section, "hold");
  for (std::size_t k = 0; k < 3; ++k)
    grip.held[k] = hold.find("xyz"[k]) != std::string::npos;
  grip.direction = read_direction(s.section, "direction", s.diagnostics);
  for (std::size_t k = 0; k < 3; ++k)
    if (grip.stroke > 0.0 && !hold.empty() && !grip.held[k] &&
        grip.direction[static_cast<Eigen::Index>(k)] != 0.0) {
      s.error("direction",
              fmt::format("has a part along {}, where hold = \"{}\" leaves the nodes free",
                          "xyz"[k], hold),
              "hold that direction too, or point the stroke elsewhere");
      break;
    }
  return grip;
}

void check_hinges(const BoundarySection& s, const HingedFrame& frame) {
  const Vec2 u = frame.hinges[1] - frame.hinges[0], v = frame.hinges[3] - frame.hinges[0];
  const double size = u.norm() + v.norm(), area = u.x() * v.y() - u.y() * v.x();
  constexpr double rounding = 1e-6; // of the size
  if ((frame.hinges[0] + u + v - frame.hinges[2]).norm() > rounding * size)
    return s.error("hinges", "are not the corners of a parallelogram in order",
                   "opposite bars must be parallel and of the same length");
  if (std::abs(area) <= rounding * size * size)
    return s.error("hinges", "lie on one line", "open the frame");
  if (frame.stroke >= longest_stroke(frame))
    s.error(frame.programme.empty() ? "stroke" : "stroke_programme",
            fmt::format("must be less than {:.4g} mm, where the bars are in one line",
                        longest_stroke(frame)),
            "make the stroke shorter");
}

BoundaryKind read_frame(const BoundarySection& s) {
  HingedFrame frame;
  read_members(s.section, frame);
  read_stroke(s, frame);
  frame.hinges = fixed_points<4>(s, "hinges");
  if (given(s.section, "hinges")) check_hinges(s, frame);
  return frame;
}

BoundaryKind read_plane(const BoundarySection& s) {
  SymmetryPlane plane;
  plane.point = vector2(s.section, "point");
  const Vec2 normal = vector2(s.section, "normal");
  const double length = normal.norm();
  if (!std::isfinite(length)) return plane; // missing or invalid; has been reported
  if (length > 0.0)
    plane.normal = normal / length;
  else
    s.error("normal", "must not be the zero vector", "give a vector across the plane");
  return plane;
}

BoundaryKind read_spring(const BoundarySection& s) {
  TensionSpring spring;
  read_members(s.section, spring);
  spring.place = read_place(s);
  if (spring.preload > spring.max_force)
    s.error("preload", fmt::format("is more than max_force, {:g} N", spring.max_force),
            "preload it less, or raise max_force");
  if (!given(s.section, "carried_by")) return spring;
  const std::vector<Tool>& tools = s.named.tools;
  const auto it = std::find_if(tools.begin(), tools.end(), [&](const Tool& tool) {
    return tool.name == text(s.section, "carried_by");
  });
  spring.carrier = static_cast<int>(it - tools.begin());
  if (it == tools.end() && s.named.all_known)
    s.error("carried_by", "names no tool of this case",
            "leave it out to keep the anchor where it is");
  else if (it == tools.end())
    return spring;
  else if (it->motion == Motion::force)
    s.error("carried_by",
            "names a tool under a force, which does not feel what the spring pulls it with",
            "name a driven tool, or leave it out to keep the anchor where it is");
  return spring;
}

BoundaryKind read_gripper(const BoundarySection& s) {
  Gripper gripper;
  read_members(s.section, gripper);
  gripper.place = read_place(s);
  read_stroke(s, gripper);
  gripper.direction = read_direction(s.section, "direction", s.diagnostics);
  if (given(s.section, "force_programme")) {
    gripper.programme = read_programme(s.section, "force_programme", gripper.force, s.diagnostics);
    if (gripper.force == 0.0)
      s.error("force_programme", "has no force above 0",
              "give the gripper a force, or take it out");
  }
  for (const char* key : {"stroke", "stroke_programme"})
    if (given(s.section, key) && !given(s.section, "stiffness"))
      s.error(key, "belongs to a gripper with a drive, this one is pulled by a force",
              "take one of the two out, or give the drive's stiffness in the place of the force");
  return gripper;
}

struct BoundaryInput {
  const char* word;
  BoundaryKind (*read)(const BoundarySection& section);
};

constexpr BoundaryInput boundary_kinds[] = {{"grip", read_grip},
                                            {"frame", read_frame},
                                            {"symmetry", read_plane},
                                            {"spring", read_spring},
                                            {"gripper", read_gripper}};

} // namespace

std::vector<std::string> boundary_words() {
  std::vector<std::string> words;
  for (const BoundaryInput& kind : boundary_kinds)
    words.emplace_back(kind.word);
  return words;
}

BoundaryKind read_boundary_kind(const TableView& section, const NamedTools& tools,
                                Diagnostics& diagnostics) {
  for (const BoundaryInput& kind : boundary_kinds)
    if (text(section, "kind") == kind.word) return kind.read({section, tools, diagnostics});
  return {}; // an unknown word has been reported
}

} // namespace plyform
