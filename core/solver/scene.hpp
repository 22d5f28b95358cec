// SPDX-License-Identifier: GPL-3.0-or-later
// The state of a running simulation: plies, tools, contacts between them, sums. Topology is
// constant; the arrays change step by step (core/solver/step.hpp).
#pragma once

#include "contact/forces/edge_edge.hpp"
#include "contact/forces/ply_ply.hpp"
#include "contact/forces/tool_ply.hpp"
#include "contact/search/fold_bound.hpp"
#include "core/model/attachment.hpp"
#include "core/model/boundary.hpp"
#include "core/ply/bending_simd.hpp"
#include "core/ply/membrane_eigenvalue.hpp"
#include "core/ply/membrane_simd.hpp"
#include "core/solver/force_filter.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace plyform {

// A ply is made of parts, each with one purpose. Arrays of n nodes.

/// Model of a ply: constant from the first step on, except for the state variables of viscosity.
struct PlyModel {
  std::string name;
  double angle = 0.0;     ///< rad, warp from x, before forming
  double thickness = 0.0; ///< mm
  std::vector<Vec3> x0;   ///< mm, before forming
  Membrane membrane;
  std::optional<MembraneSimd> simd;   ///< SIMD version of the membrane; none without yarns
  std::optional<BendingSimd> bending; ///< none without bending stiffness
  SheetEdges edges;
  double ridge_limit = 0.0;                ///< contact/search/sheet_ridges.hpp
  std::vector<char> touches_boundary_edge; ///< triangles with a node on the boundary edge
  // What follows from which bodies may meet: core/model/reach_ahead.hpp.
  int stack = 0;             ///< the lowest ply of its stack
  bool stacked = false;      ///< whether its stack has other plies
  bool left_alone = false;   ///< nothing may move it, but something moves others
  bool self_contact = false; ///< whether it is in contact with itself, too
  bool convex = false;       ///< contact/search/unfolded.hpp; not asked without self-contact
};

/// Position and velocity of a ply: the state that a restart must keep.
struct PlyKinematics {
  std::vector<Vec3> x;        ///< mm
  std::vector<Vec3> velocity; ///< mm/s, half a step before the time of x
  std::vector<Vec3> motion;   ///< mm, displacement in the last step
  std::vector<Vec3> reaction; ///< N, of boundaries on each node; empty if none prescribes any
};

/// Data of the last contact search, and the displacements since.
struct PlySearch {
  std::vector<Vec3> x_search;    ///< mm, x at the last contact search
  double max_displacement = 0.0; ///< mm, largest distance of any node from x_search since then
  double path_length = 0.0;      ///< mm, contact/search/active_list.hpp
  std::unique_ptr<SheetTree> tree;
  std::vector<double> fold_bound; ///< contact/search/fold_bound.hpp, one per triangle
  /// mm, sum over the steps since it was computed of the largest relative displacement of two nodes
  /// of a patch of edges
  double fold_motion = 0.0;
  std::array<std::vector<char>, 2> occluded; ///< per node, by the adjacent ply below [0], above [1]
  SheetRidges ridges;         ///< contact/search/sheet_ridges.hpp; of a single ply none
  std::vector<char> unfolded; ///< per node, contact/search/unfolded.hpp; empty without self-contact
  double search_seconds = 0.0; ///< s, refitting the tree, computing fold bounds
};

/// Bounds that limit the stable time step (core/solver/stable_time_step.hpp).
struct PlyStability {
  EigenvalueBound bound;         ///< of the membrane, updated at least every 200 steps
  double eigenvalue_ratio = 1.0; ///< core/ply/membrane_eigenvalue.hpp, updated every 1000 steps
  double lanczos_contacts = 0.0; ///< 1/s^2, bound of contacts when time_step_gain was computed
  std::vector<double> mass;      ///< t, one per node, with what core/solver/mass_scaling.hpp adds
};

/// Whether a ply is part of the motion: core/solver/resting.hpp.
struct PlyRest {
  bool resting = false; ///< at rest where it began, with nothing near that moves
};

/// Temporary data of one step.
struct PlyWorkspace {
  std::vector<ElementForce> q;    ///< forces without simd, one per triangle
  std::vector<Box3> patch_motion; ///< mm, as of patch_motions, of the last step
  /// Arrays of reaction and contact forces that are not zero in this step, in fixed order.
  std::vector<const std::vector<Vec3>*> nodal_forces;
  std::vector<Vec3> pull; ///< N, of springs on each node; empty if none hangs on it
};

