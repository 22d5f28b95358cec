// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/ply/membrane.hpp"

#include "core/mesh/incidence.hpp"
#include "core/mesh/pairs.hpp"
#include "core/ply/element_limits.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace plyform {
namespace {

constexpr double stabilisation = 1e-6;    // s_a over yarn stiffness, see (E)
constexpr double most_of_shear = 0.1;     // s_a over the stiffness that shear gives deviations,
constexpr double shear_scale_at = 0.5;    // rad: at this angle, as the law may start from zero
constexpr double collapse_penalty = 1e-3; // g_a over yarn stiffness: far above that of shear

/// s_a and g_a of the family `index`, see (E).
SideStiffness side_stiffness(const Membrane& m, std::size_t index) {
  const MembraneFamily& family = m.families[index];
  const double soft = family.yarn.largest_slope(), stiff = family.softening * soft;
  double by_shear = 0.0;
  const double softest =
      m.fabric.shear_over_temperature.extremes(m.fabric.shear_over_temperature.range()).first;
  for (const MembraneCrossing& c : m.crossings)
    if (c.first == index || c.second == index) {
      const double secant = std::min(c.shear.respond(shear_scale_at, 0.0).secant,
                                     c.shear.respond(-shear_scale_at, 0.0).secant);
      by_shear += softest * c.cells * deviation_weight * secant / family.density;
    }
  SideStiffness side{stabilisation * stiff, std::min(collapse_penalty * stiff, soft)};
  if (by_shear > 0.0) side.stabilisation = std::min(side.stabilisation, most_of_shear * by_shear);
  return side;
}

void set_laws(Membrane& m, const Fabric& fabric, const MaterialAxes& axes, double softening) {
  if (fabric.families.size() + fabric.stitches.size() > most_families ||
      fabric.crossings.size() > most_crossings)
    throw std::invalid_argument("a fabric of too many families or crossings");
  m.fabric = fabric;
  m.omega0 = axes.between();
  m.across = axes.components(axes.first + MaterialAxes{}.second);
  for (const YarnFamily& f : fabric.families)
    m.families.push_back({axes.components(f.angle),
                          f.density,
                          softened(f.tension, softening),
                          effective_softening(f.tension, softening),
                          0.0,
                          {},
                          {},
                          f.relaxation});
  for (MembraneFamily& f : m.families)
    if (f.relaxation) f.relaxation->modulus /= f.softening;
  for (const Crossing& c : fabric.crossings) {
    m.crossings.push_back(
        {c.first, c.second, crossing_angle(fabric, c), cells_per_area(fabric, c), c.shear});
    MembraneCrossing& made = m.crossings.back();
    made.is_axes =
        m.families[c.first].along == Vec2::UnitX() && m.families[c.second].along == Vec2::UnitY();
    if (c.shear.tabulated()) {
      made.steepest = c.shear.curve().largest_slope();
      made.table = shear_table(c.shear, made.cells);
    }
    made.crimp = c.crimp;
    if (!c.crimp) continue;
    const YarnFamily &a = fabric.families[c.first], &b = fabric.families[c.second];
    const double cells[] = {a.density / c.crimp->half_wave[0], b.density / c.crimp->half_wave[1]};
    if (!(std::abs(cells[0] - cells[1]) <= 1e-9 * cells[0]))
      throw std::invalid_argument("crimp of two families that have not equally many waves");
    m.crimped = m.families[c.first].crimped = m.families[c.second].crimped = true;
  }
  for (std::size_t a = 0; a < m.families.size(); ++a)
    m.families[a].side = side_stiffness(m, a);
  for (const Stitch& s : fabric.stitches)
    m.families.push_back(
        {axes.components(s.angle), s.density, s.law.tension, 1.0, 0.0, {}, s.law, {}});
}

} // namespace

