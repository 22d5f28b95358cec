// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/run/output_state.hpp"

#include "core/model/motion.hpp"
#include "core/results/wrinkles.hpp"
#include "core/run/bridging.hpp"
#include "core/run/closed_gap.hpp"
#include "core/run/present_thickness.hpp"
#include "core/solver/follow_temperature.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plyform {
namespace {

/// 30 for 29.999999999999996.
double in_degrees(double angle) {
  return std::round(angle * degrees_per_radian * 1e9) / 1e9;
}

/// Normal contact forces on the nodes of one ply, N, on its upper and lower side separately.
struct SideForces {
  std::vector<Vec3> normals;
  std::vector<double> above, below;
  void add(int node, const Vec3& direction, double force) {
    const auto n = static_cast<std::size_t>(node);
    // a downward force acts on the upper side
    (direction.dot(normals[n]) < 0.0 ? above : below)[n] += force;
  }
};

/// Directions, strains and tensions of the families; of a foil its axes, which files call warp and
/// weft. strains: of all families of the membrane.
std::vector<FamilyFrame> family_frames(const PlyBody& ply,
                                       std::vector<std::vector<double>>& strains) {
  const Membrane& m = ply.membrane;
  std::vector<FamilyFrame> frames;
  for (const YarnFamily& family : m.fabric.families)
    frames.push_back({family.name, in_degrees(ply.angle + family.angle), {}, {}, {}});
  if (m.families.empty()) {
    const std::vector<double> none(m.triangles.size(), 0.0);
    for (const YarnFamily& axis : woven_fabric().families)
      frames.push_back({axis.name, in_degrees(ply.angle + axis.angle), {}, {}, none});
    return frames;
  }
  std::vector<YarnMemory> memory;
  if (has_rates_of_yarns(m.fabric)) memory = memory_of(*ply.simd, m, ply.yarns);
  std::vector<std::vector<double>> tensions = yarn_tensions(m, ply.x, memory);
  for (std::size_t a = 0; a < frames.size(); ++a) {
    frames[a].strain = std::move(strains[a]);
    frames[a].tension = std::move(tensions[a]);
  }
  return frames;
}

/// The distance between yarns across them is the area over the length along them, as the strain of
/// a group's mean. area_ratios: now over before forming, of triangles.
void add_openings(const Membrane& m, const std::vector<double>& area_ratios, PlyFrame& f) {
  for (std::size_t a = 0; a < m.fabric.families.size(); ++a)
    if (shows_opening(m.fabric, a)) f.families[a].opening.resize(area_ratios.size());
  for (std::size_t p = 1; p < m.group_begin.size(); ++p) {
    double now = 0.0, before = 0.0;
    const auto begin = at(m.group_begin[p - 1]), end = at(m.group_begin[p]);
    for (std::size_t e = begin; e < end; ++e)
      now += m.area[e] * area_ratios[e], before += m.area[e];
    for (FamilyFrame& family : f.families)
      for (std::size_t e = begin; e < end && !family.opening.empty(); ++e)
        family.opening[e] = now / before / (1.0 + family.strain[e]) - 1.0;
  }
}

/// Directions, strains and forces of the stitches, and where they are broken. strains: of all
/// families of the membrane. What breaks in the step that led here is broken.
std::vector<StitchFrame> stitch_frames(const PlyBody& ply,
                                       std::vector<std::vector<double>>& strains) {
  const Membrane& m = ply.membrane;
  std::vector<StitchFrame> frames;
  for (std::size_t i = 0; i < m.fabric.stitches.size(); ++i) {
    const Stitch& stitch = m.fabric.stitches[i];
    const std::size_t family = m.fabric.families.size() + i;
    StitchFrame& frame = frames.emplace_back();
    frame.name = stitch.name, frame.angle_deg = in_degrees(ply.angle + stitch.angle);
    frame.strain = std::move(strains[family]);
    frame.broken = remembered_of(*ply.simd, m, ply.yarns, family, 0);
    for (std::size_t e = 0; e < m.triangles.size(); ++e) {
      const double force = stitch.law.at(frame.strain[e]).value;
      if (force > stitch.law.breaking_force) frame.broken[e] = 1.0;
      frame.tension.push_back(frame.broken[e] > 0.0 ? 0.0 : force);
    }
  }
  return frames;
}

/// The larger and the smaller principal stretch of a triangle.
Vec2 principal_stretches(const Membrane& m, const AxesState& s) {
  const Vec3 k1 = s.k1(), k2 = m.across.x() * k1 + m.across.y() * s.k2();
  const double a = k1.squaredNorm(), b = k2.squaredNorm(), c = k1.dot(k2);
  const double mean = 0.5 * (a + b), off = std::hypot(0.5 * (a - b), c);
  const double larger = mean + off, smaller = std::max(0.0, a * b - c * c) / larger;
  return {std::sqrt(larger), std::sqrt(smaller)};
}

/// Fills what follows from the shape of each triangle: directions, shear, thickness, stretches.
/// Returns A / A0.
std::vector<double> add_yarns(const PlyBody& ply, PlyFrame& f) {
  const Membrane& m = ply.membrane;
  std::vector<std::vector<double>> strains = yarn_strains(m, ply.x);
  f.families = family_frames(ply, strains);
  f.stitches = stitch_frames(ply, strains);
  for (std::size_t c = 1; c < m.crossings.size(); ++c)
    f.crossings.push_back({m.fabric.families[m.crossings[c].first].name + "_" +
                               m.fabric.families[m.crossings[c].second].name,
                           {}});
  TriangleState t;
  std::vector<double> area_ratios;
  const bool rubber = m.fabric.sheet && std::holds_alternative<MooneyRivlinLaw>(*m.fabric.sheet);
  for (std::size_t e = 0; e < f.triangles.size(); ++e) {
    find_triangle(m, ply.x, static_cast<int>(e), t);
    const AxesState& s = t.axes;
    f.shear_deg.push_back(shown_shear(m, t) * degrees_per_radian);
    for (std::size_t c = 1; c < m.crossings.size(); ++c)
      f.crossings[c - 1].shear_deg.push_back(t.crossing[c].gamma * degrees_per_radian);
    for (std::size_t a = 0; a < m.fabric.families.size(); ++a)
      f.families[a].direction.push_back(t.yarn[a].f);
    for (std::size_t i = 0; i < f.stitches.size(); ++i)
      f.stitches[i].direction.push_back(t.yarn[m.fabric.families.size() + i].f);
    if (m.families.empty())
      for (std::size_t a = 0; a < 2; ++a) {
        f.families[a].direction.push_back(a == 0 ? s.f1 : s.f2);
        f.families[a].strain.push_back((a == 0 ? s.lambda1 : s.lambda2) - 1.0);
      }
    const double area_ratio = s.lambda1 * s.lambda2 * s.sin_omega / std::sin(m.omega0);
    f.thickness.push_back(ply.thickness / area_ratio);
    if (rubber) {
      const Vec2 stretch = principal_stretches(m, s);
      f.stretch[0].push_back(stretch.x()), f.stretch[1].push_back(stretch.y());
    }
    area_ratios.push_back(area_ratio);
  }
  add_openings(m, area_ratios, f);
  return area_ratios;
}

/// Fills what laws see of rates, and answer.
void add_rates(const PlyBody& ply, PlyFrame& f) {
  if (!ply.viscous) return;
  const std::vector<double> states = ply.viscous_now();
  for (std::size_t e = 0; e < f.triangles.size(); ++e) {
    const ShownRate shown = shown_rate(*ply.viscous, ply.membrane, states, e);
    f.shear_rate.push_back(shown.rate), f.largest_rate.push_back(shown.largest);
    f.viscous_shear.push_back(shown.shear);
  }
}

PlyFrame make_ply_frame(const Scene& scene, const BridgingSearch& bridging, int index) {
  const PlyBody& ply = scene.plies[index];
  PlyFrame f;
  f.name = ply.name;
  f.angle_deg = in_degrees(ply.angle);
  f.x0 = ply.x0;
  f.x = ply.x;
  f.triangles = ply.membrane.triangles;
  const std::vector<double> area_ratios = add_yarns(ply, f);
  for (const double ratio : area_ratios) // t/mm^2 to g/m^2
    f.areal_weight.push_back(1e12 * ply.membrane.fabric.surface_density / ratio);
  add_rates(ply, f);
  add_present_thickness(scene, index, area_ratios, f.thickness, f.fibre_volume);
  f.contact_pressure = contact_pressure(scene, index);
  f.reaction = ply.reaction;
  f.reaction.resize(ply.pull.empty() ? f.reaction.size() : ply.pull.size(), Vec3::Zero());
  for (std::size_t n = 0; n < ply.pull.size(); ++n)
    f.reaction[n] += ply.pull[n];
  bridging.fill(at(index), f);
  f.load_pressure = pressure_on(scene.data, at(index), scene.time)
                        .value_or(std::numeric_limits<double>::quiet_NaN());
  return f;
}

TriMesh surface_of(const Scene& scene, const ToolBody& body) {
  double extent = 0.0; // mm, largest distance of a ply's node from the tool
  for (const PlyBody& ply : scene.plies)
    for (const Vec3& x : ply.x0)
      extent = std::max(extent, (x - body.position).norm());
  constexpr double facet = 5.0; // mm, for pictures; of a tool of more than 1.5 m longer, of one of
                                // less than 100 mm shorter
  extent *= 1.2;
  const double diagonal = diagonal_of(body.shape, extent);
  const double size = diagonal > 0.0 ? std::clamp(facet, diagonal / 300.0, diagonal / 20.0) : facet;
  TriMesh surface = tessellate(body.shape, size, extent);
  for (Vec3& x : surface.x)
    x = body.rotation * x + body.position;
  return surface;
}

ToolFrame make_tool_frame(const ToolState& tool, const TriMesh& surface) {
  ToolFrame f;
  f.name = tool.name;
  const ToolBody& body = tool.body;
  f.surface = surface;
  f.displacement = body.displacement;
  f.force = tool.filter.value();
  f.stroke_mm = body.displacement.dot(body.direction);
  f.force_N = -f.force.dot(body.direction);
  f.force_raw_N = -tool.force.dot(body.direction);
  return f;
}

} // namespace

