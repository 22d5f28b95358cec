// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/verification/no_band.hpp"

#include "base/format.hpp"
#include "core/model/bending_resolution.hpp"
#include "core/model/boundary.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace plyform {
namespace {

/// Of what the case asks for; of a mesh from a file the mean side of a square of two triangles, mm.
template <class Points>
double element_size(const BlankSpec& blank, const Points& x,
                    const std::vector<Triangle>& triangles) {
  if (blank.mesh != MeshKind::file) return smallest_wanted(blank);
  double area = 0.0; // twice
  for (const Triangle& t : triangles) {
    const Vec2 a = x[at(t[1])].template head<2>() - x[at(t[0])].template head<2>();
    const Vec2 b = x[at(t[2])].template head<2>() - x[at(t[0])].template head<2>();
    area += std::abs(a.x() * b.y() - a.y() * b.x());
  }
  return std::sqrt(area / static_cast<double>(triangles.size()));
}

/// Whether grips, frames and planes of symmetry have every node of the border.
bool border_is_held(const Case& data, int ply, const PlyFrame& frame) {
  std::map<std::pair<int, int>, int> sides;
  for (const Triangle& t : frame.triangles)
    for (int i = 0; i < 3; ++i)
      ++sides[std::minmax<int>(t[i], t[(i + 1) % 3])];
  const auto held = [&](int node) {
    const Vec2 x = frame.x0[at(node)].head<2>();
    return std::any_of(data.boundaries.begin(), data.boundaries.end(),
                       [&](const Boundary& b) { return prescribes(b) && holds(b, ply, x); });
  };
  return std::all_of(sides.begin(), sides.end(), [&](const auto& side) {
    return side.second > 1 || (held(side.first.first) && held(side.first.second));
  });
}

/// mm. Sharp edges count of shapes that are driven: else they often are where no ply gets.
double tightest(const Tool& tool) {
  const double radius = smallest_rounding(tool.shape);
  return radius > 0.0 || tool.motion == Motion::driven ? radius
                                                       : std::numeric_limits<double>::infinity();
}

/// The first tool, among those that `bears` picks, that is less round than elements are long; -1.
template <class Bears>
int too_sharp(const Case& data, double size, const Bears& bears) {
  for (std::size_t t = 0; t < data.tools.size(); ++t)
    if (bears(t) && tightest(data.tools[t]) < size) return static_cast<int>(t);
  return -1;
}

std::string unresolved(const Case& data, const Ply& ply, const Frame& last, double size) {
  if (const int t =
          too_sharp(data, size, [&](std::size_t tool) { return !last.tools[tool].force.isZero(); });
      t >= 0) {
    const double radius = tightest(data.tools[at(t)]);
    return fmt::format("elements of {:.3g} mm do not show the largest one where {} has {}", size,
                       data.tools[at(t)].name,
                       radius > 0.0 ? fmt::format("a radius of {:.3g} mm", radius)
                                    : std::string("a sharp edge"));
  }
  if (!resolves_bending(data, ply, 1.0))
    return fmt::format("elements of {:.3g} mm do not show the largest one: zones of in-plane "
                       "bending are narrower than {} of them",
                       size, fewest_in_layer);
  return "";
}

} // namespace

bool resolves_bending(const Case& data, const Ply& ply, double by) {
  const BendingLengths lengths = bending_lengths(data.fabrics[ply.fabric], 0.0);
  const double size = by * data.blanks[ply.blank].element_size;
  return !lengths.layer || *lengths.layer >= fewest_in_layer * size;
}

bool resolves_all(const Case& data, const std::vector<BlankMesh>& meshes) {
  for (std::size_t p = 0; p < data.plies.size(); ++p) {
    const Ply& ply = data.plies[p];
    const double size = element_size(data.blanks[ply.blank], meshes[p].x, meshes[p].triangles);
    if (too_sharp(data, size, [](std::size_t) { return true; }) >= 0) return false;
    if (!resolves_bending(data, ply, 1.0)) return false;
  }
  return true;
}

NoBand figures_without_band(const Case& data, const Frame& last) {
  NoBand none;
  for (const Tool& tool : data.tools)
    none.force.emplace_back(tool.motion == Motion::force ? "given: it is what pushes the tool"
                                                         : "");
  for (std::size_t p = 0; p < data.plies.size(); ++p) {
    const Ply& ply = data.plies[p];
    const PlyFrame& frame = last.plies[p];
    none.draw_in.emplace_back(border_is_held(data, static_cast<int>(p), frame)
                                  ? "held: boundaries have the whole border"
                                  : "");
    none.pressed.push_back(unresolved(
        data, ply, last, element_size(data.blanks[ply.blank], frame.x0, frame.triangles)));
  }
  return none;
}

} // namespace plyform