Membrane make_membrane(const BlankMesh& mesh, const Fabric& fabric, double angle, ElementKind kind,
                       double softening) {
  Membrane m;
  const MaterialAxes axes = material_axes(fabric);
  set_laws(m, fabric, axes, softening);
  if (!fabric.has_yarns()) kind = ElementKind::plain; // without yarns nothing locks
  const double axis1 = angle + axes.first, axis2 = angle + axes.second;
  std::vector<char> alone; // triangles of the plain element: where it does not lock
  if (kind == ElementKind::automatic) {
    std::vector<double> yarns;
    for (const YarnFamily& family : fabric.families)
      yarns.push_back(angle + family.angle);
    alone = along_fibres(mesh, yarns);
  }
  const StrainGroups groups = kind == ElementKind::plain ? single_triangles(mesh.triangles.size())
                                                         : pair_triangles(mesh, alone);
  m.group_begin = groups.begin;
  m.triangles.reserve(groups.triangles.size());
  for (std::int32_t e : groups.triangles)
    m.triangles.push_back(mesh.triangles[e]);
  m.node_area.assign(mesh.x.size(), 0.0);
  m.c.reserve(m.triangles.size()), m.area.reserve(m.triangles.size());
  m.node_mass.reserve(mesh.x.size());
  const Vec2 e1(std::cos(axis1), std::sin(axis1));
  const Vec2 e2(std::cos(axis2), std::sin(axis2));
  for (const Triangle& t : m.triangles) {
    const Vec2 g1 = mesh.x[t[1]] - mesh.x[t[0]];
    const Vec2 g2 = mesh.x[t[2]] - mesh.x[t[0]];
    const double det = g1.x() * g2.y() - g1.y() * g2.x();
    if (!(det > 0.0)) throw std::invalid_argument("triangle of zero or negative area in a blank");
    // grad N_1 = (g2.y, -g2.x) / det, grad N_2 = (-g1.y, g1.x) / det
    m.c.push_back(
        {(g2.y() * e1.x() - g2.x() * e1.y()) / det, (g1.x() * e1.y() - g1.y() * e1.x()) / det,
         (g2.y() * e2.x() - g2.x() * e2.y()) / det, (g1.x() * e2.y() - g1.y() * e2.x()) / det});
    m.area.push_back(0.5 * det);
    for (int n : t)
      m.node_area[n] += det / 6.0;
  }
  for (double a : m.node_area)
    m.node_mass.push_back(fabric.surface_density * a);
  std::vector<std::int32_t> corners; // entry 3 e + k is corner k of triangle e
  for (const Triangle& t : m.triangles)
    corners.insert(corners.end(), t.begin(), t.end());
  Gather gather = make_gather(corners, mesh.x.size());
  m.gather_begin = std::move(gather.begin);
  m.gather = std::move(gather.gather);
  return m;
}

AxesState axes_state(const Membrane& m, std::span<const Vec3> x, int triangle) {
  const auto e = static_cast<std::size_t>(triangle);
  const Triangle& t = m.triangles[e];
  const AxesGradients& c = m.c[e];
  const Vec3& x0 = x[t[0]];
  const Vec3 g1 = x[t[1]] - x0;
  const Vec3 g2 = x[t[2]] - x0;
  AxesState s;
  s.f1 = c.c11 * g1 + c.c12 * g2; // k_1 (11), normalised below
  s.f2 = c.c21 * g1 + c.c22 * g2;
  s.lambda1 = s.f1.norm();
  s.lambda2 = s.f2.norm();
  s.f1 /= s.lambda1;
  s.f2 /= s.lambda2;
  const CrossingState c12 = crossing_state(s.f1, s.f2, m.omega0);
  s.cos_omega = c12.cos_omega, s.sin_omega = c12.sin_omega, s.gamma = c12.gamma;
  return s;
}

CrossingState crossing_state(const Vec3& f_a, const Vec3& f_b, double omega0) {
  CrossingState s;
  s.cos_omega = f_a.dot(f_b);
  s.sin_omega = std::max(least_sine, std::sqrt(std::max(0.0, 1.0 - s.cos_omega * s.cos_omega)));
  s.gamma = omega0 - std::atan2(s.sin_omega, s.cos_omega);
  return s;
}

void find_triangle(const Membrane& m, std::span<const Vec3> x, int triangle, TriangleState& t) {
  t.axes = axes_state(m, x, triangle);
  for (std::size_t a = 0; a < m.families.size(); ++a)
    t.yarn[a] = family_state(t.axes, m.families[a].along);
  for (std::size_t c = 0; c < m.crossings.size(); ++c) {
    const MembraneCrossing& of = m.crossings[c];
    if (of.is_axes)
      t.crossing[c] = {t.axes.cos_omega, t.axes.sin_omega, t.axes.gamma};
    else
      t.crossing[c] = crossing_state(t.yarn[of.first].f, t.yarn[of.second].f, of.omega0);
  }
}

double shown_shear(const Membrane& m, const TriangleState& t) {
  if (!m.crossings.empty()) return t.crossing[0].gamma;
  return crossing_state(t.axes.f1, family_state(t.axes, m.across).f, MaterialAxes{}.between())
      .gamma;
}

bool collapsed(const AxesState& s) {
  return !(s.lambda1 > least_stretch && s.lambda2 > least_stretch &&
           s.sin_omega > least_sine_between);
}

std::vector<YarnMemory> memory_at_start(const Membrane& m) {
  std::vector<YarnMemory> states;
  for (int p = 0; p < m.groups(); ++p)
    for (const MembraneFamily& family : m.families)
      start_state(family.law(), states.emplace_back().data());
  return states;
}

Vec3 node_force(const Membrane& m, std::span<const ElementForce> q, int node) {
  Vec3 f = Vec3::Zero();
  const auto n = static_cast<std::size_t>(node);
  for (auto i = static_cast<std::size_t>(m.gather_begin[n]);
       i < static_cast<std::size_t>(m.gather_begin[n + 1]); ++i) {
    const auto e = static_cast<std::size_t>(m.gather[i] / 3);
    const AxesGradients& c = m.c[e];
    double c1 = -c.c11 - c.c12, c2 = -c.c21 - c.c22;
    switch (m.gather[i] % 3) {
    case 1:
      c1 = c.c11, c2 = c.c21;
      break;
    case 2:
      c1 = c.c12, c2 = c.c22;
      break;
    default:
      break;
    }
    f -= c1 * q[e].q1 + c2 * q[e].q2; // (F)
  }
  return f;
}

} // namespace plyform
