// SPDX-License-Identifier: GPL-3.0-or-later
// The state of a running simulation: plies, tools, contacts between them, sums. Topology is
// constant; the arrays change step by step (core/solver/step.hpp).
#pragma once

#include "base/archive.hpp"
#include "contact/forces/ply_ply.hpp"
#include "core/model/attachment.hpp"
#include "core/model/boundary.hpp"
#include "core/solver/force_filter.hpp"
#include "core/solver/ply_body.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace plyform {

// What a checkpoint keeps of each type stands beside its members: each_member calls f(name,
// member). Where a type has no base it unpacks all members: one more, and it does not compile until
// somebody has said whether it is kept.

/// Forces of a tool: with ToolMotion all that its later steps depend on, but for its contacts.
struct ToolLoad {
  Vec3 force = Vec3::Zero(); ///< N, of the plies on the tool, now
  ForceFilter filter;        ///< of `force`
  double work = 0.0;         ///< N mm, done by the tool on the plies since the start
};

template <class F>
void each_member(ToolLoad& t, F&& f) {
  auto& [force, filter, work] = t;
  f("force", force);
  f("filter", filter);
  f("work", work);
}

/// One tool with its contacts: contacts[i] is with ply i.
struct ToolState : ToolLoad {
  std::string name;
  ToolBody body;
  double force_on = 0.0; ///< N, prescribed force at full load, 0 unless pushed
  std::vector<ToolPlyContact> contacts;
  Vec3 displacement_search = Vec3::Zero();
  double max_displacement = 0.0; ///< mm, largest distance from displacement_search, with what it
                                 ///< may still move in this step
  double path_length = 0.0;      ///< mm, contact/search/active_list.hpp
  bool far = false; ///< core/solver/resting.hpp: it cannot touch a ply before the next search
  std::vector<double> ply_paths; ///< mm, with each ply, with what it may still move in this step
  double seconds = 0.0;          ///< s, computing time of its forces
};

template <class F>
void each_member(ToolState& t, F&& f) {
  each_member(static_cast<ToolLoad&>(t), f);
  f("motion", static_cast<ToolMotion&>(t.body));
  f("displacement_search", t.displacement_search);
  f("max_displacement", t.max_displacement);
  f("path_length", t.path_length);
  f("ply_paths", t.ply_paths);
  f("far", t.far);
  f("contacts", of_fixed_size(t.contacts));
}

/// One pass of the node-to-face contact between two plies, or of a ply with itself.
struct PlyContact {
  int slave = 0, master = 0;
  PlyPlyContact contact;
};

template <class F>
void each_member(PlyContact& pair, F&& f) {
  f("contact", pair.contact);
}

/// Edge-edge contact of two plies, a < b, or of one with itself.
struct PlyEdgeContact {
  int a = 0, b = 0;
  EdgeEdgeContact contact;
};

template <class F>
void each_member(PlyEdgeContact& pair, F&& f) {
  f("contact", pair.contact);
}

/// All contacts of two plies, a < b, or of one with itself, and their forces on the nodes.
struct PlyPair {
  int a = 0, b = 0;
  std::vector<PlyContact> passes; ///< both ways, a as the slave first; of a ply with itself one
  PlyEdgeContact edges;
  std::vector<Vec3> force_a, force_b; ///< N, sums over the contacts; empty until anything may touch
  bool loaded = false;                ///< whether any contact is closed; else the forces are zero
  std::vector<ContactRow> rows_a,
      rows_b; ///< core/solver/contact_rows.hpp; empty if nothing is near
};

template <class F>
void each_member(PlyPair& pair, F&& f) {
  auto& [a, b, passes, edges, force_a, force_b, loaded, rows_a, rows_b] = pair;
  f("passes", of_fixed_size(passes));
  f("edges", edges);
  f("force_a", force_a); // all zero unless loaded
  f("force_b", force_b);
  f("loaded", loaded);
  f("rows_a", rows_a);
  f("rows_b", rows_b);
}

/// Which pass of which pair: Scene::pass_order.
struct PassPlace {
  int pair = 0, pass = 0;
};

