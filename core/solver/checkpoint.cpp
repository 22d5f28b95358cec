// SPDX-License-Identifier: GPL-3.0-or-later
// Not kept: the models of plies, tools and boundaries, which come from the case; forces, which the
// next step computes; times for the report.
#include "core/solver/checkpoint.hpp"

#include "core/solver/checkpoint_checks.hpp"

#include <stdexcept>

namespace plyform {

/// Values whose number the scene gives.
template <class Archive, class T>
void visit_all(Archive& a, std::vector<T>& values) {
  auto size = static_cast<std::uint64_t>(values.size());
  visit(a, size);
  if (size != values.size()) throw std::runtime_error("is of another scene");
  for (T& value : values)
    visit(a, value);
}

// The members of each type, found by their arguments.

template <class Archive>
void visit(Archive& a, PlyKinematics& p) {
  visit(a, p.x, p.velocity, p.motion, p.reaction);
}

template <class Archive>
void visit(Archive& a, EigenvalueBound& b) {
  visit(a, b.omega2, b.yarns, b.soft, b.penalty_acts, b.damping, b.viscous, b.triangle);
}

template <class Archive>
void visit(Archive& a, PlyState& ply) {
  visit(a, static_cast<PlyKinematics&>(ply));
  visit(a, ply.x_search, ply.max_displacement, ply.path_length, ply.fold_bound, ply.fold_motion,
        ply.ridges.sides, ply.ridges.room, ply.occluded[0], ply.occluded[1], ply.unfolded);
  visit(a, ply.bound, ply.eigenvalue_ratio, ply.lanczos_contacts, ply.mass, ply.resting);
  visit(a, ply.membrane.last_lambda, ply.membrane.last_viscous);
  if (ply.simd) visit(a, ply.simd->viscosity);
}

template <class Archive>
void visit(Archive& a, ActiveList& list) {
  visit(a, list.free_until, list.active, list.until, list.last_path, list.ahead);
}

template <class Archive>
void visit(Archive& a, ToolPlyContact& c) {
  visit(a, c.points, c.list, c.free, c.hints, c.force, c.sums, c.renew_depth);
}

template <class Archive>
void visit(Archive& a, ForceFilter& f) {
  visit(a, f.once, f.twice);
}

template <class Archive>
void visit(Archive& a, ToolState& t) {
  visit(a, t.body.displacement, t.body.motion, t.body.force, t.body.speed);
  visit(a, t.filter);
  visit(a, t.force, t.displacement_search, t.max_displacement, t.path_length, t.ply_paths, t.work,
        t.far);
  visit_all(a, t.contacts);
}

template <class Archive>
void visit(Archive& a, BoundaryState& b) {
  visit(a, b.displacement, b.next_displacement, b.load, b.force, b.work);
}

template <class Archive>
void visit(Archive& a, PlyContact& pair) {
  PlyPlyContact& c = pair.contact;
  visit(a, c.points, c.faces, c.face_distance, c.list, c.sums, c.renew_depth);
}

template <class Archive>
void visit(Archive& a, PlyEdgeContact& pair) {
  EdgeEdgeContact& c = pair.contact;
  visit(a, c.candidates, c.groups, c.pairs, c.sums, c.renew_depth);
}

template <class Archive>
void visit(Archive& a, PlyPair& pair) {
  visit(a, pair.force_a, pair.force_b, pair.loaded); // all zero unless loaded
  visit(a, pair.rows_a, pair.rows_b);
}

namespace {

template <class Archive>
void visit_state(Archive& a, Scene& s, RunState& run) {
  visit_all(a, s.plies);
  visit_all(a, s.tools);
  visit_all(a, s.boundaries);
  visit_all(a, s.ply_contacts);
  visit_all(a, s.edge_contacts);
  visit_all(a, s.ply_pairs);
  visit_all(a, s.node_sums);
  visit(a, s.time, s.step, s.dt, s.next_dt, s.stable_dt, s.min_dt, s.max_dt, s.bound_displacement,
        s.time_step_gain, s.next_lanczos, s.start_energy, s.mass_damping_work, s.mass_scaling_work,
        s.largest_added_mass, s.group_sums, s.searches);
  Snapshot& good = run.good;
  visit(a, good.plies, good.tool_displacement, good.tool_force, good.tool_filter, good.boundaries,
        good.energy, good.tool_penetration, good.ply_penetration, good.time, good.step);
  Dwell& dwell = run.dwell;
  visit(a, dwell.low, dwell.high, dwell.window_end, dwell.settled);
  visit(a, run.known_forces, run.astray);
  visit(a, run.energy, run.outputs_written, run.elapsed);
}

} // namespace

std::string save_state(Scene& scene, RunState& run) {
  SaveArchive archive;
  visit_state(archive, scene, run);
  return archive.text();
}

void load_state(const std::string& bytes, Scene& scene, RunState& run) {
  const std::vector<PlyArrays> made = arrays_of(scene);
  LoadArchive archive(bytes);
  visit_state(archive, scene, run);
  if (archive.left() > 0) throw std::runtime_error("is longer than its scene");
  check_loaded(scene, run, made);
  for (PlyState& ply : scene.plies)
    ply.tree->refit(ply.x_search); // as the last search left it
}

} // namespace plyform
