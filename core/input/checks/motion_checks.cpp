// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/input/checks/motion_checks.hpp"

#include "base/format.hpp"
#include "core/input/checks/scene_checks.hpp"
#include "core/input/checks/sense_checks.hpp"
#include "core/input/checks/tool_overlap.hpp"
#include "core/model/boundary.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::size_t most_nodes = 500, most_points = 20000; // asked: of a ply, of a tool's surface

std::size_t stride_for(std::size_t count, std::size_t most) {
  return std::max<std::size_t>(1, count / most);
}

/// Whether the tool, `distance` from p after its way so far, goes away from p and not on to it or
/// along it.
bool leaves(const Tool& tool, double travel, const Vec3& p, double distance, SurfaceHint& hint) {
  constexpr double little = 0.05, cosine = 0.1; // mm, of the way on
  const double next = tool_distance(tool, (travel + little) * tool.direction, p, hint);
  return next - distance > cosine * little;
}

/// mm that the tool moves along its direction until its surface is `half` from p; infinite if not
/// within `reach`. Steps by the distance, which is never too far.
double travel_to(const Tool& tool, const Vec3& p, double half, double reach, SurfaceHint& hint) {
  constexpr double touch = 1e-3; // mm
  constexpr int most_steps = 200;
  double travel = 0.0;
  for (int i = 0; i < most_steps && travel <= reach; ++i) {
    const double gap = tool_distance(tool, travel * tool.direction, p, hint) - half;
    if (gap < touch && leaves(tool, travel, p, gap + half, hint)) return infinity;
    if (gap < touch) return travel;
    travel += gap;
  }
  return infinity;
}

/// The same for a point of the tool's surface, until it comes to a face of the flat ply.
double travel_of_point(const Vec3& x, const Vec3& direction, const FlatPly& ply) {
  if (std::abs(direction.z()) < 1e-9) return infinity;
  const double face = ply.z - std::copysign(ply.half, direction.z());
  const double travel = (face - x.z()) / direction.z();
  if (travel < -std::max(1e-3, touch_depth({&ply, 1}))) return infinity;
  const Vec3 there = x + travel * direction;
  return covers(ply, there.head<2>()) ? std::max(travel, 0.0) : infinity;
}

struct MotionCheck {
  const Case& scene;
  const CaseParts& parts;
  const std::vector<FlatPly>& plies;
  const std::vector<TriMesh>& surfaces;
  Diagnostics& diagnostics;
  std::vector<ToolWay> ways{};
  Eigen::AlignedBox2d bounds{}; ///< of all plies

  void error(std::size_t tool, const std::string& rule, const std::string& remedy) {
    diagnostics.error(parts.tools[tool].at, parts.tools[tool].item, scene.tools[tool].name, rule,
                      remedy);
  }
  void warning(std::size_t tool, const std::string& text) {
    diagnostics.warning(parts.tools[tool].at, fmt::format("{} = {}: {}", parts.tools[tool].item,
                                                          scene.tools[tool].name, text));
  }
  const std::string& ply_name(std::size_t ply) const { return scene.plies[ply].name; }
};

/// Whether the tool touches a ply where it stands by the end of its stroke.
bool arrives(const Tool& tool, const ToolWay& way) {
  return tool.motion == Motion::driven && way.travel <= tool.stroke;
}

/// Whether anything but tool `but` may move a ply away from where it lies: then a tool that misses
/// the plies as they lie may meet them later.
bool plies_move_without(const MotionCheck& check, std::size_t but) {
  const Case& scene = check.scene;
  for (std::size_t t = 0; t < scene.tools.size(); ++t)
    if (t != but && arrives(scene.tools[t], check.ways[t])) return true;
  return !pushes(scene).empty() ||
         std::any_of(scene.boundaries.begin(), scene.boundaries.end(),
                     [](const Boundary& b) { return stroke_of(b) != 0.0 || !prescribes(b); });
}