/// State of a boundary (Case::boundaries).
struct BoundaryState {
  /// mm, d at the present time; of a gripper its way along its direction, of a spring how much
  /// longer it is than at the start
  double displacement = 0.0;
  double next_displacement = 0.0; ///< mm, d at the end of the coming step
  /// N, (L): positive if it pulls along its stroke; of a gripper along its direction, of a spring
  /// its tension
  double load = 0.0;
  Vec3 force = Vec3::Zero(); ///< N, sum of its forces on the nodes
  double work = 0.0;         ///< N mm, done on the plies since the start
};

template <class F>
void each_member(BoundaryState& boundary, F&& f) {
  auto& [displacement, next_displacement, load, force, work] = boundary;
  f("displacement", displacement);
  f("next_displacement", next_displacement);
  f("load", load);
  f("force", force);
  f("work", work);
}

/// Nodes per block: enough to outweigh the scheduling, few enough to balance the threads.
constexpr int node_block = 512;

/// A range of nodes or strain groups (or one of the ply's SimdBlocks): the unit of work of a
/// thread. Its size is fixed, so that sums do not depend on the number of threads.
struct Block {
  int ply, begin, end;
  double seconds = 0.0; ///< s, computing time since the start
};

/// Sums and maxima over a block of nodes in one step.
struct NodeSums {
  double damping = 0.0; ///< N mm, work of mass damping in this step
  double moved2 = 0.0;  ///< mm^2, largest squared displacement since the last contact search
  double step2 = 0.0;   ///< mm^2, largest squared displacement in this step
};

/// Model of a scene: constant from the first step on.
struct SceneModel {
  Case data;
  std::vector<PrescribedNode> held;    ///< ascending by ply and node
  std::vector<Attachment> attachments; ///< springs and grippers, ascending by boundary
  std::vector<Block> group_blocks, node_blocks, bending_blocks;
  /// The passes of all ply_pairs ascending by slave and master, those of a ply with itself last:
  /// the order of sums over them.
  std::vector<PassPlace> pass_order;
  double element_size = 0.0; ///< mm, the smallest of the mean element sizes of plies that move
  double skin = 0.0;         ///< mm, that of the case, or from the element size
  double sliding_gap = 0.0;  ///< mm, the largest ContactLaw::sliding_gap
  /// mm: gap up to which open contacts count in the stable time step, which is computed again when
  /// anything has moved by half of it (core/solver/contact_rows.hpp)
  double bound_margin = 0.0;
  /// N mm, of all plies with every yarn strained by 1e-7: what is less is rounding errors
  double energy_floor = 0.0;
  bool any_thickness_acts = false; ///< PlyModel::thickness_acts of any
};

/// Plies, tools, boundaries and the contacts between them: arrays whose sizes the case gives.
struct SceneBodies {
  std::vector<PlyBody> plies;
  std::vector<ToolState> tools;
  std::vector<BoundaryState> boundaries; ///< one per entry of Case::boundaries
  std::vector<PlyPair> ply_pairs;        ///< adjacent plies first, which take longest to compute
};

/// Time, step sizes and accumulated sums of the run: a restart must keep them.
struct SceneProgress {
  double time = 0.0;                 ///< s, time of x
  long step = 0;                     ///< steps taken
  double dt = 0.0, next_dt = 0.0;    ///< s, the time step that led to x and the next one
  double stable_dt = 0.0;            ///< s, step_factor times the stable time step
  double min_dt = 0.0, max_dt = 0.0; ///< s, used so far
  double bound_displacement = 0.0;   ///< mm, largest_displacement when stable_dt was computed
  /// Ratio of the stable step to its bound: core/solver/stable_time_step.hpp.
  double time_step_gain = 1.0;
  long next_lanczos = 0;     ///< the next step that updates time_step_gain and eigenvalue_ratio
  double start_energy = 0.0; ///< N mm, energy of the plies at the start
  double mass_damping_work = 0.0;  ///< N mm, since the start
  double mass_scaling_work = 0.0;  ///< N mm, kinetic energy of the mass added, since the start
  double largest_added_mass = 0.0; ///< of the mass of any ply, at any time
  std::vector<double> group_sums;  ///< N mm, lost by yarns in the steps taken, one per group block
  std::vector<double> torn_sums;   ///< likewise, that stitches had stored when they broke
  long searches = 0;               ///< number of contact searches so far
  /// Ratios of thickness at the last search: the largest, the smallest (core/ply/thickness.hpp).
  double thickest = 1.0, thinnest = 1.0;
  double cooled_until = 0.0; ///< s, time of the temperatures (core/solver/follow_temperature.hpp)
  double tightened_until = 0.0; ///< s, time of the pre-tension (core/solver/pretension.hpp)
};

