// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/setup/symmetry_ahead.hpp"

#include "base/format.hpp"
#include "base/text.hpp"
#include "core/input/checks/mirror_images.hpp"
#include "core/model/boundary.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace plyform {
namespace {

constexpr double nearly = 0.02;        // of a tool's size: what is off by more is no image
constexpr double alike = 0.05;         // of a stiffness: may be taken for the same
constexpr double same_place = 0.02;    // mm, of borders
constexpr double same = 1e-9;          // of directions
constexpr std::size_t at_first = 2000; // points of a tool that are asked before all are

/// What is asked of each plane.
struct WholeScene {
  const Case& data;
  std::vector<FlatPly> plies;
  std::vector<TriMesh> surfaces; ///< of the tools, in space
};

/// Whether one tool moves as the mirror image of another.
bool moves_as_image(const Tool& a, const Tool& b, const SymmetryPlane& plane) {
  if (a.motion != b.motion) return false;
  if (a.motion == Motion::fixed) return true;
  return (mirrored_direction(plane, a.direction) - b.direction).norm() < same &&
         a.stroke == b.stroke && a.force == b.force && a.programme == b.programme &&
         a.mass == b.mass;
}

/// What breaks the plane at a tool; false if it is not nearly an image of any.
bool look_at_tool(const WholeScene& scene, std::size_t t, PlaneAhead& ahead) {
  const SymmetryPlane& plane = ahead.plane;
  std::vector<std::string>& broken = ahead.broken;
  ahead.tools.push_back(static_cast<int>(t));
  const std::vector<Tool>& tools = scene.data.tools;
  const TriMesh& surface = scene.surfaces[t];
  Box3 box;
  for (const Vec3& x : surface.x)
    box.extend(x);
  const double size = box.isEmpty() ? 0.0 : box.diagonal().norm();
  const double limit = 20.0 * touch_depth(scene.plies); // a fiftieth of a thickness
  double least = std::numeric_limits<double>::infinity();
  bool moves = false;
  for (std::size_t k = 0; k < tools.size(); ++k) {
    const std::size_t other = (t + k) % tools.size(); // itself first
    if (surface.x.empty() != scene.surfaces[other].x.empty()) continue;
    const auto off = [&](std::size_t most) {
      return difference_to_image(tools[t], tools[other], surface, plane, most).beyond;
    };
    double beyond = off(at_first);
    if (beyond <= limit) beyond = off(std::numeric_limits<std::size_t>::max());
    if (beyond >= least) continue;
    least = beyond;
    ahead.tools.back() = static_cast<int>(other);
    moves = moves_as_image(tools[t], tools[other], plane);
    if (least <= limit && moves) return true;
  }
  if (!(least <= nearly * size)) return false;
  if (least > limit)
    broken.push_back(
        fmt::format("tool {}: its mirror image is {:.2g} mm off", tools[t].name, least));
  else
    broken.push_back(fmt::format("the motion of tool {}", tools[t].name));
  return true;
}

/// mm: how far the mirror image of a ply's border is from the border.
double border_off(const FlatPly& ply, const SymmetryPlane& plane) {
  constexpr std::size_t most = 500; // ends of sides that are asked
  const auto distance = [](const Vec2& p, const Vec2& a, const Vec2& b) {
    const Vec2 ab = b - a;
    const double s = std::clamp(ab.dot(p - a) / ab.squaredNorm(), 0.0, 1.0);
    return (p - a - s * ab).norm();
  };
  double largest = 0.0;
  const std::size_t stride = std::max<std::size_t>(1, ply.border.size() / most);
  for (std::size_t i = 0; i < ply.border.size(); i += stride) {
    const Vec2 &x = ply.border[i].first,
               image = x - 2.0 * (x - plane.point).dot(plane.normal) * plane.normal;
    double least = std::numeric_limits<double>::infinity();
    for (const auto& [a, b] : ply.border) {
      least = std::min(least, distance(image, a, b));
      if (least <= largest) break;
    }
    largest = std::max(largest, least);
  }
  return largest;
}

/// As look_at_tool: false if the blank is not nearly its own image.
bool look_at_ply(const WholeScene& scene, std::size_t p, PlaneAhead& ahead) {
  const Ply& ply = scene.data.plies[p];
  const Fabric& fabric = scene.data.fabrics[at(ply.fabric)];
  const double off = border_off(scene.plies[p], ahead.plane);
  if (off > nearly * scene.plies[p].bounds.diagonal().norm()) return false;
  if (off > same_place)
    ahead.broken.push_back(
        fmt::format("the blank of ply {}: its mirror image is {:.2g} mm off", ply.name, off));
  const std::vector<std::string> broken = broken_by_fibres(ply, fabric, ahead.plane);
  if (broken.empty()) return true;
  const auto [as_one, difference] = with_families_alike(fabric);
  if (difference < alike && broken_by_fibres(ply, as_one, ahead.plane).empty())
    ahead.assumed.push_back(fmt::format("the families of fabric {}, which differ by {:.2g} %",
                                        fabric.name, 100.0 * difference));
  else
    ahead.broken.push_back(fmt::format("ply {} at {:g} degrees: its mirror image {}", ply.name,
                                       ply.angle / degree, broken.front()));
  return true;
}

/// Whether `other` holds the mirror images of all nodes that a boundary holds, and moves or pulls
/// them as the mirror image would.
bool is_image(const WholeScene& scene, const Boundary& boundary, const Boundary& other,
              const SymmetryPlane& plane) {
  if (boundary.kind.index() != other.kind.index() || boundary.ply != other.ply ||
      stroke_of(boundary) != stroke_of(other) || force_of(boundary) != force_of(other) ||
      !std::ranges::equal(programme_of(boundary), programme_of(other)))
    return false;
  if (boundary.is<TensionSpring>()) {
    const auto &a = boundary.as<TensionSpring>(), &b = other.as<TensionSpring>();
    if ((mirrored(plane, a.anchor) - b.anchor).norm() > same_place || a.stiffness != b.stiffness ||
        a.carrier != b.carrier || a.preload != b.preload || a.max_force != b.max_force)
      return false;
  }
  if (boundary.is<Gripper>()) {
    const auto &a = boundary.as<Gripper>(), &b = other.as<Gripper>();
    if ((mirrored_direction(plane, a.direction) - b.direction).norm() > same ||
        a.stiffness != b.stiffness || a.mass != b.mass || a.guided != b.guided)
      return false;
  }
  const double stroke = stroke_of(boundary);
  for (std::size_t p = 0; p < scene.plies.size(); ++p)
    for (const Vec2& x : scene.plies[p].mesh.x) {
      const int ply = static_cast<int>(p);
      if (!holds(boundary, ply, x)) continue;
      const Vec3 X(x.x(), x.y(), 0.0), image = mirrored(plane, X);
      if (!holds(other, ply, image.head<2>())) return false;
      if (prescribes(boundary) && stroke > 0.0 &&
          (mirrored_direction(plane, prescribed_slope(boundary, X, 0.5 * stroke)) -
           prescribed_slope(other, image, 0.5 * stroke))
                  .norm() > 1e-6)
        return false;
    }
  return true;
}

void look_at_boundaries(const WholeScene& scene, PlaneAhead& ahead) {
  const std::vector<Boundary>& all = scene.data.boundaries;
  for (std::size_t b = 0; b < all.size(); ++b) {
    std::size_t k = 0; // itself first
    while (k < all.size() && !is_image(scene, all[b], all[(b + k) % all.size()], ahead.plane))
      ++k;
    ahead.boundaries.push_back(static_cast<int>((b + k) % all.size()));
    if (k == all.size()) ahead.broken.push_back(fmt::format("boundary {}", all[b].name));
  }
  if (std::abs(scene.data.gravity.dot(normal_of(ahead.plane))) > same * scene.data.gravity.norm())
    ahead.broken.emplace_back("gravity");
}

/// The plane with what breaks it; nothing if a tool or a blank is far from its image.
std::optional<PlaneAhead> look_at(const WholeScene& scene, PlaneAhead ahead) {
  for (std::size_t t = 0; t < scene.data.tools.size(); ++t)
    if (!look_at_tool(scene, t, ahead)) return std::nullopt;
  look_at_boundaries(scene, ahead);
  for (std::size_t p = 0; p < scene.plies.size(); ++p)
    if (!look_at_ply(scene, p, ahead)) return std::nullopt;
  std::sort(ahead.assumed.begin(), ahead.assumed.end());
  ahead.assumed.erase(std::unique(ahead.assumed.begin(), ahead.assumed.end()), ahead.assumed.end());
  return ahead;
}

/// The middle of a tool: facets of what is turned about its origin need not be symmetric.
Vec2 middle_of_tool(const Tool& tool, const TriMesh& surface) {
  if (!std::holds_alternative<MeshShapePtr>(tool.shape) &&
      !std::holds_alternative<ExtrudedProfile>(tool.shape))
    return tool.position.head<2>();
  Box3 box;
  for (const Vec3& x : surface.x)
    box.extend(x);
  return box.center().head<2>();
}

/// The middle of most tools that have one, else of the first ply.
Vec2 middle_of(const WholeScene& scene) {
  constexpr double grain = 1e-6; // mm
  std::array<std::vector<double>, 2> middles;
  for (std::size_t t = 0; t < scene.surfaces.size(); ++t) {
    if (!bounded_tool(scene.data.tools[t]) || scene.surfaces[t].x.empty()) continue;
    const Vec2 middle = middle_of_tool(scene.data.tools[t], scene.surfaces[t]);
    for (int k = 0; k < 2; ++k)
      middles[at(k)].push_back(middle[k]);
  }
  if (middles[0].empty()) return scene.plies.front().bounds.center();
  Vec2 middle;
  for (int k = 0; k < 2; ++k) {
    std::vector<double>& all = middles[at(k)];
    std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2),
                     all.end());
    middle[k] = grain * std::round(all[all.size() / 2] / grain);
  }
  return middle;
}

