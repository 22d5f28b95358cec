// SPDX-License-Identifier: GPL-3.0-or-later
// Everything a running simulation holds: plies, tools, contacts between them, sums. Topology is
// constant; the arrays change step by step (core/solver/step.hpp).
#pragma once

#include "contact/forces/edge_edge.hpp"
#include "contact/forces/ply_ply.hpp"
#include "contact/forces/tool_ply.hpp"
#include "contact/search/fold_bound.hpp"
#include "core/model/boundary.hpp"
#include "core/ply/bending_simd.hpp"
#include "core/ply/membrane_eigenvalue.hpp"
#include "core/ply/membrane_simd.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace plyform {

// A ply is made of parts, each with one purpose. Arrays of n nodes.

/// What a ply is: constant from the first step on, but for the viscous memory of its yarns.
struct PlyModel {
  std::string name;
  double angle = 0.0;     ///< rad, warp from x, before forming
  double thickness = 0.0; ///< mm
  std::vector<Vec3> x0;   ///< mm, before forming
  Membrane membrane;
  std::optional<MembraneSimd> simd; ///< its forces four at a time, unless it has no yarns
  std::optional<Bending> bending;   ///< if the fabric has it
  BendingSimd bending_simd;         ///< its forces, or empty
  std::vector<SheetEdge> edges;
  std::vector<char> touches_boundary_edge; ///< triangles with a node on the boundary edge
};

/// Where it is and how it moves: what a restart must keep.
struct PlyKinematics {
  std::vector<Vec3> x;        ///< mm
  std::vector<Vec3> velocity; ///< mm/s, half a step behind x
  std::vector<Vec3> motion;   ///< mm, of the last step
  std::vector<Vec3> reaction; ///< N, that boundaries hold each node with; empty if none does
};

/// What the last contact search knew, and how far the ply has gone since.
struct PlySearch {
  std::vector<Vec3> x_search;    ///< mm, where the contact search was last done
  double max_displacement = 0.0; ///< mm, furthest that any node has been from there
  double path_length = 0.0;      ///< mm, contact/search/active_list.hpp
  std::unique_ptr<SheetTree> tree;
  std::vector<double> fold_bound;            ///< contact/search/fold_bound.hpp, one a triangle
  double fold_bound_displacement = 0.0;      ///< mm, max_displacement when it was last renewed
  std::array<std::vector<char>, 2> occluded; ///< nodes that the next ply below, above covers
  double search_seconds = 0.0;               ///< refitting the tree, bounding folds
};

/// What its own elements and contacts allow of the time step.
struct PlyStability {
  EigenvalueBound bound;         ///< of the membrane, renewed now and then
  double eigenvalue_ratio = 1.0; ///< core/ply/membrane_eigenvalue.hpp, renewed more rarely
  double stretch_contacts = 0.0; ///< 1/s^2, bound of contacts when Scene::time_step_gain was found
};

/// Scratch of one step.
struct PlyWorkspace {
  std::vector<ElementForce> q; ///< forces without simd, one a triangle
  /// Reaction and contacts: those in use now, in order.
  std::vector<const std::vector<Vec3>*> nodal_forces;
};

/// A ply in motion.
struct PlyState : PlyModel, PlyKinematics, PlySearch, PlyStability, PlyWorkspace {
  SurfaceKinematics state() const { return {x, motion, membrane.node_area, fold_bound}; }
};

/// One tool with its contacts: contacts[i] is with ply i.
struct ToolState {
  std::string name;
  ToolBody body;
  double stroke = 0.0;   ///< mm, 0 unless driven
  double force_on = 0.0; ///< N, 0 unless pushed
  std::vector<ToolPlyContact> contacts;
  Vec3 force = Vec3::Zero(); ///< N, of the plies on the tool, now
  Vec3 displacement_search = Vec3::Zero();
  double max_displacement =
      0.0;                  ///< mm, furthest from there, what it may still do in this step included
  double path_length = 0.0; ///< mm, contact/search/active_list.hpp
  std::vector<double> ply_paths; ///< mm, with each ply, what it may still do in this step included
  double work = 0.0;             ///< N mm, done by the tool on the plies since the start
  double seconds = 0.0;          ///< all of its forces
};