void check_driven(MotionCheck& check, std::size_t t) {
  const Tool& tool = check.scene.tools[t];
  const ToolWay& way = check.ways[t];
  if (way.travel <= tool.stroke) return;
  const bool later = plies_move_without(check, t);
  std::string what, remedy;
  if (std::isfinite(way.travel)) {
    what = fmt::format("reaches no ply: ply {} is {:.4g} mm away along its direction, the stroke "
                       "is {:.4g} mm",
                       check.ply_name(way.first), way.travel, tool.stroke);
    remedy = "make the stroke longer, or let it start nearer (position)";
  } else {
    what = fmt::format("moves past all plies or away from them: none lies on its way along "
                       "[{:.3g}, {:.3g}, {:.3g}]",
                       tool.direction.x(), tool.direction.y(), tool.direction.z());
    remedy = "turn its direction, or move it (position)";
  }
  if (later)
    check.warning(t, what + "; it does nothing unless a ply is moved to it");
  else
    check.error(t, what, remedy);
}

void check_pushed(MotionCheck& check, std::size_t t) {
  const Tool& tool = check.scene.tools[t];
  if (tool.force == 0.0 || std::isfinite(check.ways[t].travel)) return;
  check.error(t,
              fmt::format("has nothing to push: no ply lies on its way along [{:.3g}, {:.3g}, "
                          "{:.3g}], and it would go on for ever",
                          tool.direction.x(), tool.direction.y(), tool.direction.z()),
              "turn its direction, or move it over a ply (position)");
}

bool move_alike(const Tool& a, const Tool& b) {
  if (a.motion != b.motion) return false;
  if (a.motion == Motion::fixed) return true;
  const bool same_way = (a.direction - b.direction).norm() < 1e-9;
  if (!same_way || a.motion == Motion::force) return same_way;
  return a.stroke == b.stroke && a.programme == b.programme;
}

/// Tools do not touch each other in the model: what begins in each other goes through. Pushed ones
/// that are pushed the same way may, but press on the same places of a ply.
void check_tools_apart(MotionCheck& check) {
  const double touching = 20.0 * touch_depth(check.plies); // a fiftieth of a thickness
  for (std::size_t a = 0; a < check.scene.tools.size(); ++a)
    for (std::size_t b = a + 1; b < check.scene.tools.size(); ++b) {
      const Tool &ta = check.scene.tools[a], &tb = check.scene.tools[b];
      const bool both_pushed = ta.motion == Motion::force && tb.motion == Motion::force;
      if (move_alike(ta, tb) && !both_pushed) continue;
      const auto [gap, where] =
          deepest_overlap({ta, check.surfaces[a]}, {tb, check.surfaces[b]}, check.bounds, touching);
      const double depth = -gap;
      if (!(depth > touching)) continue;
      const std::size_t moving = tb.motion != Motion::fixed ? b : a;
      if (move_alike(ta, tb)) {
        check.warning(b,
                      fmt::format("overlaps tool {}, {:.4g} mm deep at ({:.4g}, {:.4g}, {:.4g}): "
                                  "each moves under its own force, and both press on the plies "
                                  "there; move them apart",
                                  ta.name, depth, where.x(), where.y(), where.z()));
        continue;
      }
      check.error(moving,
                  fmt::format("overlaps tool {} at the start, {:.4g} mm deep at ({:.4g}, {:.4g}, "
                              "{:.4g}): tools do not hold each other, it would go through",
                              (moving == a ? tb : ta).name, depth, where.x(), where.y(), where.z()),
                  "move one of the two (position), or make room in one");
    }
}

std::string text(const Vec3& size) {
  return fmt::format("{:.4g} x {:.4g} x {:.4g} mm", size.x(), size.y(), size.z());
}

