// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of boundaries that need the meshes of the plies.
#include "base/format.hpp"
#include "base/text.hpp"
#include "core/input/checks/mirror_images.hpp"
#include "core/input/checks/scene_checks.hpp"
#include "core/model/boundary.hpp"

#include <cmath>

namespace plyform {

namespace {

struct BoundaryCheck {
  const Case& scene;
  const CaseParts& parts;
  const std::vector<FlatPly>& plies;
  Diagnostics& diagnostics;

  void fail(std::size_t boundary, const std::string& rule, const std::string& remedy) {
    diagnostics.error(parts.boundaries[boundary].at, parts.boundaries[boundary].item,
                      scene.boundaries[boundary].name, rule, remedy);
  }
};

void check_holds_something(BoundaryCheck& check, std::size_t index) {
  for (std::size_t p = 0; p < check.plies.size(); ++p)
    for (const Vec2& x : check.plies[p].mesh.x)
      if (holds(check.scene.boundaries[index], static_cast<int>(p), x)) return;
  check.fail(index, "holds no node of any ply",
             "correct its place; nodes stand element_size apart, and those of free meshes not on "
             "lines inside the blank");
}

/// Of grips and frames.
bool share_an_axis(const Boundary& a, const Boundary& b) {
  const auto holds_along = [](const Boundary& x, std::size_t k) {
    return x.is<HingedFrame>() || x.as<Grip>().held[k];
  };
  for (std::size_t k = 0; k < 3; ++k)
    if (holds_along(a, k) && holds_along(b, k)) return true;
  return false;
}

/// Two boundaries that prescribe one node along the same axis must agree: both must be at rest.
void check_no_conflict(BoundaryCheck& check, std::size_t a, std::size_t b) {
  const Boundary &first = check.scene.boundaries[a], &second = check.scene.boundaries[b];
  const auto of_place = [](const Boundary& x) { return x.is<Grip>() || x.is<HingedFrame>(); };
  if (!of_place(first) || !of_place(second)) return;
  if ((stroke_of(first) == 0.0 && stroke_of(second) == 0.0) || !share_an_axis(first, second))
    return;
  for (std::size_t p = 0; p < check.plies.size(); ++p)
    for (const Vec2& x : check.plies[p].mesh.x)
      if (holds(first, static_cast<int>(p), x) && holds(second, static_cast<int>(p), x))
        return check.fail(b,
                          fmt::format("holds the node at ({:.4g}, {:.4g}) of ply {} that {} holds "
                                      "too",
                                      x.x(), x.y(), check.scene.plies[p].name, first.name),
                          "let their boxes, edges or bars not meet, or hold different directions");
}

/// The blanks must lie on one side of the plane of symmetry and have nodes on it.
void check_half_blank(BoundaryCheck& check, std::size_t index) {
  const Boundary& boundary = check.scene.boundaries[index];
  const auto& plane = boundary.as<SymmetryPlane>();
  for (std::size_t p = 0; p < check.plies.size(); ++p) {
    if (boundary.ply >= 0 && boundary.ply != static_cast<int>(p)) continue;
    double least = 0.0, most = 0.0;
    for (const Vec2& x : check.plies[p].mesh.x) {
      const double side = (x - plane.point).dot(plane.normal);
      least = std::min(least, side);
      most = std::max(most, side);
    }
    const double both = std::min(-least, most);
    if (both > 1e-3) // mm
      check.fail(index,
                 fmt::format("has the blank of ply {} on both sides, {:.4g} mm on the smaller one",
                             check.scene.plies[p].name, both),
                 "give the outline of the half that is modelled, ending on the plane");
  }
}

/// The fibre directions of each ply must be symmetric to the plane.
void check_fibres(BoundaryCheck& check, std::size_t index) {
  const Boundary& boundary = check.scene.boundaries[index];
  for (std::size_t p = 0; p < check.scene.plies.size(); ++p) {
    if (boundary.ply >= 0 && boundary.ply != static_cast<int>(p)) continue;
    const Ply& ply = check.scene.plies[p];
    const Fabric& fabric = check.scene.fabrics[ply.fabric];
    for (const std::string& what : broken_by_fibres(ply, fabric, boundary.as<SymmetryPlane>()))
      check.fail(
          index,
          fmt::format("is no plane of symmetry of ply {} at {:g} degrees: its mirror image {}",
                      ply.name, ply.angle / degree, what),
          "model the whole blank");
  }
}

/// Tools must be symmetric to the plane and remain so when they move.
void check_mirrored_tools(BoundaryCheck& check, std::size_t index,
                          const std::vector<TriMesh>& surfaces) {
  const auto& plane = check.scene.boundaries[index].as<SymmetryPlane>();
  // a fiftieth of a thickness, less than any contact depth
  const double same = 20.0 * touch_depth(check.plies);
  for (std::size_t t = 0; t < check.scene.tools.size(); ++t) {
    const Tool& tool = check.scene.tools[t];
    const Difference largest = difference_to_image(tool, tool, surfaces[t], plane);
    if (largest.beyond > same)
      check.fail(
          index,
          fmt::format("is no plane of symmetry of tool {}: its mirror image differs by "
                      "{:.3g} mm{}",
                      tool.name, largest.all,
                      largest.of_facets > same
                          ? fmt::format(", its facets account for {:.2g} mm", largest.of_facets)
                          : ""),
          "move the plane or the tool, or model the whole");
    else if (tool.motion != Motion::fixed && std::abs(tool.direction.dot(normal_of(plane))) > 1e-6)
      check.fail(index, fmt::format("is crossed by the motion of tool {}", tool.name),
                 "move the tool along the plane, or model the whole");
  }
}

/// Whether a boundary that moves has a stroke or, as a gripper, a force.
bool moves(const Boundary& b) {
  return stroke_of(b) > 0.0 || force_of(b) > 0.0;
}

/// Whether a boundary moves a node of the plane of symmetry out of it, or pulls it. (Those away
/// from the plane may move in any direction: the other half has their mirror images.)
bool crosses(const BoundaryCheck& check, const Boundary& plane, const Boundary& other) {
  const Vec3 normal = normal_of(plane.as<SymmetryPlane>());
  const double stroke = stroke_of(other);
  const double reach = stroke > 0.0 ? stroke : 1.0; // mm; of a force any length
  for (std::size_t p = 0; p < check.plies.size(); ++p)
    for (const Vec2& x : check.plies[p].mesh.x) {
      const int ply = static_cast<int>(p);
      if (!holds(plane, ply, x) || !holds(other, ply, x)) continue;
      const Vec3 X(x.x(), x.y(), 0.0);
      for (const double part : {0.5, 1.0}) // frames move on curves
        if (std::abs((prescribed_position(other, X, part * reach) - X).dot(normal)) > 1e-6 * reach)
          return true;
    }
  return false;
}

void check_mirrored_loads(BoundaryCheck& check, std::size_t index) {
  const Boundary& plane = check.scene.boundaries[index];
  if (std::abs(check.scene.gravity.dot(normal_of(plane.as<SymmetryPlane>()))) >
      1e-6 * check.scene.gravity.norm())
    check.fail(index, "is crossed by gravity", "turn it along the plane, or model the whole");
  for (const Boundary& other : check.scene.boundaries)
    if (moves(other) && crosses(check, plane, other))
      check.fail(index, fmt::format("is crossed by the motion of {}", other.name),
                 "move it along the plane or hold no node of the plane with it, or model the "
                 "whole");
}

} // namespace

void check_boundaries(const Case& scene, const CaseParts& parts, const std::vector<FlatPly>& plies,
                      const std::vector<TriMesh>& surfaces, Diagnostics& diagnostics) {
  BoundaryCheck check{scene, parts, plies, diagnostics};
  for (std::size_t b = 0; b < scene.boundaries.size(); ++b) {
    check_holds_something(check, b);
    for (std::size_t a = 0; a < b; ++a)
      check_no_conflict(check, a, b);
    if (!scene.boundaries[b].is<SymmetryPlane>()) continue;
    check_half_blank(check, b);
    check_fibres(check, b);
    check_mirrored_tools(check, b, surfaces);
    check_mirrored_loads(check, b);
  }
}

} // namespace plyform
