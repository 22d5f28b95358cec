// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/input/checks/sense_checks.hpp"

#include "base/format.hpp"
#include "core/input/checks/tool_overlap.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

struct SenseCheck {
  const Case& scene;
  const CaseParts& parts;
  const std::vector<FlatPly>& plies;
  const std::vector<ToolWay>& ways;
  const std::vector<TriMesh>& surfaces;
  Diagnostics& diagnostics;

  void warn(std::size_t tool, const std::string& text) {
    diagnostics.warning(parts.tools[tool].at, fmt::format("{} = {}: {}", parts.tools[tool].item,
                                                          scene.tools[tool].name, text));
  }
  const std::string& ply_name(std::size_t ply) const { return scene.plies[ply].name; }
};

/// A driven tool that hardly moves on after it has touched a ply.
void check_stroke(SenseCheck& check, std::size_t t) {
  const Tool& tool = check.scene.tools[t];
  const ToolWay& way = check.ways[t];
  if (!std::isfinite(way.travel) || way.travel > tool.stroke) return;
  constexpr double pressing = 0.25; // of a thickness; less than that only presses
  const double thickness = 2.0 * check.plies[way.first].half, on = tool.stroke - way.travel;
  if (on > pressing * thickness) return;
  check.warn(t, fmt::format("moves {:.3g} mm on after it has touched ply {}, which is {:.3g} mm "
                            "thick: hardly anything forms; the stroke is in mm, {:g} if {:g} is "
                            "meant in metres",
                            on, check.ply_name(way.first), thickness, 1000.0 * tool.stroke,
                            tool.stroke));
}

/// mm, the farthest that a surface reaches along a direction.
double reach_along(const TriMesh& surface, const Vec3& direction) {
  double most = -std::numeric_limits<double>::infinity();
  for (const Vec3& x : surface.x)
    most = std::max(most, x.dot(direction));
  return most;
}

/// A driven tool that goes on beyond the end of all open tools behind the plies: their surface ends
/// there in the file only, and what is drawn past it hangs on nothing.
void check_depth(SenseCheck& check, std::size_t t) {
  const Tool& tool = check.scene.tools[t];
  double plies = -std::numeric_limits<double>::infinity(), end = plies;
  for (const FlatPly& ply : check.plies)
    plies = std::max(plies, ply.z * tool.direction.z() + ply.half);
  std::size_t die = t;
  for (std::size_t o = 0; o < check.scene.tools.size(); ++o) {
    if (check.scene.tools[o].motion != Motion::fixed || !bounded_tool(check.scene.tools[o]))
      continue;
    const double reach = reach_along(check.surfaces[o], tool.direction);
    if (reach <= plies || reach <= end) continue; // on the punch's side of the plies
    end = reach;
    die = o;
  }
  if (die == t || std::abs(tool.direction.z()) < 0.5 || is_closed(check.surfaces[die])) return;
  const double beyond = reach_along(check.surfaces[t], tool.direction) + tool.stroke - end;
  if (beyond <= 0.05 * tool.stroke) return;
  check.warn(t, fmt::format("goes {:.4g} mm beyond the end of tool {}, whose surface is open and "
                            "ends {:.4g} mm below the plies, with its stroke of {:g} mm; shorten "
                            "the stroke, or make {} as long as it is",
                            beyond, check.scene.tools[die].name, end - plies, tool.stroke,
                            check.scene.tools[die].name));
}

/// What a pushed tool first lies on: mm2 of the ply, by its nodes.
double area_beneath(const SenseCheck& check, std::size_t t) {
  const Tool& tool = check.scene.tools[t];
  const ToolWay& way = check.ways[t];
  const FlatPly& ply = check.plies[way.first];
  double twice = 0.0;
  SurfaceHint hint;
  for (const Triangle& f : ply.mesh.triangles) {
    const Vec2 &a = ply.mesh.x[at(f[0])], &b = ply.mesh.x[at(f[1])], &c = ply.mesh.x[at(f[2])];
    const Vec2 m = (a + b + c) / 3.0;
    if (tool_distance(tool, way.travel * tool.direction, Vec3(m.x(), m.y(), ply.z), hint) >
        3.0 * ply.half)
      continue;
    twice += std::abs((b - a).x() * (c - a).y() - (b - a).y() * (c - a).x());
  }
  return 0.5 * twice;
}