/// One directed contact between two plies, or of a ply with itself.
struct PlyContact {
  int slave = 0, master = 0;
  PlyPlyContact contact;
};

/// Edges of two plies, a < b, or of one with itself.
struct PlyEdgeContact {
  int a = 0, b = 0;
  EdgeEdgeContact contact;
};

/// Two plies, a < b, or one with itself, and what their contacts do to their nodes.
struct PlyPair {
  int a = 0, b = 0;
  std::vector<int> contacts;          ///< in Scene::ply_contacts
  std::vector<int> edges;             ///< in Scene::edge_contacts
  std::vector<Vec3> force_a, force_b; ///< N, of all of them; empty while none may touch
  bool loaded = false;                ///< something touches now; else the forces are zero
};

/// What a boundary (Case::boundaries) is doing.
struct BoundaryState {
  double displacement = 0.0;      ///< mm, d, now
  double next_displacement = 0.0; ///< mm, d at the end of the coming step
  double load = 0.0;              ///< N, (L): + when it pulls along its stroke
  Vec3 force = Vec3::Zero();      ///< N, sum of what it holds its nodes with
  double work = 0.0;              ///< N mm, done on the plies since the start
};

/// Nodes in a block: long enough to hide the hand-over, short enough to share out.
constexpr int node_block = 512;

/// A run of nodes or groups (or one of the ply's SimdBlocks): the unit of work of a thread. Fixed
/// size, so that sums come out the same whatever the number of threads.
struct Block {
  int ply, begin, end;
  double seconds = 0.0; ///< computing time since the start
};

/// What a block of nodes reports of one step.
struct NodeSums {
  double damping = 0.0; ///< N mm, work of mass damping in this step
  double moved2 = 0.0;  ///< mm^2, largest squared way since the last contact search
  double step2 = 0.0;   ///< mm^2, largest squared way of this step
};

/// What a scene is: constant from the first step on.
struct SceneModel {
  Case data;
  std::vector<PrescribedNode> held; ///< by ply and node
  std::vector<Block> group_blocks, node_blocks, bending_blocks;
  double element_size = 0.0; ///< mm, smallest mean of a ply
  double skin = 0.0;         ///< mm, Case's or by the element size
};

/// Plies, tools, boundaries and the contacts between them.
struct SceneBodies {
  std::vector<PlyState> plies;
  std::vector<ToolState> tools;
  std::vector<BoundaryState> boundaries; ///< one each of Case::boundaries
  std::vector<PlyContact> ply_contacts;
  std::vector<PlyEdgeContact> edge_contacts;
  std::vector<PlyPair> ply_pairs;
};

/// How far the run has come, and what was summed up on the way: a restart must keep it.
struct SceneProgress {
  double time = 0.0;                 ///< s, of x
  long step = 0;                     ///< steps taken
  double dt = 0.0, next_dt = 0.0;    ///< s, the step that led to x and the one that leaves it
  double stable_dt = 0.0;            ///< s, step_factor times the stable step when last renewed
  double min_dt = 0.0, max_dt = 0.0; ///< s, used so far
  double bound_displacement = 0.0; ///< mm, largest displacement since the search at the last bound
  double time_step_gain = 1.0;    ///< stable step over its bound (core/solver/stable_time_step.hpp)
  long next_lanczos = 0;          ///< the next step that renews time_step_gain and eigenvalue_ratio
  double start_energy = 0.0;      ///< N mm, that the plies were given to start with
  double mass_damping_work = 0.0; ///< N mm, since the start
  std::vector<double> group_sums; ///< N mm, viscous work since the start, one a group block
  long searches = 0;              ///< broad phases done
};

/// Scratch of one step.
struct SceneWorkspace {
  std::vector<SurfaceKinematics> ply_states; ///< views of the plies
  std::vector<char> group_collapsed; ///< whether a triangle has collapsed, one a group block
  std::vector<NodeSums> node_sums;   ///< one a node block
};

struct Scene : SceneModel, SceneBodies, SceneProgress, SceneWorkspace {};

/// Places plies and tools, sets contact stiffness from the stable step. meshes: of the blanks, one
/// a ply; none: they are meshed here. Throws std::runtime_error if a blank cannot be meshed.
Scene make_scene(const Case& data, const std::vector<BlankMesh>& meshes = {});

} // namespace plyform
