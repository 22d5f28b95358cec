// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solver/make_contacts.hpp"

#include "core/model/motion.hpp"
#include "core/solver/vacuum_contact.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

/// Penalty stiffness per area, N/mm^3, with which omega^2 of a free node in contact is `fraction`
/// of that of the elements. The latter falls with the square of the element size, while penetration
/// should not grow on a coarse mesh: therefore the penalty is at least that for elements of 12.5
/// thicknesses, but increased by a factor of 2.5 at most, beyond which crossed plies chatter over a
/// fillet (docs/verification/contact.md).
///
/// In a stack the penalty falls with the stiffness of softened yarns only down to a softening of
/// 100 (`stack_softening`), as the pressure between plies does not decrease with softening.
double penalty_per_area(const PlyBody& ply, double fraction, bool stack) {
  constexpr double fine = 12.5, most = 2.5, stack_softening = 100.0;
  double softening = 1.0;
  for (const MembraneFamily& family : ply.membrane.families)
    if (stack) softening = std::max(softening, family.softening / stack_softening);
  fraction *= softening;
  const double coarse = cell_area(ply) / (fine * fine * ply.thickness * ply.thickness);
  return std::clamp(coarse, 1.0, most) * fraction * ply.membrane.fabric.surface_density *
         ply.bound.omega2;
}

// Depth limits of contact over a ply's thickness. Between plies a quarter, with which edge-edge
// contact begins before edges can cross (contact/forces/edge_edge.hpp). In tools a sixth: 0.1 mm
// for a ply of 0.6 mm.
constexpr double deepest_in_ply = 0.25, deepest_in_tool = 1.0 / 6.0, deepest_of_edges = 0.25;

/// N/mm^2, the largest that pressures can press plies onto each other or onto a tool with.
double largest_pressure(const Case& data) {
  double most = 0.0;
  for (std::size_t p = 0; p < data.plies.size(); ++p)
    most = std::max(most, largest_pressure_on(data, p));
  return most;
}

/// The penalty, or what bears the pressures of a case with half of the depth limit: vacuum on soft
/// rubber would else leave contact no room. share: of the contact's stiffness.
double bearing(const Case& data, double penalty, double share, double max_depth) {
  constexpr double half = 0.5, room = 1.0 - half * half;
  return std::max(penalty, share * largest_pressure(data) * room * room / (half * max_depth));
}

ContactLaw make_law(const ContactOptions& options, double penalty, double density, double mu,
                    double max_depth) {
  // c = 2 zeta sqrt(k rho): fraction zeta of critical for a node against a wall
  return {penalty, 2.0 * options.damping * std::sqrt(penalty * density), mu, max_depth};
}

/// Gives a contact of these bodies the law of friction that the case names for them. A law with one
/// coefficient alone is that of the kernels.
/// distance: mm, of the two mid-surfaces, or of one
/// from a tool.
void rub(const Case& data, int a, int b, double distance, ContactLaw& law) {
  constexpr double thickest = 0.5; // film that fills an opened gap, over that distance
  const int number = data.friction.law_of(a, b);
  if (number < 0) return;
  const FrictionLawPtr& named = data.friction_laws[static_cast<std::size_t>(number)];
  const bool plain = named->spec().plain();
  law.friction = plain ? named->spec().coefficient : 0.0;
  if (plain) return;
  law.sliding = named;
  law.process_time = data.process_time();
  law.memory = memory_share * data.solver.duration * law.process_time;
  law.sliding_gap = std::min(named->spec().film_thickness(), thickest * distance);
}

/// ContactLaw::thickness_coupling: thickness over element size, squared. A contact at a node has
/// gradients of 1 at it and of half the thickness by 0.29 / element size at each of six around it,
/// and each node is in six such: K = k G G^T of all contacts is at most k (1 + 0.76 (t/e)^2).
double coupling_of(const PlyBody& ply) {
  return ply.thickness * ply.thickness / cell_area(ply);
}

/// Gives a contact the curves of the plies in it, one on a tool or two in series; that beyond which
/// nothing gives way has its depth limit scaled to what is left of the distance then. share: of the
/// law's stiffness, in which it also bears the curve (two passes share a contact).
void give_way(ContactLaw& law, double share, std::initializer_list<const PlyBody*> plies) {
  std::vector<HalfCompaction> loading, unloading;
  bool any_unloading = false;
  double distance = 0.0; // mm, before anything presses
  for (const PlyBody* ply : plies) {
    distance += 0.5 * ply->thickness;
    const auto& c = ply->membrane.fabric.compaction;
    if (!c) continue;
    loading.push_back(half_of(c->loading));
    const bool set = !c->unloading.thickness.empty();
    any_unloading = any_unloading || set;
    unloading.push_back(set ? half_of(c->unloading) : loading.back());
  }
  if (loading.empty()) return;
  for (std::vector<HalfCompaction>* halves : {&loading, &unloading})
    for (HalfCompaction& half : *halves)
      for (double& p : half.pressure)
        p *= share;
  const auto other = [](const std::vector<HalfCompaction>& halves) {
    return halves.size() > 1 ? &halves[1] : nullptr;
  };
  law.loading = std::make_shared<CompactionCurve>(&loading[0], other(loading));
  if (any_unloading)
    law.unloading = std::make_shared<CompactionCurve>(&unloading[0], other(unloading),
                                                      law.loading->last_pressure());
  law.max_depth *= (distance - law.packed()) / distance;
  // damped as fast as the curve is stiff on the whole, not as the penalty beyond it
  const double mean = law.loading->last_pressure() / law.packed();
  law.damping *= std::min(1.0, std::sqrt(mean / law.stiffness));
}