std::vector<double> contact_pressure(const Scene& scene, int index) {
  const auto p = static_cast<std::size_t>(index);
  const PlyBody& ply = scene.plies[p];
  SideForces sides{normals_at_nodes(ply), std::vector<double>(ply.x.size(), 0.0), {}};
  sides.below = sides.above;
  for (const ToolState& tool : scene.tools)
    for (const ToolPlyPoint& c : tool.contacts[p].points)
      sides.add(c.node, normal_of(c), c.memory.normal_force);
  each_pass(scene, [&](const PlyContact& pair) {
    for (const PlyPlyPoint& c : pair.contact.points) {
      if (c.memory.normal_force == 0.0 || (pair.slave != index && pair.master != index)) continue;
      const PlyBody& master = scene.plies[at(pair.master)];
      const std::vector<Triangle>& triangles = master.membrane.triangles;
      const Vec3 normal = contact_normal(c, scene.plies[at(pair.slave)].x, master.x, triangles);
      if (pair.slave == index) sides.add(c.node, normal, c.memory.normal_force);
      if (pair.master != index) continue;
      const Triangle& t = triangles[at(c.face)];
      const std::array<double, 3> w = weights_of(c);
      for (std::size_t j = 0; j < 3; ++j)
        sides.add(t[j], -normal, w[j] * c.memory.normal_force);
    }
  });
  std::vector<double> pressure(ply.x.size());
  for (std::size_t n = 0; n < pressure.size(); ++n)
    pressure[n] = std::max(sides.above[n], sides.below[n]) / ply.membrane.node_area[n];
  return pressure;
}

