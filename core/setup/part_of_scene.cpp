// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/setup/part_of_scene.hpp"

#include "base/format.hpp"
#include "base/text.hpp"
#include "core/input/checks/mirror_images.hpp"
#include "core/mesh/cut_outline.hpp"
#include "core/mesh/mesh_ply.hpp"
#include "core/model/boundary.hpp"
#include "core/model/motion.hpp"
#include "core/setup/symmetry_ahead.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

/// Why a plane that holds cannot be cut at; empty: it can.
std::string hindrance(const Case& data, const PlaneAhead& ahead) {
  for (std::size_t t = 0; t < data.tools.size(); ++t)
    if (data.tools[t].motion == Motion::force && at(ahead.tools[t]) != t)
      return fmt::format("tool {} is pushed, and the image of another", data.tools[t].name);
  for (std::size_t b = 0; b < data.boundaries.size(); ++b)
    if (data.boundaries[b].is<TensionSpring>() && at(ahead.boundaries[b]) == b)
      return fmt::format("spring {} hangs across it", data.boundaries[b].name);
  for (const Ply& ply : data.plies)
    if (data.blanks[at(ply.blank)].mesh == MeshKind::file)
      return fmt::format("the mesh of ply {} is from a file", ply.name);
  return {};
}

/// Two planes at right angles if there are such, those along x and y first, else one.
std::vector<PlaneAhead> chosen(const std::vector<PlaneAhead>& planes) {
  constexpr double right = 1e-9; // cosine
  for (const PlaneAhead& one : planes)
    for (const PlaneAhead& other : planes)
      if (std::abs(one.plane.normal.dot(other.plane.normal)) < right) return {one, other};
  return planes.empty() ? planes : std::vector<PlaneAhead>{planes.front()};
}

/// Gives tools and grippers that are their own images the half of what pushes them.
void share_forces(Case& data, const PlaneAhead& ahead) {
  for (Tool& tool : data.tools)
    divide_forces(tool, 2.0);
  for (std::size_t b = 0; b < data.boundaries.size(); ++b)
    if (data.boundaries[b].is<Gripper>() && at(ahead.boundaries[b]) == b)
      divide_forces(data.boundaries[b].as<Gripper>(), 2.0);
}

/// The blank of a ply on the side of a plane to which its normal points.
std::optional<BlankSpec> cut(const BlankSpec& blank, const Ply& ply, const SymmetryPlane& plane) {
  const Eigen::Rotation2Dd back(-ply.rotation);
  std::optional<Outline> outline =
      cut_outline(blank.outline, back * (plane.point - ply.seed), back * plane.normal);
  if (!outline) return std::nullopt;
  BlankSpec part = blank;
  part.outline = *std::move(outline);
  return part;
}

/// Cuts all blanks, once for all plies that lie alike; false if one falls to pieces.
bool cut_blanks(const std::vector<PlaneAhead>& planes, PreparedCase& prepared) {
  Case& data = *prepared.value;
  const std::vector<Ply> before = data.plies;
  std::vector<BlankSpec> blanks;
  std::vector<SourceLocation> places;
  for (std::size_t p = 0; p < data.plies.size(); ++p) {
    Ply& ply = data.plies[p];
    const auto same = std::find_if(before.begin(), before.end(), [&](const Ply& other) {
      return other.blank == ply.blank && other.seed == ply.seed && other.rotation == ply.rotation;
    });
    if (const auto first = static_cast<std::size_t>(same - before.begin()); first < p) {
      ply.blank = data.plies[first].blank;
      continue;
    }
    BlankSpec blank = data.blanks[at(ply.blank)];
    for (const PlaneAhead& ahead : planes) {
      std::optional<BlankSpec> part = cut(blank, ply, ahead.plane);
      if (!part || !takes_elements(*part)) return false;
      blank = *std::move(part);
    }
    places.push_back(prepared.parts.blanks[at(ply.blank)]);
    ply.blank = static_cast<int>(blanks.size());
    blanks.push_back(std::move(blank));
  }
  data.blanks = std::move(blanks), prepared.parts.blanks = std::move(places);
  return true;
}

