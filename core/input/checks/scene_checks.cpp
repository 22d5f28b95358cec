// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/input/checks/scene_checks.hpp"

#include "base/format.hpp"
#include "core/input/checks/load_checks.hpp"
#include "core/input/checks/tool_overlap.hpp"
#include "core/mesh/mesh_ply.hpp"
#include "core/model/motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <tuple>

namespace plyform {

namespace {

struct SceneCheck {
  const Case& scene;
  const CaseParts& parts;
  Diagnostics& diagnostics;
  std::vector<FlatPly> plies{};
  std::vector<TriMesh> surfaces{}; ///< of the tools, in space
  double bottom = 0.0, top = 0.0;  ///< mm, of the stack
  Eigen::AlignedBox2d bounds{};    ///< of all plies
  double stack = 0.0;              ///< mm, thickness of all plies together
  double touching = 0.0;           ///< mm, touch_depth of the plies

  void tool_error(std::size_t tool, const std::string& rule, const std::string& remedy) {
    diagnostics.error(parts.tools[tool].at, parts.tools[tool].item, scene.tools[tool].name, rule,
                      remedy);
  }
};

const Fabric& fabric_of(const Case& scene, const Ply& ply) {
  return scene.fabrics[ply.fabric];
}

/// The mesh of a ply's blank; reports an error, once per blank, and returns nothing if that fails.
std::optional<BlankMesh> try_mesh(SceneCheck& check, const Ply& ply, std::set<int>& reported) {
  const std::string& drawing = check.scene.blanks[ply.blank].drawing;
  try {
    return mesh_ply(check.scene, ply);
  } catch (const std::runtime_error& error) {
    if (!reported.insert(ply.blank).second) return std::nullopt;
    const SourceLocation& place = check.parts.blanks[ply.blank];
    check.diagnostics.error_from(place.at, place.item, "",
                                 "cannot be meshed: " + drawing + (drawing.empty() ? "" : ": "),
                                 error.what());
    return std::nullopt;
  }
}

/// Warns of a mesh that cannot show how a ply forms: nothing bends or shears beside anything else.
void warn_of_few(SceneCheck& check, const Ply& ply, const BlankMesh& mesh) {
  constexpr std::size_t few = 4;
  if (mesh.triangles.size() >= few) return;
  const SourceLocation& place = check.parts.blanks[ply.blank];
  check.diagnostics.warning(
      place.at,
      fmt::format("{}: has {} triangle{}, too few for a ply that forms: forces and the "
                  "balance of energies mean nothing; give smaller elements",
                  place.item, mesh.triangles.size(), mesh.triangles.size() == 1 ? "" : "s"));
}

/// Meshes all plies; false if one cannot be meshed.
bool lay_plies(SceneCheck& check) {
  // the angle matters for MeshKind::fibres only
  std::map<std::tuple<int, double, int, double, double, double>, BlankMesh> meshes;
  std::set<int> reported;
  for (const Ply& ply : check.scene.plies) {
    const BlankSpec& blank = check.scene.blanks[ply.blank];
    const bool by_angle = blank.mesh == MeshKind::fibres;
    const std::tuple key(ply.blank, by_angle ? ply.angle : 0.0, by_angle ? ply.fabric : 0,
                         ply.seed.x(), ply.seed.y(), ply.rotation);
    if (!meshes.contains(key)) {
      std::optional<BlankMesh> mesh = try_mesh(check, ply, reported);
      if (!mesh) continue;
      warn_of_few(check, ply, *mesh);
      meshes.emplace(key, std::move(*mesh));
    }
    check.plies.push_back(
        make_flat_ply(meshes.at(key), ply.z, fabric_of(check.scene, ply).thickness));
  }
  check.bottom = std::numeric_limits<double>::infinity();
  check.top = -check.bottom;
  for (const FlatPly& ply : check.plies) {
    check.bottom = std::min(check.bottom, ply.z - ply.half);
    check.top = std::max(check.top, ply.z + ply.half);
    check.bounds.extend(ply.bounds);
    check.stack += 2.0 * ply.half;
  }
  check.touching = touch_depth(check.plies);
  return reported.empty();
}

/// Reports plies whose bounding rectangles are nearer each other than half the sum of their
/// thicknesses: contact between their edges would push them apart, too.
void check_plies_apart(SceneCheck& check) {
  for (std::size_t b = 0; b < check.plies.size(); ++b)
    for (std::size_t a = 0; a < b; ++a) {
      const FlatPly &pa = check.plies[a], &pb = check.plies[b];
      const double beside = pa.bounds.exteriorDistance(pb.bounds);
      const double apart = std::hypot(beside, pb.z - pa.z), needed = pa.half + pb.half;
      if (apart >= needed - check.touching) continue;
      check.diagnostics.error(
          check.parts.plies[b].at, check.parts.plies[b].item, check.scene.plies[b].name,
          fmt::format(
              "overlaps ply {} at the start: the mid-surfaces are {:.4g} mm apart{} and need "
              "{:.4g} mm",
              check.scene.plies[a].name, apart, beside > 0.0 ? ", edge to edge," : "", needed),
          beside > 0.0
              ? "move one of them aside, or lay it on the other"
              : "change z of one of them, or leave z out to lay each ply on the one below");
      break; // one report per ply
    }
}

/// Greatest depth of a tool inside a ply, and all points of plies that are inside the tool.
struct Intrusion {
  double touching = 0.0; ///< mm, what is no deeper does not count
  double depth = 0.0;
  std::size_t ply = 0;
  Vec3 where = Vec3::Zero();
  std::vector<Vec2> lines;
  void add(double depth_here, std::size_t ply_here, const Vec3& p) {
    if (!(depth_here > touching)) return;
    lines.push_back(p.head<2>());
    if (depth_here <= depth) return;
    depth = depth_here;
    ply = ply_here;
    where = p;
  }
};

/// Tests nodes by their distance to the tool, and points of the tool's surface by their distance to
/// the flat ply, which finds tools that penetrate between nodes.
Intrusion find_intrusion(const SceneCheck& check, std::size_t tool_number) {
  const Tool& tool = check.scene.tools[tool_number];
  const double touching = check.touching;
  Intrusion found;
  found.touching = touching;
  SurfaceHint hint; // neighbouring nodes have neighbouring closest triangles
  for (std::size_t i = 0; i < check.plies.size(); ++i) {
    const FlatPly& ply = check.plies[i];
    for (const Vec2& x : ply.mesh.x) {
      const Vec3 p(x.x(), x.y(), ply.z);
      found.add(ply.half - tool_distance(tool, Vec3::Zero(), p, hint), i, p);
    }
    visit_slab(check.surfaces[tool_number], ply.z - ply.half + touching,
               ply.z + ply.half - touching, [&](const Vec3& p) {
                 const double depth = ply.half - std::abs(p.z() - ply.z);
                 // Facets may span a hole: only points that really are in the tool count.
                 if (depth > touching && covers(ply, p.head<2>()) &&
                     tool_distance(tool, Vec3::Zero(), p, hint) <= touching)
                   found.add(depth, i, p);
               });
  }
  return found;
}

/// The smallest clearance (mm) of two tools along any of the vertical lines through plies.
struct Clearance {
  double room = std::numeric_limits<double>::infinity(), needed = 0.0;
  std::size_t other = 0;
  Vec2 where = Vec2::Zero();
};

void clearance_on_line(const SceneCheck& check, std::size_t tool, const Vec2& xy,
                       Clearance& least) {
  double needed = 0.0;
  for (const FlatPly& ply : check.plies)
    if (covers(ply, xy)) needed += 2.0 * ply.half;
  const double low = check.bottom - check.stack, high = check.top + check.stack;
  const double middle = 0.5 * (check.bottom + check.top);
  const auto own = occupied(check.scene.tools[tool], xy, low, high);
  for (std::size_t other = 0; other < check.scene.tools.size(); ++other) {
    if (other == tool) continue;
    for (const auto& theirs : occupied(check.scene.tools[other], xy, low, high))
      for (const auto& mine : own) {
        const auto &under = mine.first < theirs.first ? mine : theirs,
                   &over = mine.first < theirs.first ? theirs : mine;
        const double room = over.first - under.second;
        const bool facing = under.first + under.second < 2.0 * middle &&
                            over.first + over.second > 2.0 * middle && room >= 0.0;
        if (facing && room < needed - check.touching && room < least.room)
          least = {room, needed, other, xy};
      }
  }
}

/// Whether the tool is an open mesh that no ply would touch if its faces were turned round.
bool inside_out(const SceneCheck& check, std::size_t tool_number) {
  const Tool& tool = check.scene.tools[tool_number];
  if (!std::holds_alternative<MeshShapePtr>(tool.shape) || is_closed(check.surfaces[tool_number]))
    return false;
  SurfaceHint hint;
  for (const FlatPly& ply : check.plies)
    for (const Vec2& x : ply.mesh.x)
      if (-tool_distance(tool, Vec3::Zero(), Vec3(x.x(), x.y(), ply.z), hint) <
          ply.half - check.touching)
        return false;
  return true;
}

/// Reports tools inside plies, or, if another tool is opposite, that their clearance is too small.
void check_tools_outside(SceneCheck& check) {
  std::set<std::pair<std::size_t, std::size_t>> reported;
  for (std::size_t tool = 0; tool < check.scene.tools.size(); ++tool) {
    const Intrusion found = find_intrusion(check, tool);
    if (!(found.depth > check.touching)) continue;
    Clearance least;
    // About 300 lines are enough to find the smallest clearance.
    const std::size_t stride = std::max<std::size_t>(1, found.lines.size() / 300);
    for (std::size_t i = 0; i < found.lines.size(); i += stride)
      clearance_on_line(check, tool, found.lines[i], least);
    if (!std::isfinite(least.room) && inside_out(check, tool)) {
      check.tool_error(tool,
                       fmt::format("takes the side of ply {} for its inside: its mesh is open, and "
                                   "its faces are turned the wrong way",
                                   check.scene.plies[found.ply].name),
                       "turn its faces round (flip the normals) where it was made, or close it to "
                       "a solid");
    } else if (!std::isfinite(least.room)) {
      check.tool_error(tool,
                       fmt::format("lies inside ply {} at the start, {:.4g} mm deep at ({:.4g}, "
                                   "{:.4g}, {:.4g})",
                                   check.scene.plies[found.ply].name, found.depth, found.where.x(),
                                   found.where.y(), found.where.z()),
                       "move the tool (position) or the stack (stack.bottom) so that they at most "
                       "touch");
    } else if (reported.insert(std::minmax(tool, least.other)).second) {
      check.tool_error(
          tool,
          fmt::format("leaves a clearance of {:.4g} mm to tool {} at ({:.4g}, {:.4g}), "
                      "less than the {:.4g} mm of the plies between them",
                      least.room, check.scene.tools[least.other].name, least.where.x(),
                      least.where.y(), least.needed),
          fmt::format("move the tools {:.4g} mm apart, or take plies out",
                      least.needed - least.room));
    }
  }
}

Vec3 stroke_of(const Tool& tool) {
  return tool.motion == Motion::driven ? Vec3(motion_at(tool, 1.0, 1.0) * tool.direction)
                                       : Vec3(Vec3::Zero());
}

/// The smallest distance (mm) of two tools at the end of their strokes, in the area of the plies;
/// below 0 if one is in the other.
double room_at_end(const SceneCheck& check, std::size_t a, std::size_t b) {
  const std::vector<Tool>& tools = check.scene.tools;
  const PlacedTool first{tools[a], check.surfaces[a], stroke_of(tools[a])},
      second{tools[b], check.surfaces[b], stroke_of(tools[b])};
  const double little = 0.02 * check.stack;
  const double room = std::min(least_gap(first, second, check.bounds, check.stack, little).gap,
                               least_gap(second, first, check.bounds, check.stack, little).gap);
  if (room > 2.0 * little) return room;
  const double overlap = deepest_overlap(first, second, check.bounds, check.touching).gap;
  return std::isfinite(overlap) ? overlap : std::max(room, 0.0);
}

bool any_gives_way(const SceneCheck& check) {
  return std::any_of(check.scene.fabrics.begin(), check.scene.fabrics.end(),
                     [](const Fabric& fabric) { return fabric.compaction.has_value(); });
}

/// mm, thickness of all plies together, of those that give way in their densest packing.
double densest_stack(const SceneCheck& check) {
  double sum = 0.0;
  for (const Ply& ply : check.scene.plies)
    sum += fabric_of(check.scene, ply).least_thickness();
  return sum;
}

/// Checks the distance of each driven tool to the other tools at the end of its stroke. A tool
/// under a force is assumed at its initial position; as it can move, the result is a warning only.
void check_end_of_stroke(SceneCheck& check) {
  const std::vector<Tool>& tools = check.scene.tools;
  for (std::size_t a = 0; a < tools.size(); ++a) {
    if (tools[a].motion != Motion::driven) continue;
    for (std::size_t b = 0; b < tools.size(); ++b) {
      if (b == a || (tools[b].motion == Motion::driven && b < a)) continue;
      const double room = room_at_end(check, a, b);
      if (room < 0.0 && tools[b].motion != Motion::force)
        check.tool_error(a,
                         fmt::format("goes {:.4g} mm into tool {} at the end of the stroke", -room,
                                     tools[b].name),
                         "shorten the stroke, or move one of the two");
      else if (room < densest_stack(check) - 2.0 * check.touching)
        check.diagnostics.warning(
            check.parts.tools[a].at,
            fmt::format("{} = {}: comes within {:.4g} mm of tool {} at the end of the stroke, less "
                        "than the {:.4g} mm of the stack{}",
                        check.parts.tools[a].item, tools[a].name, std::max(room, 0.0),
                        tools[b].name, densest_stack(check),
                        any_gives_way(check) ? " in its densest packing" : ""));
    }
  }
}

void make_surfaces(SceneCheck& check) {
  double size = std::numeric_limits<double>::infinity();
  for (const BlankSpec& blank : check.scene.blanks)
    if (blank.element_size > 0.0) size = std::min(size, blank.element_size);
  if (!std::isfinite(size)) size = check.bounds.diagonal().norm() / 100.0;
  double reach = 0.0; // of the plies, from the origin
  for (const FlatPly& ply : check.plies)
    for (const Vec2& x : ply.mesh.x)
      reach = std::max(reach, x.norm());
  reach += std::max(std::abs(check.bottom), std::abs(check.top));
  for (const Tool& tool : check.scene.tools)
    check.surfaces.push_back(
        tool_surface(tool, size, reach + tool.position.norm() + stroke_of(tool).norm()));
}

} // namespace

std::vector<BlankMesh> check_scene(const Case& scene, const CaseParts& parts,
                                   Diagnostics& diagnostics) {
  SceneCheck check{scene, parts, diagnostics};
  const bool meshed = lay_plies(check);
  if (!meshed) return {};
  check_plies_apart(check);
  make_surfaces(check);
  check_boundaries(scene, parts, check.plies, check.surfaces, diagnostics);
  check_attachments(scene, parts, check.plies, diagnostics);
  check_loads(scene, parts, check.plies, diagnostics);
  check_tools_outside(check);
  if (diagnostics.errors.empty())
    check_motions(scene, parts, check.plies, check.surfaces, diagnostics);
  if (diagnostics.errors.empty()) check_end_of_stroke(check);
  std::vector<BlankMesh> meshes;
  for (FlatPly& ply : check.plies)
    meshes.push_back(std::move(ply.mesh));
  return meshes;
}

} // namespace plyform
