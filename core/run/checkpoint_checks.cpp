// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/run/checkpoint_checks.hpp"

#include "base/format.hpp"
#include "contact/shapes/mesh_shape.hpp"
#include "core/model/motion.hpp"
#include "core/solver/step_faults.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string_view>

namespace plyform {
namespace {

void expect(bool fits, std::string_view what) {
  if (!fits) throw std::runtime_error(fmt::format("does not fit its scene: {}", what));
}

bool sound(double x) {
  return std::isfinite(x);
}
bool sound(const Vec3& x) {
  return x.allFinite();
}
bool sound(const ContactRow& row) {
  return sound(row.stiffness) && sound(row.damping); // of shares on an edge, below 0 by rounding
}
bool sound(const ContactHistory& h) {
  return sound(h.s[0]) && sound(h.s[1]) && sound(h.s[2]) && sound(h.damping_force) &&
         sound(h.normal_force) && sound(h.slip);
}
bool sound(const ForceFilter& f) {
  return sound(f.once) && sound(f.twice);
}
bool sound(const ToolMotion& t) {
  return sound(t.displacement) && t.displacement.cwiseAbs().maxCoeff() <= furthest_place &&
         sound(t.motion) && sound(t.force) && sound(t.speed);
}
bool sound(const ToolLoad& t) {
  return sound(t.force) && sound(t.filter) && sound(t.work);
}
bool sound(const Energies& e) {
  return std::all_of(energy_terms.begin(), energy_terms.end(),
                     [&](const EnergyTerm& term) { return sound(e.*term.value); });
}
bool sound(const BoundaryState& b) {
  return sound(b.displacement) && sound(b.next_displacement) && sound(b.load) && sound(b.force) &&
         sound(b.work);
}
template <class T, std::size_t n>
bool sound(const T (&of)[n]) {
  return std::all_of(std::begin(of), std::end(of), [](const T& x) { return sound(x); });
}
auto sound(const auto& lanes) -> decltype(sound(lanes.of)) { // SimdNumbers, SimdYarnStates
  return sound(lanes.of);
}

/// Numbers of which some may be infinite: path lengths before which nothing can touch.
bool known(double x) {
  return !std::isnan(x);
}

bool within(std::int64_t i, std::size_t count) {
  return i >= 0 && static_cast<std::uint64_t>(i) < count;
}

template <class T>
bool all_sound(const std::vector<T>& values) {
  return std::all_of(values.begin(), values.end(), [](const T& value) { return sound(value); });
}

template <class T>
bool all_known(const std::vector<T>& values) {
  return std::all_of(values.begin(), values.end(), [](T value) { return known(double{value}); });
}

bool all_up_to(const std::vector<char>& values, int most) {
  return std::all_of(values.begin(), values.end(),
                     [most](char value) { return value >= 0 && value <= most; });
}

bool near_enough(const std::vector<Vec3>& x) {
  return std::all_of(x.begin(), x.end(), [](const Vec3& p) {
    return p.allFinite() && p.cwiseAbs().maxCoeff() <= furthest_place;
  });
}

/// visit(name, array) for each array of the list.
template <class Visit>
void visit_arrays(const PlyState& ply, const Visit& visit) {
  each_array(const_cast<PlyState&>(ply), [&](const char* name, On place, const auto& values) {
    if constexpr (requires { values.size(); })
      visit(name, values);
    else
      expect(place == On::ply && sound(values), name);
  });
}

ArraySizes sizes_of(const PlyState& ply) {
  ArraySizes sizes;
  visit_arrays(ply, [&](const char*, const auto& values) { sizes.push_back(values.size()); });
  return sizes;
}

void check(const PlyState& p, const ArraySizes& made) {
  std::size_t next = 0;
  visit_arrays(p, [&](const char* name, const auto& values) {
    expect(values.size() == made[next++], fmt::format("the size of {} of a ply", name));
    expect(all_sound(values), fmt::format("a value in {} of a ply", name));
  });
  expect(near_enough(p.x) && near_enough(p.motion), "a node's place");
  expect(near_enough(p.velocity), "a velocity"); // in a second: a step's way is finite then
}

void check(const Scene& s, const PlyBody& ply, const ArraySizes& made) {
  const std::size_t n = ply.x0.size(), m = ply.membrane.triangles.size();
  check(static_cast<const PlyState&>(ply), made);
  expect(ply.x_search.size() == n && near_enough(ply.x_search), "places at the last search");
  expect(ply.max_displacement >= 0.0 && sound(ply.max_displacement) && ply.path_length >= 0.0 &&
             sound(ply.path_length) && ply.fold_motion >= 0.0 && sound(ply.fold_motion),
         "a way of a ply");
  expect(ply.fold_bound.size() == (s.ply_pairs.empty() ? 0 : m) && all_known(ply.fold_bound),
         "bounds of folds");
  const bool edges = !s.ply_pairs.empty();
  expect(ply.ridges.sides.size() == (edges ? ply.edges.all.size() : 0) &&
             all_up_to(ply.ridges.sides, ridge_both),
         "ridges");
  expect(ply.ridges.room.size() == (edges ? ply.edges.patch_edges.size() : 0) &&
             all_known(ply.ridges.room),
         "ridges");
  for (const std::vector<char>& side : ply.occluded)
    expect((side.empty() || side.size() == n) && all_up_to(side, 1), "occluded nodes");
  expect(ply.unfolded.size() == (ply.self_contact ? n : 0) && all_up_to(ply.unfolded, 1),
         "unfolded nodes");
  expect(ply.thickness_ratio.size() == n && sound(ply.thickening) && ply.thickening >= 0.0 &&
             sound(ply.thickening_path) && ply.thickening_path >= 0.0,
         "the thickness of a ply");
  for (const double ratio : ply.thickness_ratio)
    expect(ratio >= thinnest_ratio && ratio <= thickest_ratio, "the thickness of a ply");
  const EigenvalueBound& b = ply.bound;
  expect(sound(b.omega2) && b.omega2 >= 0.0 && sound(b.yarns) && sound(b.soft) &&
             sound(b.damping) && sound(b.viscous) && (b.triangle == -1 || within(b.triangle, m)),
         "the bound of eigenvalues");
  expect(ply.eigenvalue_ratio > 0.0 && ply.eigenvalue_ratio <= 1.0 && sound(ply.lanczos_contacts),
         "the ratio of eigenvalues");
  for (std::size_t i = 0; i < n; ++i)
    expect(ply.mass[i] >= ply.membrane.node_mass[i], "a mass");
}

void check(const ActiveList& list, std::size_t count) {
  expect(list.free_until.size() == count && all_known(list.free_until), "the list of contacts");
  expect(known(list.until) && sound(list.last_path) && sound(list.ahead), "the list of contacts");
  std::int32_t last = -1;
  for (const std::int32_t i : list.active) {
    expect(within(i, count) && i > last, "the list of active contacts");
    last = i;
  }
}

void check(const ContactTotals& sums) {
  expect(sound(sums.elastic) && sound(sums.friction) && sound(sums.damping) &&
             sound(sums.compaction) && sound(sums.vacuum) && sound(sums.penetration) &&
             sound(sums.deepest) && sound(sums.slip) && sums.sliding.finite() &&
             sums.touching >= 0 && sums.step_ratio > 0.0,
         "sums of a contact");
}

/// Greatest depths of contacts, or speeds, one per node of n, whose law asks for them.
void check_remembered(const std::vector<double>& values, std::size_t n) {
  expect(values.empty() || values.size() == n, "what places of contact remember");
  for (const double value : values)
    expect(sound(value) && value >= 0.0, "what places of contact remember");
}

bool fits(const SurfaceHint& hint, std::size_t facets) {
  const auto facet = [&](std::int32_t f) { return f == -1 || within(f, facets); };
  return facet(hint.facet) && facet(hint.nearest) && known(hint.at[0]) && known(hint.at[1]) &&
         known(hint.at[2]) && known(hint.distance) && known(hint.clear) &&
         known(hint.concavity[0]) && known(hint.concavity[1]);
}

void check(const ToolState& tool, const ToolPlyContact& c, std::size_t n) {
  const MeshShapePtr* mesh = std::get_if<MeshShapePtr>(&tool.body.shape);
  const std::size_t facets = mesh ? (*mesh)->surface().triangles.size() : 0;
  std::int32_t last = -1;
  for (const ToolPlyPoint& p : c.points) {
    expect(within(p.node, n) && p.node > last, "nodes near a tool");
    last = p.node;
    expect(sound(p.memory) && known(p.gap) && known(p.last_gap) && sound(p.normal[0]) &&
               sound(p.normal[1]) && sound(p.normal[2]),
           "a contact with a tool");
    expect(fits(p.hint, facets), "a facet of a tool");
  }
  check(c.list, c.points.size());
  const bool never = tool.far && c.points.empty(); // it may not have been searched yet
  expect((c.free.size() == n || (never && c.free.empty())) && all_known(c.free),
         "nodes far from a tool");
  expect(c.hints.size() == (mesh ? n : 0) || (never && c.hints.empty()), "facets of a tool");
  for (const SurfaceHint& hint : c.hints)
    expect(fits(hint, facets), "a facet of a tool");
  expect(c.force.size() == (c.points.empty() ? 0 : n) && all_sound(c.force), "forces of a tool");
  check_remembered(c.compacted, n), check_remembered(c.kept, n);
  check(c.sums);
  expect(known(c.renew_depth), "the depth of a contact");
}

/// `before`: the time at which tools were moved last.
void check(const Scene& s, std::size_t index, double before) {
  const ToolState& t = s.tools[index];
  const ToolBody& body = t.body;
  expect(sound(static_cast<const ToolMotion&>(body)), "the motion of a tool");
  constexpr double rounding = 1e-6; // mm
  if (!body.force_controlled)
    expect((body.displacement -
            motion_at(s.data.tools[index], before, s.data.solver.duration) * body.direction)
                   .norm() <= rounding,
           "the way of a tool at its time");
  expect(sound(static_cast<const ToolLoad&>(t)) && sound(t.displacement_search),
         "forces of a tool");
  expect(t.max_displacement >= 0.0 && sound(t.max_displacement) && t.path_length >= 0.0 &&
             sound(t.path_length) && t.ply_paths.size() == s.plies.size() && all_sound(t.ply_paths),
         "a way of a tool");
  for (std::size_t p = 0; p < s.plies.size(); ++p)
    check(t, t.contacts[p], s.plies[p].x0.size());
}

void check(const Scene& s, const PlyContact& pair) {
  const PlyPlyContact& c = pair.contact;
  const std::size_t nodes = s.plies[static_cast<std::size_t>(pair.slave)].x0.size();
  const std::size_t faces =
      s.plies[static_cast<std::size_t>(pair.master)].membrane.triangles.size();
  expect(c.face_distance.size() == c.faces.size() && all_known(c.face_distance) &&
             std::all_of(c.faces.begin(), c.faces.end(),
                         [faces](std::int32_t f) { return within(f, faces); }),
         "faces near a node");
  std::int32_t last = 0;
  for (const PlyPlyPoint& p : c.points) {
    expect(within(p.node, nodes) && p.node >= last && within(p.face, faces), "nodes near a face");
    last = p.node;
    expect(p.first_face >= 0 && p.first_face < p.end_face &&
               static_cast<std::size_t>(p.end_face) <= c.faces.size(),
           "faces near a node");
    expect(sound(p.memory) && p.area > 0.0 && sound(p.area) && known(p.gap) && sound(p.w[0]) &&
               sound(p.w[1]) && known(p.other) && known(p.gap_when_deactivated) && p.side >= -1 &&
               p.side <= 1 && sound(p.kept) && p.kept >= 0.0,
           "a contact of plies");
  }
  check(c.list, c.points.size());
  check_remembered(c.compacted, nodes);
  check(c.sums);
  expect(known(c.renew_depth), "the depth of a contact");
}

void check_groups(const EdgeEdgeContact& c, const SheetEdges& a, const SheetEdges& b) {
  std::int32_t next = 0;
  for (const EdgeGroup& g : c.groups) {
    expect(g.first == next && g.end > g.first &&
               static_cast<std::size_t>(g.end) <= c.candidates.size() &&
               within(g.patch[0], a.patch_edges.size()) && within(g.patch[1], b.patch_edges.size()),
           "patches of edges");
    expect(sound(g.path_length) && sound(g.ahead) && known(g.free_until), "a way of edges");
    next = g.end;
  }
  expect(static_cast<std::size_t>(next) == c.candidates.size(), "patches of edges");
}

void check(const Scene& s, const PlyEdgeContact& pair) {
  const EdgeEdgeContact& c = pair.contact;
  const PlyBody &a = s.plies[static_cast<std::size_t>(pair.a)],
                &b = s.plies[static_cast<std::size_t>(pair.b)];
  for (const EdgeCandidate& e : c.candidates)
    expect(within(e.edge[0], a.edges.all.size()) && within(e.edge[1], b.edges.all.size()) &&
               known(e.free_until),
           "edges near each other");
  check_groups(c, a.edges, b.edges);
  std::int32_t last = -1;
  for (const EdgePair& p : c.pairs) {
    expect(within(p.candidate, c.candidates.size()) && p.candidate > last, "pairs of edges");
    last = p.candidate;
    const auto& [one, other] = c.candidates[static_cast<std::size_t>(p.candidate)].edge;
    const SheetEdge &of_a = a.edges.all[static_cast<std::size_t>(one)],
                    &of_b = b.edges.all[static_cast<std::size_t>(other)];
    expect(p.a.a == of_a.a && p.a.b == of_a.b && p.b.a == of_b.a && p.b.b == of_b.b,
           "nodes of edges");
    expect(p.side >= -1 && p.side <= 1 && sound(p.area) && p.area >= 0.0 && sound(p.distance) &&
               sound(p.s) && sound(p.t),
           "a contact of edges");
  }
  check(c.sums);
  expect(known(c.renew_depth), "the depth of a contact");
}

void check(const Scene& s, const PlyPair& pair) {
  const std::size_t a = s.plies[static_cast<std::size_t>(pair.a)].x0.size(),
                    b = s.plies[static_cast<std::size_t>(pair.b)].x0.size();
  bool near = pair.loaded || !pair.edges.contact.groups.empty();
  for (const PlyContact& pass : pair.passes)
    near = near || !pass.contact.points.empty();
  const bool none = !near && pair.force_a.empty() && pair.force_b.empty();
  expect(none || (pair.force_a.size() == a && pair.force_b.size() == b), "forces between plies");
  expect(all_sound(pair.force_a) && all_sound(pair.force_b), "a force between plies");
  expect((pair.rows_a.empty() || pair.rows_a.size() == a) &&
             (pair.rows_b.empty() || pair.rows_b.size() == b) && all_sound(pair.rows_a) &&
             all_sound(pair.rows_b),
         "stiffnesses between plies");
}

void check_sums(const SceneProgress& p, const ElementState& elements, std::size_t blocks) {
  expect(p.bound_displacement >= 0.0 && sound(p.bound_displacement) && p.time_step_gain >= 1.0 &&
             sound(p.time_step_gain) && sound(p.start_energy) && sound(p.mass_damping_work) &&
             sound(p.mass_scaling_work) && p.largest_added_mass >= 0.0 &&
             sound(p.largest_added_mass),
         "sums of the run");
  for (const std::vector<double>* sums :
       {&elements.group_sums, &elements.torn_sums, &elements.flowed_sums})
    expect(sums->size() == blocks && all_sound(*sums), "sums of the elements");
}

void check_progress(const Scene& s) {
  const SolverOptions& solver = s.data.solver;
  expect(s.step > 0 && s.searches > 0 && s.searches <= s.step + 1 && s.next_lanczos >= 0,
         "the number of steps");
  expect(s.dt > 0.0 && sound(s.dt) && s.next_dt > 0.0 && sound(s.next_dt) && s.stable_dt > 0.0 &&
             sound(s.stable_dt) && s.min_dt > 0.0 && s.min_dt <= s.max_dt && sound(s.max_dt) &&
             s.dt >= s.min_dt && s.dt <= s.max_dt,
         "the time step");
  const double steps = static_cast<double>(s.step), rounding = 1e-6;
  expect(s.time >= std::max(s.dt, steps * s.min_dt) * (1.0 - rounding) &&
             s.time <= steps * s.max_dt * (1.0 + rounding) &&
             s.time <= solver.duration * (1.0 + solver.dwell) + 2.0 * s.max_dt,
         "the time");
  for (const double until : {s.cooled_until, s.tightened_until})
    expect(until >= 0.0 && until <= s.time, "the time of what follows it");
  check_sums(s, s, s.group_blocks.size());
  for (const NodeSums& n : s.node_sums)
    expect(sound(n.damping) && sound(n.moved2) && sound(n.step2), "sums of the nodes");
}

void check(const Scene& s, const Snapshot& good, const std::vector<ArraySizes>& made) {
  const SceneProgress& then = good.progress;
  expect(then.time >= 0.0 && then.time <= s.time && then.step >= 0 && then.step <= s.step &&
             sound(good.energy) && sound(good.tool_penetration) && sound(good.ply_penetration),
         "the last good state");
  if (good.plies.empty() && good.boundaries.empty() && good.tool_motions.empty() &&
      good.tool_loads.empty())
    return; // none was kept yet
  expect(good.plies.size() == s.plies.size() && good.boundaries.size() == s.boundaries.size() &&
             good.tool_motions.size() == s.tools.size() && good.tool_loads.size() == s.tools.size(),
         "the last good state");
  check_sums(then, good.elements, s.group_blocks.size());
  for (std::size_t p = 0; p < good.plies.size(); ++p)
    check(good.plies[p], made[p]);
  expect(all_sound(good.boundaries) && all_sound(good.tool_motions) && all_sound(good.tool_loads),
         "the last good state");
}

void check(const Scene& s, const RunState& run, const std::vector<ArraySizes>& made) {
  check(s, run.good, made);
  const Dwell& dwell = run.dwell;
  const auto each_tool = [&](const std::vector<double>& values) {
    return values.empty() || values.size() == s.tools.size();
  };
  expect(each_tool(dwell.low) && dwell.low.size() == dwell.high.size() && all_sound(dwell.low) &&
             all_sound(dwell.high) && sound(dwell.window_end) && sound(dwell.next_look) &&
             sound(dwell.low_work) && sound(dwell.high_work),
         "the dwell");
  expect(sound(run.energy) && finite_of_each(run.packing, s.plies.size()) &&
             run.outputs_written >= -1 && run.outputs_written < s.data.solver.outputs &&
             run.elapsed >= 0.0 && sound(run.elapsed),
         "the progress of the run");
}

} // namespace

std::vector<ArraySizes> sizes_of(const Scene& s) {
  std::vector<ArraySizes> sizes;
  for (const PlyBody& ply : s.plies)
    sizes.push_back(sizes_of(static_cast<const PlyState&>(ply)));
  return sizes;
}

void check_loaded(const Scene& s, const RunState& run, const std::vector<ArraySizes>& made) {
  check_progress(s);
  for (std::size_t p = 0; p < s.plies.size(); ++p)
    check(s, s.plies[p], made[p]);
  for (std::size_t t = 0; t < s.tools.size(); ++t)
    check(s, t, s.time - s.dt);
  expect(all_sound(s.boundaries), "a boundary");
  for (const PlyPair& pair : s.ply_pairs) {
    for (const PlyContact& pass : pair.passes)
      check(s, pass);
    check(s, pair.edges);
    check(s, pair);
  }
  check(s, run, made);
}

} // namespace plyform