void cut_at(const std::vector<PlaneAhead>& planes, PreparedCase& prepared) {
  Case& data = *prepared.value;
  for (const PlaneAhead& ahead : planes) {
    if (!ahead.assumed.empty())
      for (const Ply& ply : data.plies) {
        Fabric& fabric = data.fabrics[at(ply.fabric)];
        fabric = with_families_alike(fabric).first;
      }
    share_forces(data, ahead);
    data.part_at.push_back({ahead.plane, ahead.tools, ahead.boundaries});
  }
  for (const PlaneAhead& ahead : planes)
    data.boundaries.push_back({"symmetry " + ahead.name, -1, ahead.plane});
  for (Ply& ply : data.plies) // a foil's axes, along which strains are shown, are their own images
    if (!data.fabrics[at(ply.fabric)].has_yarns()) {
      const Vec2& normal = planes.front().plane.normal;
      ply.angle = std::atan2(normal.y(), normal.x());
    }
  for (std::size_t p = 0; p < data.plies.size(); ++p)
    prepared.meshes[p] = mesh_ply(data, data.plies[p]);
}

} // namespace

void take_part(PreparedCase& prepared) {
  if (!prepared.value || prepared.value->symmetry == Symmetry::none) return;
  const Case& data = *prepared.value;
  const bool may_assume = data.symmetry == Symmetry::alike;
  std::vector<PlaneAhead> planes;
  std::vector<std::string> reasons;
  for (const PlaneAhead& ahead : symmetry_planes(data, prepared.meshes)) {
    const std::string hindered = hindrance(data, ahead);
    if (!ahead.broken.empty())
      reasons.push_back(ahead.name + " is broken by " + joined(ahead.broken, ", and by "));
    else if (!ahead.assumed.empty() && !may_assume)
      reasons.push_back(fmt::format("{} holds but for {} (symmetry = \"alike\" takes them as one)",
                                    ahead.name, joined(ahead.assumed, " and ")));
    else if (!hindered.empty())
      reasons.push_back(ahead.name + ": " + hindered);
    else
      planes.push_back(ahead);
  }
  planes = chosen(planes);
  Case before = data;
  const CaseParts places = prepared.parts;
  if (!planes.empty() && !cut_blanks(planes, prepared)) {
    reasons.emplace_back("a blank falls to pieces where it would be cut");
    *prepared.value = before, prepared.parts = places;
    planes.clear();
  }
  if (planes.empty()) {
    prepared.warnings.push_back(
        fmt::format("warning: symmetry: all is modelled, as no plane of symmetry can be cut at{}{}",
                    reasons.empty() ? "" : ": ", joined(reasons, "; ")));
    return;
  }
  std::vector<std::string> names, assumed;
  for (const PlaneAhead& ahead : planes) {
    names.push_back(ahead.name);
    assumed.insert(assumed.end(), ahead.assumed.begin(), ahead.assumed.end());
  }
  cut_at(planes, prepared);
  before.fabrics = data.fabrics; // whose families may be taken as one
  prepared.whole = std::move(before);
  prepared.notes.push_back(fmt::format(
      "symmetry: {} is modelled, cut at {}; what is shown is the whole, but no wave that breaks "
      "the symmetry",
      planes.size() > 1 ? "a quarter" : "a half", joined(names, " and ")));
  for (const std::string& what : assumed)
    prepared.notes.push_back(fmt::format("symmetry: {}, are taken as one", what));
}

Case whole_of(const PreparedCase& prepared) {
  const Case& part = *prepared.value;
  Case whole = *prepared.whole;
  whole.solver = part.solver, whole.accuracy = part.accuracy;
  std::vector<BlankSpec> blanks;
  for (std::size_t p = 0; p < part.plies.size(); ++p) {
    BlankSpec& blank = blanks.emplace_back(part.blanks[at(part.plies[p].blank)]);
    blank.outline = whole.blanks[at(whole.plies[p].blank)].outline;
    whole.plies[p].blank = static_cast<int>(p);
  }
  whole.blanks = std::move(blanks);
  return whole;
}

} // namespace plyform