/// A ply and its state.
struct PlyState : PlyModel, PlyKinematics, PlySearch, PlyStability, PlyRest, PlyWorkspace {
  SurfaceKinematics state() const {
    return {x, motion, membrane.node_area, fold_bound, edges.faces_across};
  }
  EdgeSheet edge_sheet() const { return {state(), edges, patch_motion, ridges.sides}; }
};

/// One tool with its contacts: contacts[i] is with ply i.
struct ToolState {
  std::string name;
  ToolBody body;
  double force_on = 0.0; ///< N, prescribed force at full load, 0 unless pushed
  std::vector<ToolPlyContact> contacts;
  Vec3 force = Vec3::Zero(); ///< N, of the plies on the tool, now
  ForceFilter filter;        ///< of `force`
  Vec3 displacement_search = Vec3::Zero();
  double max_displacement = 0.0; ///< mm, largest distance from displacement_search, with what it
                                 ///< may still move in this step
  double path_length = 0.0;      ///< mm, contact/search/active_list.hpp
  bool far = false; ///< core/solver/resting.hpp: it cannot touch a ply before the next search
  std::vector<double> ply_paths; ///< mm, with each ply, with what it may still move in this step
  double work = 0.0;             ///< N mm, done by the tool on the plies since the start
  double seconds = 0.0;          ///< s, computing time of its forces
};

/// One pass of the node-to-face contact between two plies, or of a ply with itself.
struct PlyContact {
  int slave = 0, master = 0;
  PlyPlyContact contact;
};

/// Edge-edge contact of two plies, a < b, or of one with itself.
struct PlyEdgeContact {
  int a = 0, b = 0;
  EdgeEdgeContact contact;
};

/// All contacts of two plies, a < b, or of one with itself, and their forces on the nodes.
struct PlyPair {
  int a = 0, b = 0;
  std::vector<int> contacts;          ///< in Scene::ply_contacts
  std::vector<int> edges;             ///< in Scene::edge_contacts
  std::vector<Vec3> force_a, force_b; ///< N, sums over the contacts; empty until anything may touch
  bool loaded = false;                ///< whether any contact is closed; else the forces are zero
  std::vector<ContactRow> rows_a,
      rows_b; ///< core/solver/contact_rows.hpp; empty if nothing is near
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
  double element_size = 0.0; ///< mm, the smallest of the mean element sizes of plies that move
  double skin = 0.0;         ///< mm, that of the case, or from the element size
  /// mm: gap up to which open contacts count in the stable time step, which is computed again when
  /// anything has moved by half of it (core/solver/contact_rows.hpp)
  double bound_margin = 0.0;
  /// N mm, of all plies with every yarn strained by 1e-7: what is less is rounding errors
  double energy_floor = 0.0;
};

/// Plies, tools, boundaries and the contacts between them.
struct SceneBodies {
  std::vector<PlyState> plies;
  std::vector<ToolState> tools;
  std::vector<BoundaryState> boundaries; ///< one per entry of Case::boundaries
  std::vector<PlyContact> ply_contacts;
  std::vector<PlyEdgeContact> edge_contacts;
  std::vector<PlyPair> ply_pairs;
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
  std::vector<double> group_sums;  ///< N mm, viscous work since the start, one per group block
  long searches = 0;               ///< number of contact searches so far
};

/// Temporary data of one step.
struct SceneWorkspace {
  std::vector<SurfaceKinematics> ply_states; ///< views of the plies
  std::vector<char> group_collapsed; ///< whether a triangle has collapsed, one per group block
  std::vector<NodeSums> node_sums;   ///< one per node block
  std::vector<std::vector<int>> force_shares; ///< of the tasks of forces, one share a thread
};

struct Scene : SceneModel, SceneBodies, SceneProgress, SceneWorkspace {};

inline bool any_self_contact(const Scene& s) {
  return std::any_of(s.plies.begin(), s.plies.end(),
                     [](const PlyState& ply) { return ply.self_contact; });
}

/// Builds the scene of a case: meshes, membranes, bending, contacts with their stiffnesses, and the
/// initial positions. meshes: one per ply; if empty, the blanks are meshed here. threads >= 1.
/// Throws std::runtime_error if a blank cannot be meshed.
Scene make_scene(const Case& data, const std::vector<BlankMesh>& meshes = {}, int threads = 1);

} // namespace plyform