std::vector<PlaneAhead> candidates(const Vec2& middle) {
  constexpr double slanted = std::numbers::sqrt2 / 2.0;
  const auto number = [](double value) { return fmt::format("{:.4g}", value + 0.0); };
  const bool centred = middle.norm() == 0.0;
  const std::string through =
      fmt::format(" through ({}, {})", number(middle.x()), number(middle.y()));
  return {{{middle, Vec2::UnitX()}, "x = " + number(middle.x()), {}, {}},
          {{middle, Vec2::UnitY()}, "y = " + number(middle.y()), {}, {}},
          {{middle, {slanted, -slanted}}, centred ? "y = x" : "at 45 degrees" + through, {}, {}},
          {{middle, {slanted, slanted}}, centred ? "y = -x" : "at -45 degrees" + through, {}, {}}};
}

} // namespace

std::vector<PlaneAhead> symmetry_planes(const Case& data, const std::vector<BlankMesh>& meshes) {
  const auto is_plane = [](const Boundary& b) { return b.is<SymmetryPlane>(); };
  if (data.plies.empty() || std::any_of(data.boundaries.begin(), data.boundaries.end(), is_plane))
    return {};
  WholeScene scene{data, {}, {}};
  double reach = 0.0, side = 0.0;
  for (std::size_t p = 0; p < data.plies.size(); ++p) {
    scene.plies.push_back(make_flat_ply(meshes[p], data.plies[p].z,
                                        data.fabrics[at(data.plies[p].fabric)].thickness));
    reach = std::max(reach, scene.plies[p].bounds.diagonal().norm());
    side = std::max(side, data.blanks[at(data.plies[p].blank)].element_size);
  }
  for (const Tool& tool : data.tools)
    scene.surfaces.push_back(tool_surface(tool, side, reach + tool.position.norm()));
  std::vector<PlaneAhead> planes;
  for (PlaneAhead& candidate : candidates(middle_of(scene)))
    if (std::optional<PlaneAhead> found = look_at(scene, std::move(candidate)))
      planes.push_back(*std::move(found));
  return planes;
}

std::vector<std::string> symmetry_ahead(const Case& data, const std::vector<BlankMesh>& meshes) {
  constexpr std::size_t few = 2; // more things that break a plane: nobody takes it for one
  std::vector<std::string> lines, holding;
  for (const PlaneAhead& ahead : symmetry_planes(data, meshes)) {
    if (ahead.broken.empty() && ahead.assumed.empty())
      holding.push_back(ahead.name);
    else if (ahead.broken.empty())
      lines.push_back(fmt::format("symmetry: plane {} holds but for {}", ahead.name,
                                  joined(ahead.assumed, " and ")));
    else if (ahead.broken.size() <= few)
      lines.push_back(fmt::format("symmetry: plane {} is broken by {}", ahead.name,
                                  joined(ahead.broken, ", and by ")));
  }
  if (!holding.empty())
    lines.insert(lines.begin(),
                 fmt::format("symmetry: plane{} {} hold{}: with symmetry = \"scene\" {} is "
                             "modelled in the place of the whole",
                             holding.size() > 1 ? "s" : "", joined(holding, " and "),
                             holding.size() > 1 ? "" : "s",
                             holding.size() > 1 ? "a quarter" : "a half"));
  return lines;
}

} // namespace plyform
