// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/setup/instant.hpp"

#include "base/format.hpp"
#include "base/node_normals.hpp"
#include "core/accuracy/cost_parameters.hpp"
#include "core/accuracy/error_numbers.hpp"
#include "core/input/checks/initial_scene.hpp"
#include "core/mesh/mesh_ply.hpp"
#include "core/model/boundary.hpp"
#include "core/model/motion.hpp"
#include "core/setup/part_of_scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plyform {
namespace {

constexpr double same_height = 3.0; // mm
constexpr int states = 5;           // that are shown
constexpr double coarsening = 1.2;  // of the case's largest elements: 1.4 costs 0.4 degrees
constexpr double asked_error = 4.0; // degrees, of stroke and softening beside those elements
constexpr double mesh_error = 2.8;  // degrees, predicted of the mesh, at most
// Degrees that are told of plies that are formed alone, and of those of a stack: accuracy.md.
constexpr double told_alone = 3.0, told_in_stack = 5.0;

/// Whether two plies go the same way, but for their height.
bool goes_the_same_way(const Case& data, std::size_t a, std::size_t b) {
  const Ply &p = data.plies[a], &q = data.plies[b];
  const bool named =
      std::any_of(data.boundaries.begin(), data.boundaries.end(), [&](const Boundary& x) {
        return x.ply == static_cast<int>(a) || x.ply == static_cast<int>(b);
      });
  return !named && p.fabric == q.fabric && p.blank == q.blank && p.seed == q.seed &&
         p.rotation == q.rotation && p.temperature == q.temperature &&
         std::abs(std::sin(p.angle - q.angle)) < 1e-9 && std::abs(p.z - q.z) <= same_height;
}

/// mm, of a tool at the start from the flat ply, the least at some of its nodes.
double distance_of(const Tool& tool, const FlatPly& ply) {
  constexpr std::size_t asked = 400;
  double least = std::numeric_limits<double>::infinity();
  SurfaceHint hint;
  const std::size_t stride = std::max<std::size_t>(1, ply.mesh.x.size() / asked);
  for (std::size_t n = 0; n < ply.mesh.x.size(); n += stride)
    least = std::min(least, tool_distance(tool, Vec3::Zero(),
                                          {ply.mesh.x[n].x(), ply.mesh.x[n].y(), ply.z}, hint));
  return least;
}

/// Of each tool, whether it begins above the stack, not below.
std::vector<char> tools_above(const Case& data, const std::vector<BlankMesh>& meshes) {
  const auto z = [&](std::size_t p) { return data.plies[p].z; };
  std::size_t low = 0, high = 0;
  for (std::size_t p = 0; p < data.plies.size(); ++p) {
    if (z(p) < z(low)) low = p;
    if (z(p) > z(high)) high = p;
  }
  const auto flat = [&](std::size_t p) { return make_flat_ply(meshes[p], z(p), 0.0); };
  const FlatPly lowest = flat(low), highest = flat(high);
  std::vector<char> above;
  for (const Tool& tool : data.tools)
    above.push_back(low == high ? tool.direction.z() < 0.0 && tool.motion != Motion::fixed
                                : distance_of(tool, highest) < distance_of(tool, lowest));
  return above;
}

/// Takes from a case all but one ply and what acts on it.
void leave_alone(Case& data, std::size_t p) {
  std::erase_if(data.boundaries,
                [&](const Boundary& b) { return b.ply >= 0 && b.ply != static_cast<int>(p); });
  std::vector<char> keep(data.plies.size(), 0);
  keep[p] = 1;
  FrictionTable table;
  const auto plies = static_cast<int>(data.plies.size());
  table.bodies = 1 + static_cast<int>(data.tools.size());
  const auto body = [&](int b) { return b == 0 ? static_cast<int>(p) : plies + b - 1; };
  for (int a = 0; a < table.bodies; ++a)
    for (int b = 0; b < table.bodies; ++b) {
      table.mu.push_back(data.friction(body(a), body(b)));
      table.law.push_back(data.friction.law_of(body(a), body(b)));
    }
  data.friction = std::move(table);
  keep_plies(data, keep);
}

/// The plies between ply p and a tool above or below the stack: how thick they are, and which is
/// next to p.
struct Between {
  double thickness = 0.0; ///< mm
  std::optional<std::size_t> next;
};

Between between(const Case& stack, std::size_t p, bool above) {
  Between found;
  const auto height = [&](std::size_t q) { // over p, towards the tool
    return above ? stack.plies[q].z - stack.plies[p].z : stack.plies[p].z - stack.plies[q].z;
  };
  for (std::size_t q = 0; q < stack.plies.size(); ++q) {
    if (!(height(q) > 0.0)) continue;
    found.thickness += stack.fabrics[at(stack.plies[q].fabric)].thickness;
    if (!found.next || height(q) < height(*found.next)) found.next = q;
  }
  return found;
}

/// Gives tools the room and the friction of the plies between, and their share of given forces.
void stand_for_stack(const Case& stack, std::size_t p, const std::vector<char>& above,
                     Case& alone) {
  const auto share = static_cast<double>(stack.plies.size());
  const auto bodies = at(alone.friction.bodies);
  for (std::size_t t = 0; t < stack.tools.size(); ++t) {
    const Between others = between(stack, p, above[t]);
    alone.tool_clearance.push_back(others.thickness);
    if (others.next) {
      const auto one = static_cast<int>(p), next = static_cast<int>(*others.next);
      for (const std::size_t place : {1 + t, (1 + t) * bodies}) {
        alone.friction.mu[place] = stack.friction(one, next);
        alone.friction.law[place] = stack.friction.law_of(one, next);
      }
    }
    divide_forces(alone.tools[t], share);
  }
  for (Boundary& b : alone.boundaries)
    if (b.ply < 0 && b.is<Gripper>()) divide_forces(b.as<Gripper>(), share);
}

/// Gives a blank elements `by` times as large, or those where the first driven tool is pressed into
/// it, within its stroke.
void set_elements(const Case& data, const Ply& ply, double by, BlankSpec& blank) {
  constexpr double a_few = 0.6; // of the largest, below which small ones throughout cost more
  BlankSpec scaled = blank;
  scale_elements(scaled, std::max(by, 1.0));
  if (takes_elements(scaled)) blank = scaled;
  if (by >= 1.0) return;
  const double wanted = by * blank.element_size;
  const auto punch = std::find_if(data.tools.begin(), data.tools.end(), [](const Tool& tool) {
    return tool.motion == Motion::driven && bounded_tool(tool);
  });
  if (by > a_few || punch == data.tools.end()) {
    scale_elements(blank, by);
    return;
  }
  Eigen::AlignedBox2d box;
  for (const Vec3& x : tool_surface(*punch, 10.0 * wanted, 0.0).x)
    box.extend(x.head<2>());
  const Vec2 centre = Eigen::Rotation2Dd(-ply.rotation) * (box.center() - ply.seed);
  MeshZone zone{.kind = ZoneKind::circle, .element_size = wanted};
  zone.centre = centre, zone.radius = 0.5 * box.diagonal().norm() + punch->stroke;
  blank.zones.push_back(std::move(zone));
}

/// As coarse and as fast as the error allows.
void make_cheap(Case& data) {
  BlankSpec& blank = data.blanks[at(data.plies[0].blank)];
  blank.zones.clear(), blank.sizes.reset(), blank.mesh_from.clear();
  if (blank.mesh != MeshKind::file && !hold_by_mesh(data.boundaries)) {
    const double mesh = error_numbers(data, 1.0).mesh_error(),
                 most = std::pow(mesh_error / mesh, 1.0 / order_of_mesh);
    set_elements(data, data.plies[0], std::isfinite(most) ? std::min(coarsening, most) : 1.0,
                 blank);
  }
  for (Fabric& fabric : data.fabrics)
    fabric.compaction.reset();
  const double duration = data.solver.duration;
  data.accuracy = {asked_error * degree};
  pick_cost_parameters(data, {.element_size = true});
  data.solver.duration = std::min(data.solver.duration, duration);
  data.solver.dwell = 0.0;
  data.solver.max_balance_error = SolverOptions{}.max_balance_error;
  data.solver.outputs = states;
  data.accuracy = {};
}

/// The plies of a case, those together that are alike; the one that stands for all first.
std::vector<std::vector<std::size_t>> groups_of(const Case& data) {
  std::vector<std::vector<std::size_t>> groups;
  for (std::size_t p = 0; p < data.plies.size(); ++p) {
    const auto group = std::find_if(groups.begin(), groups.end(), [&](const auto& others) {
      return std::all_of(others.begin(), others.end(),
                         [&](std::size_t q) { return goes_the_same_way(data, p, q); });
    });
    if (group == groups.end())
      groups.push_back({p});
    else
      group->push_back(p);
  }
  for (std::vector<std::size_t>& group : groups)
    std::swap(group.front(), group[group.size() / 2]); // the middle one stands for all
  return groups;
}

/// above: of tools_above.
PlyAlone ply_alone(const PreparedCase& prepared, const std::vector<char>& above,
                   std::vector<std::size_t> group) {
  const Case& data = *prepared.value;
  Case one = data;
  leave_alone(one, group.front());
  stand_for_stack(data, group.front(), above, one);
  make_cheap(one);
  one.symmetry = Symmetry::alike;
  PlyAlone of;
  of.plies = std::move(group);
  of.prepared.meshes = {mesh_ply(one, one.plies[0])};
  of.prepared.parts = prepared.parts;
  of.prepared.value = std::move(one);
  take_part(of.prepared);
  return of;
}

/// Moves a ply that has been formed to the height of another that it stands for.
PlyFrame at_height(PlyFrame ply, const Ply& from, const Ply& to) {
  ply.name = to.name;
  if (to.z == from.z) return ply;
  const std::vector<Vec3> normals = mean_normals(ply.x, ply.triangles);
  for (std::size_t n = 0; n < ply.x.size(); ++n) {
    ply.x[n] += (to.z - from.z) * normals[n];
    ply.x0[n].z() = to.z;
  }
  return ply;
}

/// Adds the forces of plies alone to those of others, `count` times.
void add_forces(const Frame& of, double count, Frame& sum) {
  for (std::size_t t = 0; t < sum.tools.size(); ++t) {
    sum.tools[t].force += count * of.tools[t].force;
    sum.tools[t].force_N += count * of.tools[t].force_N;
    sum.tools[t].force_raw_N += count * of.tools[t].force_raw_N;
  }
}

/// What one ply alone has come to, with its states.
struct FormedAlone {
  RunResult result;
  std::vector<Frame> frames;
};

FormedAlone form(const PlyAlone& alone, int threads, const RunHooks& hooks, double begin,
                 double share) {
  FormedAlone formed;
  RunHooks of_ply;
  of_ply.interrupt = hooks.interrupt;
  of_ply.frame = [&](const Frame& frame) { formed.frames.push_back(frame); };
  if (hooks.progress)
    of_ply.progress = [&](Progress p) {
      p.fraction = begin + share * p.fraction;
      hooks.progress(p);
    };
  formed.result = run_case(*alone.prepared.value, threads, of_ply, alone.prepared.meshes);
  return formed;
}

/// State k of all plies. alone, formed: one for all that are alike.
Frame state_of_all(const Case& data, const std::vector<PlyAlone>& alone,
                   const std::vector<FormedAlone>& formed, std::size_t k) {
  Frame all = formed.front().frames[k];
  all.plies.assign(data.plies.size(), {});
  all.time *= data.solver.duration / alone.front().prepared.value->solver.duration;
  for (std::size_t i = 0; i < alone.size(); ++i) {
    const std::vector<std::size_t>& plies = alone[i].plies;
    const Frame& of = formed[i].frames[std::min(k, formed[i].frames.size() - 1)];
    const auto same = static_cast<double>(plies.size());
    add_forces(of, i == 0 ? same - 1.0 : same, all);
    if (i > 0) all.energy += of.energy;
    for (const std::size_t p : plies)
      all.plies[p] = at_height(of.plies.front(), data.plies[plies.front()], data.plies[p]);
  }
  return all;
}

Summary summary_of_all(const Case& data, const std::vector<PlyAlone>& alone,
                       const std::vector<FormedAlone>& formed) {
  Summary all = formed.front().result.summary;
  all.plies.assign(data.plies.size(), {});
  all.wall_time_s = 0.0, all.steps = 0;
  for (std::size_t i = 0; i < alone.size(); ++i) {
    const Summary& of = formed[i].result.summary;
    all.wall_time_s += of.wall_time_s, all.steps += of.steps;
    for (const std::size_t p : alone[i].plies)
      all.plies[p] = of.plies.front();
  }
  const double told = data.plies.size() == 1 ? told_alone : told_in_stack;
  all.status = "instant";
  all.message = fmt::format("each ply was formed alone between the tools, coarse and fast: shear "
                            "angles to some {:g} degrees rms, no forces and no wrinkles of the "
                            "stack",
                            told);
  all.accuracy.promised_deg = told, all.accuracy.unknown.clear();
  all.known_forces.assign(data.tools.size(), {0.0, 0.0});
  all.title = data.title;
  all.doubts.clear(), all.work.missing.clear();
  return all;
}

/// Forms these plies and puts them together.
RunResult form_all(const Case& data, const std::vector<PlyAlone>& alone, int threads,
                   const RunHooks& hooks) {
  const double share = 1.0 / static_cast<double>(alone.size());
  std::vector<FormedAlone> formed;
  for (const PlyAlone& one : alone) {
    formed.push_back(form(one, threads, hooks, share * static_cast<double>(formed.size()), share));
    RunResult& result = formed.back().result;
    if (ended(result.summary.status)) continue;
    result.summary.message = fmt::format(
        "ply {}, formed alone: {}", data.plies[one.plies.front()].name, result.summary.message);
    return std::move(result);
  }
  RunResult all;
  all.summary = summary_of_all(data, alone, formed);
  for (std::size_t k = 0; k < formed.front().frames.size(); ++k) {
    all.last = state_of_all(data, alone, formed, k);
    if (hooks.frame) hooks.frame(all.last);
  }
  return all;
}

} // namespace

