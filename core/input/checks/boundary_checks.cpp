// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of boundaries that need the meshes of the plies.
#include "base/format.hpp"
#include "base/text.hpp"
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

Vec3 normal_of(const SymmetryPlane& plane) {
  return {plane.normal.x(), plane.normal.y(), 0.0};
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

/// Whether two directions (rad) are one line.
bool same_line(double a, double b) {
  return std::abs(std::sin(a - b)) < 1e-6;
}

/// Whether the mirror image of each direction of stitches has the same stitches. along: rad, of the
/// plane.
bool stitches_are_symmetric(const Ply& ply, const Fabric& fabric, double along) {
  const std::vector<Stitch>& all = fabric.stitches;
  return std::all_of(all.begin(), all.end(), [&](const Stitch& stitch) {
    return std::any_of(all.begin(), all.end(), [&](const Stitch& other) {
      return stitch.density == other.density && stitch.law == other.law &&
             same_line(2.0 * along - ply.angle - stitch.angle, ply.angle + other.angle);
    });
  });
}

/// Whether each crossing has the mirror image of its families and its law. image: of each family
/// the one that is its mirror image. A crossing whose families are each other's image shears as its
/// image does; any other the other way.
bool crossings_are_symmetric(const Fabric& fabric, const std::vector<std::size_t>& image) {
  const std::vector<Crossing>& all = fabric.crossings;
  return std::all_of(all.begin(), all.end(), [&](const Crossing& c) {
    const std::size_t first = image[c.first], second = image[c.second];
    if (first == c.second && second == c.first) return true;
    return c.shear.odd() && std::any_of(all.begin(), all.end(), [&](const Crossing& other) {
             return std::minmax(other.first, other.second) == std::minmax(first, second) &&
                    c.shear == other.shear;
           });
  });
}

/// The fibre directions of each ply must be symmetric to the plane.
void check_fibres(BoundaryCheck& check, std::size_t index) {
  const Boundary& boundary = check.scene.boundaries[index];
  const auto& plane = boundary.as<SymmetryPlane>();
  const double along = std::atan2(plane.normal.x(), -plane.normal.y());
  for (std::size_t p = 0; p < check.scene.plies.size(); ++p) {
    if (boundary.ply >= 0 && boundary.ply != static_cast<int>(p)) continue;
    const Ply& ply = check.scene.plies[p];
    const Fabric& fabric = check.scene.fabrics[ply.fabric];
    if (!fabric.has_yarns()) continue;
    if (!stitches_are_symmetric(ply, fabric, along))
      check.fail(index,
                 fmt::format("is no plane of symmetry of ply {} at {:g} degrees: its mirror image "
                             "has the stitches in other directions",
                             ply.name, ply.angle / degree),
                 "model the whole blank");
    const auto image_is_family = [&](const YarnFamily& family, const YarnFamily& other) {
      return same_line(2.0 * along - ply.angle - family.angle, ply.angle + other.angle);
    };
    const std::vector<YarnFamily>& families = fabric.families;
    std::vector<std::size_t> image; // of each family that has one
    bool own = true;                // whether each is its own
    for (std::size_t a = 0; a < families.size(); ++a) {
      std::size_t b = image_is_family(families[a], families[a]) ? a : 0;
      while (b < families.size() && !image_is_family(families[a], families[b]))
        ++b;
      if (b < families.size()) image.push_back(b);
      own = own && b == a;
    }
    const bool exchanged = image.size() == families.size();
    if (exchanged && (own || balanced(fabric))) {
      if (!crossings_are_symmetric(fabric, image))
        check.fail(
            index,
            fmt::format("is no plane of symmetry of ply {} at {:g} degrees: its mirror image "
                        "shears the other way, or at other crossings, and the laws of shear "
                        "of fabric {} differ",
                        ply.name, ply.angle / degree, fabric.name),
            "model the whole blank");
      continue;
    }
    std::vector<std::string> names;
    for (const YarnFamily& family : families)
      names.push_back(family.name);
    check.fail(index,
               exchanged
                   ? fmt::format("is no plane of symmetry of ply {} at {:g} degrees: its mirror "
                                 "image has {} exchanged, and in fabric {} they differ",
                                 ply.name, ply.angle / degree, joined(names, " and "), fabric.name)
                   : fmt::format("is no plane of symmetry of ply {} at {:g} degrees: its mirror "
                                 "image has the fibres in other directions",
                                 ply.name, ply.angle / degree),
               "model the whole blank");
  }
}

/// The place at which a tool's mirror image differs most, beyond what flat facets make of a curved
/// surface: two nodes that are each other's image on the surface may lie opposite to the middle of
/// a facet. Contact is with the half of the tool on the ply's side, so that this much does nothing.
struct Difference {
  double beyond = 0.0, all = 0.0, of_facets = 0.0; ///< mm
};

Difference difference_to_image(const Tool& tool, const TriMesh& surface,
                               const SymmetryPlane& plane) {
  const Vec3 normal = normal_of(plane), point(plane.point.x(), plane.point.y(), 0.0);
  const auto own_frame = [&](const Vec3& x) {
    return Vec3(tool.rotation.transpose() * (x - tool.position));
  };
  Difference largest;
  SurfaceHint hint, mirror_hint;
  const bool of_facets = std::holds_alternative<MeshShapePtr>(tool.shape); // x is on them
  for (const Vec3& x : surface.x) {
    const Vec3 mirrored = x - 2.0 * (x - point).dot(normal) * normal;
    const double own = of_facets ? 0.0 : tool_distance(tool, Vec3::Zero(), x, hint);
    const double all = std::abs(own - tool_distance(tool, Vec3::Zero(), mirrored, mirror_hint));
    if (all <= largest.beyond) continue;
    constexpr double margin = 1.5; // of an estimate
    const double facets = margin * (deflection_near(tool.shape, own_frame(x)) +
                                    deflection_near(tool.shape, own_frame(mirrored)));
    if (all - facets > largest.beyond) largest = {all - facets, all, facets};
  }
  return largest;
}

/// Tools must be symmetric to the plane and remain so when they move.
void check_mirrored_tools(BoundaryCheck& check, std::size_t index,
                          const std::vector<TriMesh>& surfaces) {
  const auto& plane = check.scene.boundaries[index].as<SymmetryPlane>();
  // a fiftieth of a thickness, less than any contact depth
  const double same = 20.0 * touch_depth(check.plies);
  for (std::size_t t = 0; t < check.scene.tools.size(); ++t) {
    const Tool& tool = check.scene.tools[t];
    const Difference largest = difference_to_image(tool, surfaces[t], plane);
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