double current_stroke(const Scene& scene) {
  const double duration = scene.data.solver.duration;
  for (const Tool& tool : scene.data.tools)
    if (tool.motion == Motion::driven) return motion_at(tool, scene.time, duration);
  for (const Boundary& boundary : scene.data.boundaries)
    if (stroke_of(boundary) != 0.0) return motion_at(boundary, scene.time, duration);
  return 0.0;
}

std::vector<TriMesh> tool_surfaces(const Scene& scene, ThreadPool& pool) {
  std::vector<TriMesh> surfaces(scene.tools.size());
  pool.run(static_cast<int>(surfaces.size()), [&](int i) {
    const auto t = static_cast<std::size_t>(i);
    surfaces[t] = surface_of(scene, scene.tools[t].body);
  });
  return surfaces;
}

Frame make_frame(const Scene& scene, const std::vector<TriMesh>& surfaces, const Energies& energy,
                 ThreadPool& pool) {
  Frame f;
  f.time = scene.time;
  f.step = scene.step;
  f.stroke_mm = current_stroke(scene);
  f.energy = energy;
  f.films = std::any_of(scene.data.friction_laws.begin(), scene.data.friction_laws.end(),
                        [](const FrictionLawPtr& law) { return law->has_rates(); });
  f.plies.resize(scene.plies.size());
  const Moulds moulds = moulds_of(scene, surfaces);
  const BridgingSearch bridging(scene, moulds);
  pool.run(static_cast<int>(f.plies.size()),
           [&](int p) { f.plies[at(p)] = make_ply_frame(scene, bridging, p); });
  add_closed_gap(scene, moulds, pool, f.plies);
  std::vector<std::vector<double>> celsius = present_temperatures(scene, pool);
  for (std::size_t p = 0; p < celsius.size(); ++p)
    f.plies[p].temperature = std::move(celsius[p]);
  for (std::size_t t = 0; t < scene.tools.size(); ++t)
    f.tools.push_back(make_tool_frame(scene.tools[t], surfaces[t]));
  for (std::size_t b = 0; b < scene.boundaries.size(); ++b) {
    const BoundaryState& state = scene.boundaries[b];
    if (!scene.data.boundaries[b].is<SymmetryPlane>())
      f.boundaries.push_back(
          {scene.data.boundaries[b].name, state.displacement, state.load, state.force});
  }
  if (scene.data.part_at.empty()) add_wrinkles(scene, pool, f);
  return f;
}

void add_wrinkles(const Scene& scene, ThreadPool& pool, Frame& frame) {
  std::vector<const ToolBody*> tools;
  for (const ToolState& tool : scene.tools)
    tools.push_back(&tool.body);
  pool.run(static_cast<int>(frame.plies.size()), [&](int p) {
    PlyFrame& ply = frame.plies[at(p)];
    ply.wrinkle_height = wrinkles_of(ply, tools, least_wrinkle).at_nodes;
  });
}

} // namespace plyform