/// mm by which two plies on each other are thinner than apart: the mean of what both say.
double nesting_of(const PlyBody& a, const PlyBody& b) {
  const auto of = [](const PlyBody& ply) {
    const auto& c = ply.membrane.fabric.compaction;
    return c ? c->nesting : 0.0;
  };
  return 0.5 * (of(a) + of(b));
}

PlyContact make_pass(const Case& data, const std::vector<PlyBody>& plies, int a, int b) {
  const PlyBody& slave = plies[a];
  const PlyBody& master = plies[b];
  PlyContact pair;
  pair.slave = a;
  pair.master = b;
  const double penalty = 0.5 * std::min(penalty_per_area(slave, data.contact.stiffness, true),
                                        penalty_per_area(master, data.contact.stiffness, true));
  const double density =
      0.5 * std::min(slave.membrane.fabric.surface_density, master.membrane.fabric.surface_density);
  pair.contact.distance = 0.5 * (slave.thickness + master.thickness);
  pair.contact.slave_share = slave.thickness / (slave.thickness + master.thickness);
  const double deepest = deepest_in_ply * pair.contact.distance;
  pair.contact.law = make_law(data.contact, bearing(data, penalty, 0.5, deepest), density,
                              data.friction(a, b), deepest);
  rub(data, a, b, pair.contact.distance, pair.contact.law);
  pair.contact.law.share = 0.5;
  pair.contact.thickness_follows = slave.thickness_acts || master.thickness_acts;
  pair.contact.distance -= nesting_of(slave, master);
  give_way(pair.contact.law, 0.5, {&slave, &master});
  if (!pair.contact.law.loading) { // what gives way is as thick as pressure lets it
    pair.contact.vacuum_gap = 0.5 * largest_vacuum(data, a, b) / pair.contact.law.stiffness;
    pair.contact.law.sliding_gap =
        std::max(pair.contact.law.sliding_gap, 2.0 * pair.contact.vacuum_gap);
  }
  if (pair.contact.thickness_follows)
    pair.contact.law.thickness_coupling = std::max(coupling_of(slave), coupling_of(master));
  return pair;
}

/// mm, at which edges of two plies meet: two thirds of what nodes and faces keep apart at least.
double edge_distance(const PlyPlyContact& contact) {
  if (!contact.law.loading) return 0.5 * contact.distance;
  return (contact.distance - contact.law.depth_limit()) / 1.5;
}

} // namespace

HalfCompaction half_of(const ThicknessCurve& curve) {
  HalfCompaction half;
  for (std::size_t i = 0; i < curve.thickness.size(); ++i) {
    half.depth.push_back(0.5 * (curve.thickness.front() - curve.thickness[i]));
    half.pressure.push_back(curve.pressure[i]);
  }
  return half;
}

ToolState make_tool(const Case& data, std::size_t index, const std::vector<PlyBody>& plies) {
  const Tool& tool = data.tools[index];
  ToolState t;
  t.name = tool.name;
  t.body.shape = tool.shape;
  t.body.position = tool.position;
  t.body.rotation = tool.rotation;
  t.body.direction = tool.direction;
  t.body.force_controlled = tool.motion == Motion::force;
  t.force_on = tool.force;
  t.body.mass = tool.mass;
  t.body.max_approach_speed = closing_speed;
  for (std::size_t p = 0; p < plies.size(); ++p) {
    ToolPlyContact c;
    const int body = static_cast<int>(plies.size() + index);
    const double deepest = deepest_in_tool * plies[p].thickness;
    const double penalty = penalty_per_area(plies[p], data.contact.stiffness, plies[p].stacked);
    c.law = make_law(data.contact, bearing(data, penalty, 1.0, deepest),
                     plies[p].membrane.fabric.surface_density,
                     data.friction(static_cast<int>(p), body), deepest);
    c.half_thickness = 0.5 * plies[p].thickness;
    if (!data.tool_clearance.empty()) c.half_thickness += data.tool_clearance[index];
    rub(data, static_cast<int>(p), body, c.half_thickness, c.law);
    c.thickness_follows = plies[p].thickness_acts;
    give_way(c.law, 1.0, {&plies[p]});
    if (c.thickness_follows) c.law.thickness_coupling = coupling_of(plies[p]);
    t.contacts.push_back(std::move(c));
  }
  t.ply_paths.assign(plies.size(), 0.0);
  return t;
}

std::vector<PlyPair> make_pairs(const Case& data, const std::vector<PlyBody>& plies) {
  std::vector<PlyPair> pairs;
  const int n = static_cast<int>(plies.size());
  for (int apart = 1; apart <= n; ++apart)
    for (int a = 0; a < n; ++a) {
      const int b = a + apart % n;
      if (b >= n || (a == b && !plies[at(a)].self_contact)) continue;
      PlyPair pair;
      pair.a = a, pair.b = b;
      pair.passes.push_back(make_pass(data, plies, a, b));
      if (a != b) pair.passes.push_back(make_pass(data, plies, b, a));
      const PlyPlyContact& contact = pair.passes[0].contact;
      pair.edges.a = a, pair.edges.b = b;
      pair.edges.contact.law = contact.law;
      pair.edges.contact.law.sliding_gap = 0.0;
      pair.edges.contact.law.loading = pair.edges.contact.law.unloading = nullptr;
      pair.edges.contact.distance = edge_distance(contact);
      pair.edges.contact.law.max_depth = deepest_of_edges / 0.5 * pair.edges.contact.distance;
      pairs.push_back(std::move(pair));
    }
  return pairs;
}

} // namespace plyform
