// SPDX-License-Identifier: GPL-3.0-or-later
// The plies of a scene in time, and the case that they are of: what every part of a step may see.
// Tools, contacts and boundaries belong to the kinds of force (core/solver/force_kinds.hpp); who
// takes a Layup has nothing to do with them.
#pragma once

#include "base/archive.hpp"
#include "core/model/case.hpp"
#include "core/solver/ply_body.hpp"

#include <algorithm>
#include <vector>

namespace plyform {

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

/// Model of a layup, but for its plies: constant from the first step on.
struct SceneModel {
  Case data;
  std::vector<Block> node_blocks;
  double element_size = 0.0; ///< mm, the smallest of the mean element sizes of plies that move
  double skin = 0.0;         ///< mm, that of the case, or from the element size
  double sliding_gap = 0.0;  ///< mm, the largest ContactLaw::sliding_gap
  /// mm: gap up to which open contacts count in the stable time step, which is computed again when
  /// anything has moved by half of it (core/solver/contact_rows.hpp)
  double bound_margin = 0.0;
  /// N mm, of all plies with every yarn strained by 1e-7: what is less is rounding errors
  double energy_floor = 0.0;
  bool any_thickness_acts = false; ///< PlyModel::thickness_acts of any
  bool plies_meet = false;         ///< whether any contact between plies is computed
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
         searches, thickest, thinnest, cooled_until, tightened_until] = progress;
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
  f("searches", searches);
  f("thickest", thickest);
  f("thinnest", thinnest);
  f("cooled_until", cooled_until);
  f("tightened_until", tightened_until);
}

/// Temporary data of one step.
struct SceneWorkspace {
  std::vector<SurfaceKinematics> ply_states;  ///< views of the plies
  std::vector<NodeSums> node_sums;            ///< one per node block
  std::vector<std::vector<int>> force_shares; ///< of the tasks of forces, one share a thread
};

struct Layup : SceneModel, SceneProgress, SceneWorkspace {
  std::vector<PlyBody> plies;
};

inline bool any_self_contact(const Layup& layup) {
  return std::any_of(layup.plies.begin(), layup.plies.end(),
                     [](const PlyBody& ply) { return ply.self_contact; });
}

} // namespace plyform
