// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/verification/siblings.hpp"

#include "core/accuracy/cost_parameters.hpp"
#include "core/mesh/mesh_ply.hpp"
#include "core/mesh/mesh_variants.hpp"
#include "core/model/boundary.hpp"
#include "core/solver/scene.hpp"
#include "core/verification/no_band.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

namespace plyform {
namespace {

constexpr double finer_by = 1.0 / 1.3;    // b where the mesh cannot be coarser
constexpr double most_cost = 1.2;         // of the run's work: 1.2 times as much of its time
constexpr double work_of_elements = -2.7; // exponent of the element size, core/accuracy

using Meshes = std::vector<BlankMesh>;

bool all_resolve_bending(const Case& data, double by) {
  return std::all_of(data.plies.begin(), data.plies.end(),
                     [&](const Ply& ply) { return resolves_bending(data, ply, by); });
}

/// Side of a square of two triangles, mm.
double size_of(const BlankMesh& mesh) {
  double twice = 0.0; // mm^2
  for (const Triangle& t : mesh.triangles) {
    const Vec2 a = mesh.x[at(t[1])] - mesh.x[at(t[0])], b = mesh.x[at(t[2])] - mesh.x[at(t[0])];
    twice += std::abs(a.x() * b.y() - a.y() * b.x());
  }
  return std::sqrt(twice / static_cast<double>(mesh.triangles.size()));
}

/// Whether every boundary holds what it holds of these meshes of others, within half an element.
bool holds_as_much(const Case& data, const Meshes& own, const Meshes& others) {
  const auto held = [&](const Boundary& boundary, std::size_t ply, const BlankMesh& mesh) {
    Eigen::AlignedBox2d box;
    for (const Vec2& x : mesh.x)
      if (holds(boundary, static_cast<int>(ply), x)) box.extend(x);
    return box;
  };
  for (const Boundary& boundary : data.boundaries)
    for (std::size_t p = 0; p < own.size(); ++p) {
      const Eigen::AlignedBox2d a = held(boundary, p, own[p]), b = held(boundary, p, others[p]);
      if (a.isEmpty() != b.isEmpty()) return false;
      if (a.isEmpty()) continue;
      const double apart = std::max((a.min() - b.min()).cwiseAbs().maxCoeff(),
                                    (a.max() - b.max()).cwiseAbs().maxCoeff());
      if (apart > 0.5 * std::max(size_of(own[p]), size_of(others[p]))) return false;
    }
  return true;
}

Meshes meshes_of(const Case& data) {
  Meshes meshes;
  for (const Ply& ply : data.plies)
    meshes.push_back(mesh_ply(data, ply));
  return meshes;
}

/// Whether a pressure or a closed mould forms plies, on the whole of their faces.
bool pressed_all_over(const Case& data) {
  return !data.loads.empty() ||
         std::any_of(data.plies.begin(), data.plies.end(), [&](const Ply& ply) {
           return data.fabrics[ply.fabric].compaction.has_value();
         });
}

struct OtherMesh {
  Case data;
  Meshes meshes;
};

/// The case with elements `by` times as large, those of files bisected; nothing if a blank cannot
/// be meshed so, or a boundary then holds something else.
std::optional<OtherMesh> with_elements(const Case& data, const Meshes& own, double by) {
  OtherMesh other{data, {}};
  for (BlankSpec& blank : other.data.blanks)
    scale_elements(blank, by);
  try {
    for (std::size_t p = 0; p < data.plies.size(); ++p) {
      const bool file = data.blanks[data.plies[p].blank].mesh == MeshKind::file;
      other.meshes.push_back(file ? bisected(own[p]) : mesh_ply(other.data, data.plies[p]));
    }
  } catch (const std::runtime_error&) {
    return std::nullopt;
  }
  if (!holds_as_much(data, own, other.meshes)) return std::nullopt;
  return other;
}

bool has_file(const Case& data) {
  return std::any_of(data.plies.begin(), data.plies.end(),
                     [&](const Ply& ply) { return data.blanks[ply.blank].mesh == MeshKind::file; });
}

/// The largest effective softening of any yarn.
double softening_of(const Case& data, double asked) {
  double most = 1.0;
  for (const Ply& ply : data.plies) {
    const Fabric& fabric = data.fabrics[ply.fabric];
    for (const YarnFamily& family : fabric.families)
      if (family.tension.largest_slope() > 0.0)
        most = std::max(most, effective_softening(family.tension, asked));
  }
  return most;
}

/// The sibling of `base` in softening, and its cost over that of `base`.
struct SofteningSibling {
  double softening = 0.0, factor = 0.0, cost = 0.0;
  const char* name = "";
};

SofteningSibling softening_sibling(const Case& base) {
  const double asked = base.solver.fibre_softening, acts = softening_of(base, asked);
  constexpr double enough =
      1.9; // of twice the softening, of what acts; else it does next to nothing
  const double more = softening_of(base, 2.0 * asked) / acts;
  if (acts == 1.0) return {};
  if (more > enough)
    return {2.0 * asked, 1.0 / (more - 1.0), std::sqrt(0.5), "softer set of fibres"};
  const double less = std::max(0.5 * acts, 1.0);
  return {less, -1.0 / (1.0 - less / acts), std::sqrt(acts / less), "stiffer set of fibres"};
}

/// Turns and moves a twin by what no user would notice, this way or the other.
void disturb(Sibling& twin, double way) {
  constexpr double turn = 1e-3 * degree, share = 1e-3; // of an element
  twin.data.plies[twin.data.plies.size() / 2].angle += way * turn;
  const double size = size_of(twin.meshes[twin.meshes.size() / 2]);
  twin.move = way > 0.0 ? Vec3(share * size, 0.0, 0.0) : Vec3(0.0, share * size, 0.0);
}

void add_late_twins(Siblings& siblings, const Case& data, const Meshes& own, double first,
                    double second) {
  for (const auto& [cause, from, way] : {std::tuple(Cause::late_chance, first, 1.0),
                                         std::tuple(Cause::later_chance, second, -1.0)}) {
    Sibling twin{cause, "twin, from late in the run on", data, own, from, Vec3::Zero()};
    disturb(twin, way);
    siblings.runs.push_back(std::move(twin));
  }
}

void add_softening(Siblings& siblings, const OtherMesh& base) {
  const SofteningSibling softening = softening_sibling(base.data);
  siblings.softening = softening.factor;
  if (softening.factor == 0.0) return;
  Sibling sibling{Cause::softening, softening.name, base.data, base.meshes, 0.0, Vec3::Zero()};
  sibling.data.solver.fibre_softening = softening.softening;
  siblings.runs.push_back(std::move(sibling));
}

void add_coarser(Siblings& siblings, const Case& data, const Meshes& own, const OtherMesh& coarse) {
  OtherMesh base = coarse;
  base.data.solver.outputs = 1;
  siblings.runs.push_back({Cause::mesh, "coarser mesh", base.data, base.meshes});
  base.data.solver.duration /= siblings.speed;
  siblings.runs.push_back({Cause::inertia, "faster stroke", base.data, base.meshes});
  add_softening(siblings, base);
  Sibling twin{Cause::chance, "faster stroke and twin", base.data, base.meshes};
  for (std::size_t p = 0; p < twin.meshes.size(); ++p)
    if (data.blanks[data.plies[p].blank].mesh == MeshKind::free)
      twin.meshes[p] = renumbered(std::move(twin.meshes[p]));
  disturb(twin, 1.0);
  siblings.runs.push_back(std::move(twin));
  add_late_twins(siblings, data, own, 0.6, 0.8);
}

void add_finer(Siblings& siblings, const Case& data, const Meshes& own,
               const std::optional<OtherMesh>& fine) {
  constexpr double first_late = 0.75, second_late = 0.85;
  double before = 0.0, after = 0.0; // triangles
  for (std::size_t p = 0; fine && p < own.size(); ++p) {
    before += static_cast<double>(own[p].triangles.size());
    after += static_cast<double>(fine->meshes[p].triangles.size());
  }
  if (fine) siblings.coarsening = std::sqrt(before / after);
  const double of_mesh = fine ? std::pow(siblings.coarsening, work_of_elements) : 0.0;
  const double left = most_cost - (1.0 - second_late);
  siblings.speed = std::max(2.0, (1.0 + of_mesh + softening_sibling(data).cost) / left);
  OtherMesh base{data, own};
  base.data.solver.outputs = 1;
  base.data.solver.duration /= siblings.speed;
  siblings.runs.push_back({Cause::inertia, "faster stroke", base.data, own});
  if (fine) {
    OtherMesh other = *fine;
    other.data.solver = base.data.solver;
    siblings.runs.push_back(
        {Cause::mesh, "faster stroke and finer mesh", other.data, other.meshes});
  }
  add_softening(siblings, base);
  add_late_twins(siblings, data, own, first_late, second_late);
}

} // namespace

Siblings siblings_of(const Case& data, const std::vector<BlankMesh>& meshes) {
  const Meshes own = meshes.empty() ? meshes_of(data) : meshes;
  Siblings siblings;
  siblings.resolved = resolves_all(data, own) && !pressed_all_over(data);
  Case free_of_boundaries = data; // whose nodes are looked at below
  free_of_boundaries.boundaries.clear();
  for (const double by : {1.4, 1.3, 1.2}) {
    if (!may_coarsen(free_of_boundaries, by) || !all_resolve_bending(data, by)) continue;
    const std::optional<OtherMesh> coarse = with_elements(data, own, by);
    if (!coarse) continue;
    siblings.coarsening = by;
    add_coarser(siblings, data, own, *coarse);
    return siblings;
  }
  const std::optional<OtherMesh> fine =
      with_elements(data, own, has_file(data) ? std::numbers::sqrt2 / 2.0 : finer_by);
  siblings.left_out.emplace_back(
      fine ? "the mesh can be no coarser here: a finer one was compared, at a faster stroke"
           : "the mesh has no sibling: its boundaries would hold other nodes, or it cannot be made "
             "finer, and what depends on it has no band");
  add_finer(siblings, data, own, fine);
  return siblings;
}

void move_first_tool(const Case& data, const Vec3& by, Scene& scene) {
  const auto tool = std::find_if(data.tools.begin(), data.tools.end(),
                                 [](const Tool& t) { return t.motion != Motion::fixed; });
  if (tool != data.tools.end())
    scene.tools[static_cast<std::size_t>(tool - data.tools.begin())].body.position += by;
}

} // namespace plyform
