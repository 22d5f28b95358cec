// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of springs and grippers that need the meshes of the plies.
#include "base/format.hpp"
#include "core/input/checks/scene_checks.hpp"
#include "core/model/attachment.hpp"
#include "core/model/boundary.hpp"

#include <algorithm>

namespace plyform {
namespace {

struct AttachmentCheck {
  const Case& scene;
  const CaseParts& parts;
  const std::vector<FlatPly>& plies;
  Diagnostics& diagnostics;
  std::vector<std::vector<Vec3>> x0{};

  void fail(const Attachment& of, const std::string& rule, const std::string& remedy) {
    diagnostics.error(parts.boundaries[of.boundary].at, parts.boundaries[of.boundary].item,
                      scene.boundaries[of.boundary].name, rule, remedy);
  }
};

/// A spring must have a direction, and a natural length above 0.
void check_length(AttachmentCheck& check, const Attachment& attached) {
  constexpr double least = 0.1; // mm: as long as a spring must be to have a direction
  const auto& spring = check.scene.boundaries[attached.boundary].as<TensionSpring>();
  const Vec3& c = attached.start;
  if (attached.length < least)
    return check.fail(attached,
                      fmt::format("is {:.3g} mm long: its anchor is where it hangs on the ply, at "
                                  "({:.4g}, {:.4g}, {:.4g})",
                                  attached.length, c.x(), c.y(), c.z()),
                      "move the anchor away from the ply");
  if (attached.natural_length >= 0.0) return;
  check.fail(attached,
             fmt::format("needs {:.4g} mm to be preloaded by {:g} N and has {:.4g} mm, from "
                         "({:.4g}, {:.4g}, {:.4g}) to its anchor: its natural length would be "
                         "below 0",
                         spring.preload / spring.stiffness, spring.preload, attached.length, c.x(),
                         c.y(), c.z()),
             "preload it less, or give a stiffer spring or an anchor further away");
}

/// Nodes of a gripper move with it: nothing else may prescribe where they are.
void check_alone(AttachmentCheck& check, const Attachment& clamp) {
  const std::vector<Boundary>& all = check.scene.boundaries;
  for (std::size_t b = 0; b < all.size(); ++b) {
    const bool later_gripper = all[b].is<Gripper>() && b < static_cast<std::size_t>(clamp.boundary);
    if (!all[b].is<Grip>() && !all[b].is<HingedFrame>() && !later_gripper) continue;
    for (const AttachedNode& node : clamp.nodes) {
      const Vec2 x = check.x0[node.ply][node.node].head<2>();
      if (holds(all[b], node.ply, x))
        return check.fail(clamp,
                          fmt::format("clamps the node at ({:.4g}, {:.4g}) of ply {} that {} holds "
                                      "too",
                                      x.x(), x.y(), check.scene.plies[node.ply].name, all[b].name),
                          "let their boxes, edges or bars not meet");
    }
  }
}

/// A force on a ply that nothing else holds or touches moves it away for ever.
void check_resisted(AttachmentCheck& check, const Attachment& clamp) {
  const Case& scene = check.scene;
  const auto others = std::count_if(scene.boundaries.begin(), scene.boundaries.end(),
                                    [](const Boundary& b) { return !b.is<SymmetryPlane>(); });
  const double force = force_of(scene.boundaries[clamp.boundary]);
  if (force == 0.0 || others > 1 || !scene.tools.empty()) return;
  check.fail(clamp,
             fmt::format("pulls ply {} by {:g} N, and nothing holds it: it would go on for ever",
                         scene.plies[clamp.nodes.front().ply].name, force),
             "hold it with a grip, a spring or a blank-holder, or draw it by a drive (stiffness, "
             "stroke)");
}

/// Warns of a pull that goes into the ply rather than off its edge.
void warn_of_inward(AttachmentCheck& check, const Attachment& attached) {
  const Boundary& b = check.scene.boundaries[attached.boundary];
  const auto* spring = std::get_if<TensionSpring>(&b.kind);
  Vec2 way = (spring ? Vec3(spring->anchor - attached.start) : b.as<Gripper>().direction).head<2>();
  constexpr double beyond = 0.1;             // mm: any little way
  if (spring && way.norm() < beyond) return; // up or down
  if (way.norm() < 1e-3) return;
  way.normalize();
  const Vec2 c = attached.start.head<2>();
  double reach = 0.0;
  for (const AttachedNode& node : attached.nodes)
    reach = std::max(reach, way.dot(check.x0[node.ply][node.node].head<2>() - c));
  const Vec2 next = c + (reach + beyond) * way;
  for (const AttachedNode& node : attached.nodes) {
    if (!covers(check.plies[node.ply], next)) continue;
    check.diagnostics.warning(
        check.parts.boundaries[attached.boundary].at,
        fmt::format(
            "{} = {}: pulls into ply {}, towards ({:.4g}, {:.4g}): a ply gives way to that; "
            "{} if it was to pull outwards",
            check.parts.boundaries[attached.boundary].item, b.name,
            check.scene.plies[node.ply].name, next.x(), next.y(),
            spring ? "move the anchor" : "turn its direction"));
    return;
  }
}

} // namespace

void check_attachments(const Case& scene, const CaseParts& parts, const std::vector<FlatPly>& plies,
                       Diagnostics& diagnostics) {
  AttachmentCheck check{scene, parts, plies, diagnostics};
  for (const FlatPly& ply : plies) {
    std::vector<Vec3>& x0 = check.x0.emplace_back();
    for (const Vec2& x : ply.mesh.x)
      x0.emplace_back(x.x(), x.y(), ply.z);
  }
  std::vector<SheetBefore> sheets;
  for (std::size_t p = 0; p < plies.size(); ++p)
    sheets.push_back({check.x0[p], plies[p].mesh.triangles});
  for (std::size_t b = 0; b < scene.boundaries.size(); ++b) {
    if (prescribes(scene.boundaries[b])) continue;
    const Attachment attached = attach(scene.boundaries, b, sheets);
    if (attached.nodes.empty()) continue; // reported: check_boundaries
    if (scene.boundaries[b].is<TensionSpring>())
      check_length(check, attached);
    else
      check_alone(check, attached), check_resisted(check, attached);
    warn_of_inward(check, attached);
  }
}

} // namespace plyform
