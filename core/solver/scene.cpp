// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solver/scene.hpp"

#include "base/thread_pool.hpp"
#include "contact/search/unfolded.hpp"
#include "core/mesh/mesh_ply.hpp"
#include "core/model/boundary.hpp"
#include "core/model/mirror.hpp"
#include "core/model/motion.hpp"
#include "core/model/reach_ahead.hpp"
#include "core/model/reachable_temperature.hpp"
#include "core/solver/element_mass_scaling.hpp"
#include "core/solver/make_contacts.hpp"
#include "core/solver/vacuum_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plyform {
namespace {

void add_blocks(std::vector<Block>& blocks, int ply, std::size_t count, int size = node_block) {
  const int n = static_cast<int>(count);
  for (int begin = 0; begin < n; begin += size)
    blocks.push_back({ply, begin, std::min(n, begin + size), 0.0});
}

/// Per triangle whether it has a node on the ply's boundary edge.
std::vector<char> faces_on_rim(std::span<const SheetEdge> edges,
                               std::span<const Triangle> triangles, std::size_t nodes) {
  std::vector<char> node(nodes, 0), face;
  for (const SheetEdge& e : edges)
    if (e.is_free()) node[e.a] = node[e.b] = 1;
  for (const Triangle& t : triangles)
    face.push_back(
        static_cast<char>(std::any_of(t.begin(), t.end(), [&](int n) { return node[n] != 0; })));
  return face;
}

/// Sets the bound of a ply's frequency at the start and the viscosity of yarns that follows from
/// it.
void set_frequency(const Case& data, PlyBody& body) {
  body.bound = eigenvalue_bound(body.membrane, body.x);
  const double omega = std::sqrt(body.bound.omega2);
  // eta = 2 xi C / omega: fraction xi of critical for the stiffest mode of the mesh
  for (MembraneFamily& family : body.membrane.families)
    if (!family.stitch)
      family.viscosity = 2.0 * data.solver.fibre_damping * family.yarn.largest_slope() / omega;
  body.bound = eigenvalue_bound(body.membrane, body.x); // with viscosity
}

/// Sets how stiff crossings may become by their temperature: of all plies of the fabric, which
/// share what follows from it.
void set_stiffest(const Case& data, int fabric, Membrane& membrane) {
  const TemperatureFactor& factor = data.fabrics[fabric].shear_over_temperature;
  if (!factor.depends()) return;
  double stiffest = 0.0;
  for (const Ply& ply : data.plies)
    if (const auto range = reachable_temperatures(data, ply); range && ply.fabric == fabric)
      stiffest = std::max(stiffest, factor.extremes(*range).second);
  for (MembraneCrossing& crossing : membrane.crossings)
    if (stiffest > 0.0) crossing.stiffest = stiffest;
}

/// Temperatures at the start, and room for what follows them: core/solver/follow_temperature.hpp.
void set_temperature(const Case& data, const Ply& ply, PlyBody& body) {
  const std::optional<double> temperature = start_temperature(data, ply);
  if (!temperature) return;
  body.temperature.assign(body.x.size(), *temperature);
  const Fabric& fabric = data.fabrics[ply.fabric];
  const SimdNumbers one{{1.0, 1.0, 1.0, 1.0}};
  if (fabric.shear_over_temperature.depends() && body.simd)
    body.shear_factors.assign(body.simd->triangles->size(), one);
  if (!fabric.flow.depends()) return;
  if (has_rates_of_yarns(fabric)) body.time_factors.assign(at(body.simd->packs), one);
  if (body.viscous) body.flow_factors.assign(body.simd->triangles->size(), one);
  if (body.viscous_bending) body.node_flow_factors.assign(body.bending->stencils.size(), one);
}

/// The bending of a ply, and what it keeps of laws with rates. alike: as of make_ply.
void set_bending(const Ply& ply, const BlankMesh& mesh, const PlyBody* alike, PlyBody& body) {
  const BendingLaw law = bending_law(body.membrane.fabric);
  if (!law.any() && !has_viscosity(law)) return;
  if (alike) {
    body.bending = alike->bending, body.viscous_bending = alike->viscous_bending;
  } else {
    const MaterialAxes axes = material_axes(body.membrane.fabric);
    Bending bending = make_bending(mesh.x, body.membrane.triangles, law, ply.angle + axes.first,
                                   ply.angle + axes.second, body.membrane.node_mass, body.planes);
    body.bending = make_bending_simd(bending, body.x0);
    body.viscous_bending =
        make_viscous_bending(std::move(bending), body.membrane.node_mass, body.bound.yarns);
  }
  if (!body.viscous_bending) return;
  body.bending_states.assign(body.bending->stencils.size() * body.viscous_bending->states(), {});
  body.bending_end = body.bending_states;
}

/// The nodes on each of these planes. x0: mm.
std::vector<NodesOnPlane> nodes_on(const std::vector<SymmetryPlane>& planes,
                                   std::span<const Vec3> x0) {
  std::vector<NodesOnPlane> found;
  for (const SymmetryPlane& plane : planes) {
    NodesOnPlane& on = found.emplace_back(NodesOnPlane{normal_of(plane), {}});
    for (std::size_t n = 0; n < x0.size(); ++n)
      if (lies_on(plane, x0[n].head<2>())) on.nodes.push_back(static_cast<std::int32_t>(n));
  }
  return found;
}

/// alike: a ply of the same fabric, angle, mesh and planes of symmetry, or null.
PlyBody make_ply(const Case& data, const Ply& ply, const BlankMesh& mesh, const PlyBody* alike) {
  PlyBody body;
  const auto number = static_cast<int>(&ply - data.plies.data());
  body.planes = planes_of(data.boundaries, number);
  const Fabric& fabric = data.fabrics[ply.fabric];
  body.name = ply.name;
  body.angle = ply.angle;
  body.thickness = fabric.thickness;
  body.membrane =
      make_membrane(mesh, fabric, ply.angle, data.solver.element, data.solver.fibre_softening);
  set_stiffest(data, ply.fabric, body.membrane);
  body.membrane.process_time = data.process_time();
  body.viscous = make_viscous(body.membrane, data.process_stroke_time());
  body.x0.reserve(mesh.x.size());
  for (const Vec2& p : mesh.x)
    body.x0.emplace_back(p.x(), p.y(), ply.z);
  body.x = body.x_search = body.x0;
  body.velocity.assign(body.x.size(), Vec3::Zero());
  body.motion = body.velocity;
  if (fits_simd(body.membrane)) {
    body.simd = make_membrane_simd(body.membrane, body.x);
  } else {
    body.q.resize(mesh.triangles.size());
  }
  body.on_planes = nodes_on(body.planes, body.x0);
  body.edges = sheet_edges(body.membrane.triangles, body.x0, body.on_planes);
  body.touches_boundary_edge = faces_on_rim(body.edges.all, body.membrane.triangles, body.x.size());
  body.tree = std::make_unique<SheetTree>(body.x, body.membrane.triangles);
  set_frequency(data, body);
  set_bending(ply, mesh, alike, body);
  if (body.viscous) { // it has yarns, and so a kernel
    body.viscous_states.assign(body.simd->triangles->size() * body.viscous->states, {});
    body.viscous_end = body.viscous_states;
  }
  if (body.simd) body.yarns = body.yarns_end = states_at_start(*body.simd, body.membrane);
  body.mass = body.membrane.node_mass;
  body.thickness_law = thickness_law(fabric);
  body.thickness_acts = fabric.compaction.has_value();
  body.thickness_ratio.assign(body.x.size(), 1.0);
  body.last_ratio = body.thickness_ratio;
  set_temperature(data, ply, body);
  return body;
}

// Gap up to which open contacts count in the bound of the stable step (SceneModel::bound_margin),
// over the thickness of the thinnest ply: 0.5 mm for 0.6 mm.
constexpr double margin_in_thicknesses = 1.0 / 1.2;

/// PlyContacts::pass_order.
std::vector<PassPlace> order_of_passes(const std::vector<PlyPair>& pairs) {
  std::vector<PassPlace> order;
  for (std::size_t i = 0; i < pairs.size(); ++i)
    for (std::size_t k = 0; k < pairs[i].passes.size(); ++k)
      order.push_back({static_cast<int>(i), static_cast<int>(k)});
  const auto key = [&](const PassPlace& place) {
    const PlyContact& c = pairs[at(place.pair)].passes[at(place.pass)];
    return std::array<int, 3>{c.slave == c.master ? 1 : 0, c.slave, c.master};
  };
  std::sort(order.begin(), order.end(),
            [&](const PassPlace& one, const PassPlace& other) { return key(one) < key(other); });
  return order;
}

/// Sets what follows from which bodies may meet.
void set_reach(const Case& data, std::vector<PlyBody>& plies) {
  const ReachAhead ahead = reach_ahead(data);
  const bool any_moves =
      std::find(ahead.ply_moves.begin(), ahead.ply_moves.end(), 1) != ahead.ply_moves.end();
  for (std::size_t p = 0; p < plies.size(); ++p) {
    PlyBody& ply = plies[p];
    ply.stack = ahead.stack[p];
    ply.stacked = ahead.plies_in_stack(p) > 1;
    ply.left_alone = any_moves && !ahead.ply_moves[p] && !has_pretension(ply.membrane.fabric);
    ply.self_contact = data.contact.self == SelfContact::on ||
                       (data.contact.self == SelfContact::automatic && ply.stacked);
    ply.convex = ply.self_contact && is_convex(ply.x0, ply.membrane.triangles);
  }
}

/// Sets the lengths that the smallest element and the thinnest ply decide, of those that move.
void set_lengths(Scene& s) {
  double element = std::numeric_limits<double>::max(), thickness = element;
  for (const PlyBody& ply : s.plies) {
    if (ply.left_alone) continue;
    element = std::min(element, element_size(ply));
    thickness = std::min(thickness, ply.thickness);
  }
  s.element_size = element;
  // A small skin makes searches frequent, a large one increases the number of points and faces
  // within reach (with its square): with a third of an element both costs are small.
  s.skin = s.data.contact.skin > 0.0 ? s.data.contact.skin : 0.3 * element;
  s.skin = std::max(s.skin, 2.0 * s.sliding_gap);
  s.bound_margin = margin_in_thicknesses * thickness;
}

/// Sets what contacts with films need, and heat from ply to ply.
void set_films(Scene& s) {
  const bool cools = s.data.process.cooling.has_value();
  for (const ToolState& tool : s.tools)
    for (const ToolPlyContact& contact : tool.contacts)
      s.sliding_gap = std::max(s.sliding_gap, contact.law.sliding_gap);
  for (const PlyPair& pair : s.ply_pairs)
    for (const PlyContact& pass : pair.passes) {
      s.sliding_gap = std::max(s.sliding_gap, pass.contact.law.sliding_gap);
      PlyBody& master = s.plies[at(pass.master)];
      if ((pass.contact.law.has_film() || cools) && master.rim_distance.empty())
        master.rim_distance = rim_distances(master.edges, master.x0);
    }
}

/// Springs and grippers, and the arrays that their forces need.
void make_attachments(Scene& s) {
  std::vector<SheetBefore> sheets;
  for (const PlyBody& ply : s.plies)
    sheets.push_back({ply.x0, ply.membrane.triangles});
  for (std::size_t b = 0; b < s.data.boundaries.size(); ++b) {
    if (prescribes(s.data.boundaries[b])) continue;
    Attachment attachment = attach(s.data.boundaries, b, sheets);
    if (attachment.nodes.empty()) continue; // of a part: it holds an image
    s.attachments.push_back(std::move(attachment));
    const bool spring = s.data.boundaries[b].is<TensionSpring>();
    for (const AttachedNode& node : s.attachments.back().nodes) {
      PlyBody& ply = s.plies[node.ply];
      (spring ? ply.pull : ply.reaction).resize(ply.x0.size(), Vec3::Zero());
    }
  }
}

/// Whether ply p on this mesh is of the same fabric, angle, mesh and planes of symmetry as ply q,
/// which has been made.
bool is_alike(const Case& data, std::size_t p, const BlankMesh& mesh, std::size_t q,
              const PlyBody& made) {
  const Ply &ply = data.plies[p], &other = data.plies[q];
  return ply.fabric == other.fabric && ply.angle == other.angle &&
         planes_of(data.boundaries, static_cast<int>(p)) ==
             planes_of(data.boundaries, static_cast<int>(q)) &&
         mesh.triangles == made.membrane.triangles && mesh.x.size() == made.x0.size() &&
         std::equal(mesh.x.begin(), mesh.x.end(), made.x0.begin(),
                    [](const Vec2& before, const Vec3& x) { return before == x.head<2>(); });
}

/// Lets a ply hold the constants of its kernels in common with those laid before it.
void share_constants(std::vector<PlyBody>& plies, std::size_t p) {
  PlyBody& ply = plies[p];
  for (std::size_t i = 0; i < p; ++i) {
    const PlyBody& other = plies[i];
    if (ply.simd && other.simd) share(ply.simd->triangles, other.simd->triangles);
    if (ply.bending && other.bending) share(ply.bending->constants, other.bending->constants);
  }
}

/// The fold from which on an edge may touch another. Over a side L of a triangle a fold f brings
/// two sheets closer by L f / 4, here by 3/8 of the contact distance h; nodes and faces keep three
/// quarters of it, so that 3/8 are left, of which edges use the half beyond h/4.
void limit_ridges(Scene& s) {
  for (PlyBody& ply : s.plies) {
    double longest = 0.0;
    for (const PlyBody& other : s.plies)
      if (other.stack == ply.stack) longest = std::max(longest, longest_side(other.edges, other.x));
    ply.ridge_limit = 1.5 * ply.thickness / longest;
  }
}

/// Makes as many plies at a time as there are threads, so that few hold constants of their own that
/// they will share.
std::vector<PlyBody> make_plies(const Case& data, const std::vector<BlankMesh>& meshes,
                                int threads) {
  std::vector<PlyBody> plies(data.plies.size());
  ThreadPool pool(threads);
  for (std::size_t first = 0; first < plies.size(); first += static_cast<std::size_t>(threads)) {
    const std::size_t end = std::min(plies.size(), first + static_cast<std::size_t>(threads));
    pool.run(static_cast<int>(end - first), [&](int i) {
      const std::size_t p = first + static_cast<std::size_t>(i);
      const Ply& ply = data.plies[p];
      const BlankMesh mesh = meshes.empty() ? mesh_ply(data, ply) : meshes[p];
      const PlyBody* alike = nullptr;
      for (std::size_t q = 0; q < first && !alike; ++q)
        if (is_alike(data, p, mesh, q, plies[q])) alike = &plies[q];
      plies[p] = make_ply(data, ply, mesh, alike);
    });
    for (std::size_t p = first; p < end; ++p)
      share_constants(plies, p);
  }
  return plies;
}

} // namespace

