// SPDX-License-Identifier: GPL-3.0-or-later
// A ply in motion, in three parts. Its model does not change. Its state is all that its later
// motion depends on: a run that goes back takes it back. Its cache follows from both; without it a
// search and new bounds come first, and only the last digits of what follows differ.
//
// Model and cache are parts of each ply, not shared: plies differ in height and reach, and what
// most of a stack has in common, the constants of the kernels, is shared already
// (core/ply/shared_constants.hpp).
#pragma once

#include "contact/forces/edge_edge.hpp"
#include "contact/forces/tool_ply.hpp"
#include "contact/search/fold_bound.hpp"
#include "contact/search/sheet_bvh.hpp"
#include "core/ply/bending_simd.hpp"
#include "core/ply/membrane_eigenvalue.hpp"
#include "core/ply/membrane_simd.hpp"
#include "core/ply/thickness.hpp"
#include "core/ply/viscous_simd.hpp"

#include <cmath>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

namespace plyform {

// Arrays of n nodes.

/// Model of a ply: constant from the first step on, but for the forces that kernels leave in their
/// blocks.
struct PlyModel {
  std::string name;
  double angle = 0.0;     ///< rad, from x, before forming
  double thickness = 0.0; ///< mm
  std::vector<Vec3> x0;   ///< mm, before forming
  Membrane membrane;
  std::optional<MembraneSimd> simd;       ///< SIMD version of the membrane; none without yarns
  std::optional<BendingSimd> bending;     ///< none without bending stiffness
  std::optional<ViscousMembrane> viscous; ///< none without laws in the plane that have rates
  std::optional<ViscousBending> viscous_bending; ///< none without bending that has
  SheetEdges edges;
  std::vector<SymmetryPlane> planes;       ///< of symmetry, at right angles to each other
  std::vector<NodesOnPlane> on_planes;     ///< one for each
  double ridge_limit = 0.0;                ///< contact/search/sheet_ridges.hpp
  std::vector<char> touches_boundary_edge; ///< triangles with a node on the boundary edge
  // What follows from which bodies may meet: core/model/reach_ahead.hpp.
  int stack = 0;             ///< the lowest ply of its stack
  bool stacked = false;      ///< whether its stack has other plies
  bool left_alone = false;   ///< nothing may move it, but something moves others
  bool self_contact = false; ///< whether it is in contact with itself, too
  ThicknessLaw thickness_law;
  bool thickness_acts = false; ///< in contact: core/solver/follow_thickness.hpp
  /// N/mm^3, of the contacts that bear the vacuums that push it (core/solver/vacuum_contact.hpp)
  double vacuum_stiffness = 0.0;
  std::vector<double>
      rim_distance;    ///< contact/search/sheet_edges.hpp; where films slide and heat flows
  bool convex = false; ///< contact/search/unfolded.hpp; not asked without self-contact
};

/// What an array has an entry for.
enum class On { ply, node, triangle, pack, edge, patch };

/// State of a ply.
struct PlyState {
  std::vector<Vec3> x;        ///< mm
  std::vector<Vec3> velocity; ///< mm/s, half a step before the time of x
  std::vector<Vec3> motion;   ///< mm, displacement in the last step
  std::vector<Vec3> reaction; ///< N, of boundaries on each node; empty if none prescribes any
  std::vector<double> mass;   ///< t, with what core/solver/mass_scaling.hpp adds
  /// What yarns remember of the begin of the step that comes, or was computed but not yet taken;
  /// empty without yarns.
  std::vector<SimdYarnStates> yarns;
  std::vector<double> temperature; ///< degC; empty in cases without temperatures
  /// At rest where it began, with nothing near that moves (core/solver/resting.hpp).
  bool resting = false;
  /// N mm, done by pressures since the start, but for what PlyCache::last_load_work has.
  double load_work = 0.0;
  /// N mm, what laws that change with the time gave at a fixed shape to what is stored, since the
  /// start: shear by its temperature, stitches by pre-tension that comes up.
  double law_work = 0.0;
  /// What laws with rates keep, as `yarns`: ViscousMembrane::states of each triangle, in the
  /// kernel's order, or empty.
  PackedStates viscous_states;
  PackedStates bending_states; ///< likewise ViscousBending::states of each node
};

/// The one list of a ply's state: f(name, place, values) for each member. Checkpoint, comparison
/// and hash walk it, and what is loaded is checked by it. A member that is not listed does not
/// compile.
template <class F>
void each_array(PlyState& ply, F&& f) {
  auto& [x, velocity, motion, reaction, mass, yarns, temperature, resting, load_work, law_work,
         viscous_states, bending_states] = ply;
  f("x", On::node, x);
  f("velocity", On::node, velocity);
  f("motion", On::node, motion);
  f("reaction", On::node, reaction);
  f("mass", On::node, mass);
  f("yarns", On::pack, yarns);
  f("temperature", On::node, temperature);
  f("resting", On::ply, resting);
  f("load_work", On::ply, load_work);
  f("law_work", On::ply, law_work);
  f("viscous_states", On::pack, viscous_states);
  f("bending_states", On::pack, bending_states);
}

/// Cache of a ply: what the last search found, bounds of the stable time step, workspace.
struct PlyCache {
  std::vector<Vec3> x_search;     ///< mm, x at the last contact search
  double max_displacement = 0.0;  ///< mm, largest distance of any node from x_search since then
  double path_length = 0.0;       ///< mm, contact/search/active_list.hpp
  std::vector<double> fold_bound; ///< contact/search/fold_bound.hpp, one per triangle
  /// mm, sum over the steps since it was computed of the largest relative displacement of two nodes
  /// of a patch of edges
  double fold_motion = 0.0;
  std::array<std::vector<char>, 2> occluded; ///< per node, by the adjacent ply below [0], above [1]
  SheetRidges ridges;         ///< contact/search/sheet_ridges.hpp; of a single ply none
  std::vector<char> unfolded; ///< per node, contact/search/unfolded.hpp; empty without self-contact
  EigenvalueBound bound;      ///< of the membrane, updated at least every 200 steps
  double eigenvalue_ratio = 1.0; ///< core/ply/membrane_eigenvalue.hpp, updated every 1000 steps
  double lanczos_contacts = 0.0; ///< 1/s^2, bound of contacts when time_step_gain was computed
  std::vector<double> thickness_ratio; ///< present over unformed thickness, of the nodes
  double thickening = 0.0;      ///< mm, largest change of half the thickness in the last step
  double thickening_path = 0.0; ///< mm, its sum since the last search
  // Not in the list:
  std::vector<Vec3> fibres;        ///< how they run at each node at the last search, of any length
  std::unique_ptr<SheetTree> tree; ///< follows from x_search
  double search_seconds = 0.0;     ///< s, refitting the tree, computing fold bounds
  std::vector<ElementForce> q;     ///< forces without simd, one per triangle
  std::vector<Box3> patch_motion;  ///< mm, as of patch_motions, of the last step
  /// Arrays of reaction and contact forces that are not zero in this step, in fixed order.
  std::vector<const std::vector<Vec3>*> nodal_forces;
  std::vector<Vec3> pull; ///< N, of springs on each node; empty if none hangs on it
  std::vector<Vec3> load; ///< N, of pressures on each node; empty if there is none
  /// N/mm^2, positive upwards, on each node: what contact has of the vacuums that push the ply, by
  /// core/solver/vacuum_contact.hpp; empty: there is none
  std::vector<double> borne_load;
  std::vector<double> area_now; ///< mm^2, of each node, of plies that a vacuum presses; else empty
  double last_load_work = 0.0; ///< N mm, of these forces over the half of the step that led to them
  std::vector<double> last_ratio;    ///< thickness_ratio in the step before
  std::vector<double> squeeze;       ///< N/mm, core/solver/thickness_forces.cpp; so below
  std::vector<Vec3> thickness_force; ///< N, on each node; valid while `pressed`
  bool pressed = false;
  /// What yarns will remember once the step that was computed is taken.
  std::vector<SimdYarnStates> yarns_end;
  PackedStates viscous_end, bending_end;                 ///< likewise, of states of laws with rates
  bool viscous_stepped = false, bending_stepped = false; ///< whether of the step that was computed
  /// What temperatures make of viscosities, of each triangle and of each node, of elastic shear,
  /// and of the times of yarns of each strain group; empty: nothing.
  PackedStates flow_factors, node_flow_factors, shear_factors, time_factors;
  /// s, SceneProgress::cooled_until of the temperatures that they are of.
  double flow_time = std::numeric_limits<double>::quiet_NaN();
};

/// The list of what a checkpoint keeps of the cache, so that a run goes on with the same bits.
template <class F>
void each_array(PlyCache& ply, F&& f) {
  auto& [x_search, max_displacement, path_length, fold_bound, fold_motion, occluded, ridges,
         unfolded, bound, eigenvalue_ratio, lanczos_contacts, thickness_ratio, thickening,
         thickening_path, fibres, tree, search_seconds, q, patch_motion, nodal_forces, pull, load,
         borne_load, area_now, last_load_work, last_ratio, squeeze, thickness_force, pressed,
         yarns_end, viscous_end, bending_end, viscous_stepped, bending_stepped, flow_factors,
         node_flow_factors, shear_factors, time_factors, flow_time] = ply;
  f("x_search", On::node, x_search);
  f("max_displacement", On::ply, max_displacement);
  f("path_length", On::ply, path_length);
  f("fold_bound", On::triangle, fold_bound);
  f("fold_motion", On::ply, fold_motion);
  f("occluded_below", On::node, occluded[0]);
  f("occluded_above", On::node, occluded[1]);
  f("ridges.sides", On::edge, ridges.sides);
  f("ridges.room", On::patch, ridges.room);
  f("unfolded", On::node, unfolded);
  f("bound", On::ply, bound);
  f("eigenvalue_ratio", On::ply, eigenvalue_ratio);
  f("lanczos_contacts", On::ply, lanczos_contacts);
  f("thickness_ratio", On::node, thickness_ratio);
  f("thickening", On::ply, thickening);
  f("thickening_path", On::ply, thickening_path);
}

/// A ply in motion.
struct PlyBody : PlyModel, PlyState, PlyCache {
  LawFactors law_factors() const { return {shear_factors, time_factors}; }
  SurfaceKinematics state() const {
    return {x,
            motion,
            membrane.node_area,
            fold_bound,
            edges.faces_across,
            thickness_ratio,
            fibres,
            edges.all,
            rim_distance,
            temperature,
            area_now};
  }
  /// States of laws with rates now, those of the step that was computed or of the one taken: of
  /// the first triangle, of the second ...; and of nodes.
  std::vector<double> viscous_now() const {
    return by_triangles(*simd, membrane, viscous_stepped ? viscous_end : viscous_states,
                        viscous->states);
  }
  std::vector<double> bending_now() const {
    return by_nodes(*bending, x.size(), bending_stepped ? bending_end : bending_states,
                    viscous_bending->states());
  }
  EdgeSheet edge_sheet() const { return {state(), edges, patch_motion, ridges.sides}; }
};

/// Per node, the sum of the normals of its triangles, mirror images at planes of symmetry included,
/// each twice as long (mm^2) as its area; on a plane half of it.
std::vector<Vec3> normals_at_nodes(const PlyBody& ply);

/// Area of a ply before forming, mm^2.
inline double area_of(const PlyModel& ply) {
  const std::vector<double>& areas = ply.membrane.node_area;
  return std::accumulate(areas.begin(), areas.end(), 0.0);
}

/// Mean area (mm^2) of two triangles, the square of the element size.
inline double cell_area(const PlyModel& ply) {
  return 2.0 * area_of(ply) / static_cast<double>(ply.membrane.triangles.size());
}

/// Mean element size (mm): side of a square of two triangles.
inline double element_size(const PlyModel& ply) {
  return std::sqrt(cell_area(ply));
}

template <class F>
void each_member(PlyBody& ply, F&& f) {
  const auto without_place = [&f](const char* name, On, auto& values) { f(name, values); };
  each_array(static_cast<PlyState&>(ply), without_place);
  each_array(static_cast<PlyCache&>(ply), without_place);
}

template <class F>
void each_member(PlyState& ply, F&& f) {
  each_array(ply, [&f](const char* name, On, auto& values) { f(name, values); });
}

} // namespace plyform