template <class F>
void each_member(SceneProgress& progress, F&& f) {
  auto& [time, step, dt, next_dt, stable_dt, min_dt, max_dt, bound_displacement, time_step_gain,
         next_lanczos, start_energy, mass_damping_work, mass_scaling_work, largest_added_mass,
         group_sums, torn_sums, searches, thickest, thinnest, cooled_until, tightened_until] =
      progress;
  f("time", time);
  f("step", step);
  f("dt", dt);
  f("next_dt", next_dt);
  f("stable_dt", stable_dt);
  f("min_dt", min_dt);
  f("max_dt", max_dt);
  f("bound_displacement", bound_displacement);
  f("time_step_gain", time_step_gain);
  f("next_lanczos", next_lanczos);
  f("start_energy", start_energy);
  f("mass_damping_work", mass_damping_work);
  f("mass_scaling_work", mass_scaling_work);
  f("largest_added_mass", largest_added_mass);
  f("group_sums", group_sums);
  f("torn_sums", torn_sums);
  f("searches", searches);
  f("thickest", thickest);
  f("thinnest", thinnest);
  f("cooled_until", cooled_until);
  f("tightened_until", tightened_until);
}

/// Temporary data of one step.
struct SceneWorkspace {
  std::vector<SurfaceKinematics> ply_states; ///< views of the plies
  std::vector<double> group_lost;    ///< N mm, the same in the step computed, until it is taken
  std::vector<double> group_torn;    ///< N mm, likewise
  std::vector<char> group_collapsed; ///< whether a triangle has collapsed, one per group block
  std::vector<NodeSums> node_sums;   ///< one per node block
  std::vector<std::vector<int>> force_shares; ///< of the tasks of forces, one share a thread
};

struct Scene : SceneModel, SceneBodies, SceneProgress, SceneWorkspace {};

template <class F>
void each_member(Scene& s, F&& f) {
  f("plies", of_fixed_size(s.plies));
  f("tools", of_fixed_size(s.tools));
  f("boundaries", of_fixed_size(s.boundaries));
  f("ply_pairs", of_fixed_size(s.ply_pairs));
  f("node_sums", of_fixed_size(s.node_sums));
  f("progress", static_cast<SceneProgress&>(s));
}

/// visit(pass) for every PlyContact, in pass_order. scene: a Scene, const or not.
template <class SomeScene, class Visit>
void each_pass(SomeScene& scene, const Visit& visit) {
  for (const PassPlace& at : scene.pass_order)
    visit(scene.ply_pairs[static_cast<std::size_t>(at.pair)]
              .passes[static_cast<std::size_t>(at.pass)]);
}

/// visit(edges) for every PlyEdgeContact, in the same order.
template <class SomeScene, class Visit>
void each_edge_contact(SomeScene& scene, const Visit& visit) {
  for (const PassPlace& at : scene.pass_order)
    if (at.pass == 0) visit(scene.ply_pairs[static_cast<std::size_t>(at.pair)].edges);
}

inline bool any_self_contact(const Scene& s) {
  return std::any_of(s.plies.begin(), s.plies.end(),
                     [](const PlyBody& ply) { return ply.self_contact; });
}

/// Builds the scene of a case: meshes, membranes, bending, contacts with their stiffnesses, and the
/// initial positions. meshes: one per ply; if empty, the blanks are meshed here. threads >= 1.
/// Throws std::runtime_error if a blank cannot be meshed.
Scene make_scene(const Case& data, const std::vector<BlankMesh>& meshes = {}, int threads = 1);

} // namespace plyform