std::string not_for_plies_alone(const Case& data) {
  if (!data.loads.empty())
    return "pressures form it, which act on a stack or on membranes that enclose it";
  const bool driven = std::any_of(data.tools.begin(), data.tools.end(),
                                  [](const Tool& tool) { return tool.motion == Motion::driven; });
  if (!driven) return "no tool is driven by a stroke";
  return {};
}

std::vector<PlyAlone> plies_alone(const PreparedCase& prepared) {
  const std::vector<char> above = tools_above(*prepared.value, prepared.meshes);
  std::vector<PlyAlone> alone;
  for (std::vector<std::size_t>& group : groups_of(*prepared.value))
    alone.push_back(ply_alone(prepared, above, std::move(group)));
  return alone;
}

RunResult run_instant(const PreparedCase& prepared, int threads, const RunHooks& hooks) {
  return form_all(*prepared.value, plies_alone(prepared), threads, hooks);
}

RunResult form_ply(const PreparedCase& prepared, std::size_t ply, int threads,
                   const RunHooks& hooks) {
  const Case& data = *prepared.value;
  std::vector<PlyAlone> alone;
  for (std::vector<std::size_t>& group : groups_of(data))
    if (std::find(group.begin(), group.end(), ply) != group.end())
      alone.push_back(ply_alone(prepared, tools_above(data, prepared.meshes), std::move(group)));
  RunResult result = form_all(data, alone, threads, hooks);
  if (result.summary.plies.size() <= 1) return result; // it did not come to its end
  result.last.plies = {std::move(result.last.plies[ply])};
  result.summary.plies = {std::move(result.summary.plies[ply])};
  return result;
}

} // namespace plyform