/// A force that presses less than cloth weighs.
void check_force(SenseCheck& check, std::size_t t) {
  constexpr double least = 1e-4; // N/mm2; holders have 1e-3 to 1, cloth of 600 g/m2 weighs 6e-6
  const Tool& tool = check.scene.tools[t];
  const double area = area_beneath(check, t);
  if (!(area > 0.0) || tool.force >= least * area) return;
  const double weight =
      check.scene.fabrics[at(check.scene.plies[check.ways[t].first].fabric)].weight() * area;
  check.warn(t, fmt::format("presses by {:g} N on {:.2g} mm2 of ply {}, whose weight is {:.2g} N "
                            "there: that holds nothing, blank-holders usually press by 0.001 to 1 "
                            "N/mm2; the force is in N, {:g} if {:g} is meant in kN",
                            tool.force, area, check.ply_name(check.ways[t].first), weight,
                            1000.0 * tool.force, tool.force));
}

/// A pushed tool far above what it is to hold.
void check_fall(SenseCheck& check, std::size_t t) {
  constexpr double thicknesses = 10.0, little = 2.0; // mm
  const ToolWay& way = check.ways[t];
  double stack = 0.0;
  for (const FlatPly& ply : check.plies)
    stack += 2.0 * ply.half;
  if (way.travel <= std::max(thicknesses * stack, little)) return;
  check.warn(t, fmt::format("falls {:.4g} mm before it touches ply {}: nothing is held until then, "
                            "and it lands with an impact; start it on the stack (position)",
                            way.travel, check.ply_name(way.first)));
}

/// mm, the least width in plan of what a tool of a plain shape presses with; infinite of others.
double rim_of(const Tool& tool) {
  constexpr double upright = 0.9;
  const bool standing = std::abs(tool.rotation.col(2).z()) > upright;
  if (const auto* ring = std::get_if<Annulus>(&tool.shape); ring && standing)
    return ring->inner_radius > 0.0 ? ring->outer_radius - ring->inner_radius
                                    : 2.0 * ring->outer_radius;
  if (const auto* box = std::get_if<Box>(&tool.shape); box && standing)
    return box->size.head<2>().minCoeff();
  return std::numeric_limits<double>::infinity();
}

/// mm, the side of a square of two triangles, on the mean.
double mean_size(const FlatPly& ply) {
  double twice = 0.0;
  for (const Triangle& f : ply.mesh.triangles) {
    const Vec2 a = ply.mesh.x[at(f[0])], u = ply.mesh.x[at(f[1])] - a, v = ply.mesh.x[at(f[2])] - a;
    twice += std::abs(u.x() * v.y() - u.y() * v.x());
  }
  return std::sqrt(twice / static_cast<double>(ply.mesh.triangles.size()));
}

/// A holder that is narrower than the elements: contact is at nodes.
void check_rim(SenseCheck& check, std::size_t t) {
  const double rim = rim_of(check.scene.tools[t]);
  const double size = mean_size(check.plies[check.ways[t].first]);
  if (rim >= size) return;
  check.warn(t, fmt::format("is {:.3g} mm wide, less than the elements of ply {}, {:.3g} mm: it "
                            "touches few nodes or none, and contact is at nodes; take elements of "
                            "{:.2g} mm, or a wider one",
                            rim, check.ply_name(check.ways[t].first), size, 0.5 * rim));
}

} // namespace

void check_tool_sense(const Case& scene, const CaseParts& parts, const std::vector<FlatPly>& plies,
                      const std::vector<ToolWay>& ways, const std::vector<TriMesh>& surfaces,
                      Diagnostics& diagnostics) {
  SenseCheck check{scene, parts, plies, ways, surfaces, diagnostics};
  for (std::size_t t = 0; t < scene.tools.size(); ++t) {
    if (scene.tools[t].motion == Motion::driven) {
      check_stroke(check, t);
      check_depth(check, t);
    }
    const bool pushed = scene.tools[t].motion == Motion::force && scene.tools[t].force > 0.0;
    if (!pushed || !std::isfinite(ways[t].travel)) continue;
    check_force(check, t);
    check_fall(check, t);
    check_rim(check, t);
  }
}

void check_case_sense(const Case& scene, const CaseParts& parts, Diagnostics& diagnostics) {
  constexpr double weak = 0.1 * standard_gravity;
  const double gravity = scene.gravity.norm();
  if (gravity > 0.0 && gravity < weak)
    diagnostics.warning(parts.gravity.at,
                        fmt::format("{}: {:.4g} mm/s2 are {:.2g} of the earth's 9810; in mm/s2, "
                                    "[0, 0, -9810] for plies that lie flat",
                                    parts.gravity.item, gravity, gravity / standard_gravity));
}

} // namespace plyform
