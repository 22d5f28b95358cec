// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/ply/membrane.hpp"

#include "core/mesh/incidence.hpp"
#include "core/mesh/pairs.hpp"
#include "core/ply/element_limits.hpp"
#include "core/ply/in_plane_law.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace plyform {
namespace {

constexpr double stabilisation = 1e-6;    // s_a over yarn stiffness, see (E)
constexpr double most_of_shear = 0.1;     // s_a over the stiffness that shear gives deviations,
constexpr double shear_scale_at = 0.5;    // rad: at this angle, as the law may start from zero
constexpr double collapse_penalty = 1e-3; // g_a over yarn stiffness: far above that of shear

/// s_a and g_a of a family of yarns softened by `softening`, see (E).
SideStiffness side_stiffness(const Membrane& m, const TensionLaw& yarn, double density,
                             double softening) {
  const double soft = yarn.largest_slope(), stiff = softening * soft;
  const double secant = m.fabric.shear.at(shear_scale_at).value / shear_scale_at;
  const double by_shear = density > 0.0 ? m.cells_per_area * deviation_weight * secant / density
                                        : 0.0; // a sheet without yarns has none
  SideStiffness side{stabilisation * stiff, std::min(collapse_penalty * stiff, soft)};
  if (by_shear > 0.0) side.stabilisation = std::min(side.stabilisation, most_of_shear * by_shear);
  return side;
}

} // namespace

Membrane make_membrane(const BlankMesh& mesh, const Fabric& fabric, double warp_angle,
                       ElementKind kind, double softening) {
  Membrane m;
  m.fabric = fabric;
  m.softening = {effective_softening(fabric.warp, softening),
                 effective_softening(fabric.weft, softening)};
  m.yarn = {softened(fabric.warp, softening), softened(fabric.weft, softening)};
  m.omega0 = fabric.fibre_angle;
  m.cells_per_area = fabric.warp_density * fabric.weft_density * std::sin(m.omega0);
  m.side = {side_stiffness(m, m.yarn[0], fabric.warp_density, m.softening[0]),
            side_stiffness(m, m.yarn[1], fabric.weft_density, m.softening[1])};
  if (!in_plane_law(fabric).yarns) kind = ElementKind::plain; // without yarns nothing locks
  std::vector<char> alone; // triangles of the plain element: where it does not lock
  if (kind == ElementKind::automatic) alone = along_fibres(mesh, warp_angle, warp_angle + m.omega0);
  const StrainGroups groups = kind == ElementKind::plain ? single_triangles(mesh.triangles.size())
                                                         : pair_triangles(mesh, alone);
  m.group_begin = groups.begin;
  m.triangles.reserve(groups.triangles.size());
  for (std::int32_t e : groups.triangles)
    m.triangles.push_back(mesh.triangles[e]);
  m.node_area.assign(mesh.x.size(), 0.0);
  m.c.reserve(m.triangles.size()), m.area.reserve(m.triangles.size());
  m.node_mass.reserve(mesh.x.size());
  const Vec2 e1(std::cos(warp_angle), std::sin(warp_angle));
  const Vec2 e2(std::cos(warp_angle + m.omega0), std::sin(warp_angle + m.omega0));
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

FibreState fibre_state(const Membrane& m, std::span<const Vec3> x, int triangle) {
  const auto e = static_cast<std::size_t>(triangle);
  const Triangle& t = m.triangles[e];
  const FibreGradients& c = m.c[e];
  const Vec3& x0 = x[t[0]];
  const Vec3 g1 = x[t[1]] - x0;
  const Vec3 g2 = x[t[2]] - x0;
  FibreState s;
  s.f1 = c.c11 * g1 + c.c12 * g2; // k_1 (11), normalised below
  s.f2 = c.c21 * g1 + c.c22 * g2;
  s.lambda1 = s.f1.norm();
  s.lambda2 = s.f2.norm();
  s.f1 /= s.lambda1;
  s.f2 /= s.lambda2;
  s.cos_omega = s.f1.dot(s.f2);
  s.sin_omega = std::max(least_sine, std::sqrt(std::max(0.0, 1.0 - s.cos_omega * s.cos_omega)));
  s.gamma = m.omega0 - std::atan2(s.sin_omega, s.cos_omega);
  return s;
}

bool collapsed(const FibreState& s) {
  return !(s.lambda1 > least_stretch && s.lambda2 > least_stretch &&
           s.sin_omega > least_sine_between);
}

GroupReport element_forces(const Membrane& m, std::span<const Vec3> x, double dt, int begin,
                           int end, const LawStates<YarnMemory>& states,
                           std::span<ElementForce> q) {
  return in_plane_law(m.fabric).forces(m, x, dt, begin, end, states, q);
}

MembraneEnergy membrane_energy(const Membrane& m, std::span<const Vec3> x,
                               std::span<const YarnMemory> states, double dt) {
  return in_plane_law(m.fabric).energy(m, x, states, dt);
}

std::vector<YarnMemory> memory_at_start(const Membrane& m) {
  YarnMemory start{};
  for (std::size_t family = 0; family < 2; ++family)
    start_state(m.law(family), start[family].data());
  return std::vector<YarnMemory>(static_cast<std::size_t>(m.groups()), start);
}

Vec3 node_force(const Membrane& m, std::span<const ElementForce> q, int node) {
  Vec3 f = Vec3::Zero();
  const auto n = static_cast<std::size_t>(node);
  for (auto i = static_cast<std::size_t>(m.gather_begin[n]);
       i < static_cast<std::size_t>(m.gather_begin[n + 1]); ++i) {
    const auto e = static_cast<std::size_t>(m.gather[i] / 3);
    const FibreGradients& c = m.c[e];
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