/// Mesh files that were made in another unit, first of all.
void check_extents(MotionCheck& check) {
  constexpr double odd = 50.0; // times larger or smaller than the blanks
  const double blank = check.bounds.diagonal().norm();
  for (std::size_t t = 0; t < check.scene.tools.size(); ++t) {
    const Tool& tool = check.scene.tools[t];
    if (!bounded_tool(tool)) continue;
    const Vec3 size = check.ways[t].extents.sizes();
    const double ratio = size.norm() / blank;
    if (ratio > 1.0 / odd && ratio < odd) continue;
    const std::string what =
        fmt::format("is {}, {:.2g} times as large as the {:.4g} x {:.4g} mm "
                    "of the plies",
                    text(size), ratio, check.bounds.sizes().x(), check.bounds.sizes().y());
    if (std::holds_alternative<MeshShapePtr>(tool.shape))
      check.error(t, what,
                  ratio < 1.0 ? "set scale: 1000 if the file is in metres, 25.4 if in inches"
                              : "set scale: 0.001 if the file is in micrometres");
    else
      check.warning(t, what + "; check its numbers");
  }
}

} // namespace

ToolWay way_of(const Tool& tool, const TriMesh& surface, const std::vector<FlatPly>& plies) {
  ToolWay way;
  for (const Vec3& x : surface.x)
    way.extents.extend(x);
  const bool moves = tool.motion != Motion::fixed;
  Box3 all = way.extents;
  for (const FlatPly& ply : plies)
    for (const Vec2& x : {ply.bounds.min(), ply.bounds.max()})
      all.extend(Vec3(x.x(), x.y(), ply.z));
  const double reach = 2.0 * all.diagonal().norm();
  const auto meet = [&](double travel, std::size_t ply) {
    if (travel < way.travel) way.travel = travel, way.first = ply;
  };
  for (std::size_t i = 0; i < plies.size(); ++i) {
    const FlatPly& ply = plies[i];
    SurfaceHint hint, moved;
    for (std::size_t n = 0; n < ply.mesh.x.size(); n += stride_for(ply.mesh.x.size(), most_nodes)) {
      const Vec3 p(ply.mesh.x[n].x(), ply.mesh.x[n].y(), ply.z);
      const double gap = tool_distance(tool, Vec3::Zero(), p, hint) - ply.half;
      if (gap < way.gap) way.gap = gap, way.closest = i;
      if (moves) meet(travel_to(tool, p, ply.half, std::min(reach, way.travel), moved), i);
    }
    for (std::size_t k = 0; k < surface.x.size(); k += stride_for(surface.x.size(), most_points)) {
      const Vec3& x = surface.x[k];
      if (moves) meet(travel_of_point(x, tool.direction, ply), i);
      if (const double gap = std::abs(x.z() - ply.z) - ply.half;
          gap < way.gap && covers(ply, x.head<2>()))
        way.gap = gap, way.closest = i;
    }
  }
  way.gap = std::max(way.gap, 0.0);
  return way;
}

void check_motions(const Case& scene, const CaseParts& parts, const std::vector<FlatPly>& plies,
                   const std::vector<TriMesh>& surfaces, Diagnostics& diagnostics) {
  MotionCheck check{scene, parts, plies, surfaces, diagnostics};
  for (const FlatPly& ply : plies)
    check.bounds.extend(ply.bounds);
  for (std::size_t t = 0; t < scene.tools.size(); ++t)
    check.ways.push_back(way_of(scene.tools[t], surfaces[t], plies));
  const std::size_t before = diagnostics.errors.size();
  check_extents(check);
  if (diagnostics.errors.size() > before) return; // of another size, all else is of no use
  check_tools_apart(check);
  if (diagnostics.errors.size() > before) return; // moved apart they have other ways
  for (std::size_t t = 0; t < scene.tools.size(); ++t) {
    if (scene.tools[t].motion == Motion::driven) check_driven(check, t);
    if (scene.tools[t].motion == Motion::force) check_pushed(check, t);
  }
  check_tool_sense(scene, parts, plies, check.ways, surfaces, diagnostics);
}

} // namespace plyform