namespace {

double energy_floor_of(const std::vector<PlyBody>& plies) {
  constexpr double strain = 1e-7; // a millionth of what forms cloth, a billion roundings
  double floor = 0.0;
  for (const PlyBody& ply : plies) {
    const Membrane& m = ply.membrane;
    double stiffness = 0.0; // N/mm
    for (const MembraneFamily& family : m.families)
      stiffness += family.density * family.yarn.largest_slope();
    if (m.fabric.sheet)
      stiffness +=
          std::visit([](const auto& law) { return law.plane_stiffness(); }, *m.fabric.sheet);
    for (const double area : m.node_area)
      floor += 0.5 * stiffness * strain * strain * area;
  }
  return floor;
}

} // namespace

Scene make_scene(const Case& data, const std::vector<BlankMesh>& meshes, int threads) {
  Scene s;
  s.data = data;
  s.plies = make_plies(data, meshes, threads);
  set_reach(data, s.plies);
  if (data.solver.element_mass_scaling > 0.0) {
    scale_element_masses(data, s.plies);
    for (PlyBody& ply : s.plies)
      if (!ply.membrane.density_factor.empty()) set_frequency(data, ply);
  }
  for (std::size_t t = 0; t < data.tools.size(); ++t)
    s.tools.push_back(make_tool(data, t, s.plies));
  s.energy_floor = energy_floor_of(s.plies);
  s.any_thickness_acts = std::any_of(s.plies.begin(), s.plies.end(),
                                     [](const PlyBody& ply) { return ply.thickness_acts; });
  const int n = static_cast<int>(s.plies.size());
  s.ply_pairs = make_pairs(data, s.plies);
  s.pass_order = order_of_passes(s.ply_pairs);
  s.plies_meet = !s.ply_pairs.empty();
  note_vacuum_stiffness(s.ply_pairs, s.plies);
  set_films(s);
  set_lengths(s);
  limit_ridges(s);
  for (int p = 0; p < n; ++p) {
    const PlyBody& ply = s.plies[p];
    if (ply.simd)
      add_blocks(s.group_blocks, p, ply.simd->blocks.size(), 1);
    else
      add_blocks(s.group_blocks, p, static_cast<std::size_t>(ply.membrane.groups()));
    add_blocks(s.node_blocks, p, ply.x.size());
    if (ply.bending) add_blocks(s.bending_blocks, p, ply.bending->blocks.size(), 1);
  }
  for (int p = 0; p < n; ++p) {
    PlyBody& ply = s.plies[p];
    const std::vector<PrescribedNode> held = prescribed_nodes(data.boundaries, p, ply.x0);
    if (!held.empty()) ply.reaction.assign(ply.x0.size(), Vec3::Zero());
    s.held.insert(s.held.end(), held.begin(), held.end());
  }
  make_attachments(s);
  s.boundaries.resize(data.boundaries.size());
  s.group_sums.assign(s.group_blocks.size(), 0.0);
  s.group_lost = s.torn_sums = s.group_torn = s.flowed_sums = s.group_flowed = s.group_sums;
  s.group_collapsed.assign(s.group_blocks.size(), 0);
  s.node_sums.assign(s.node_blocks.size(), {});
  return s;
}

} // namespace plyform
