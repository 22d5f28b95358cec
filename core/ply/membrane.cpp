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
constexpr double most_of_shear = 0.1;     // s_a over what the shear holds deviations with, and
constexpr double shear_scale_at = 0.5;    // rad: where that is taken; the law may start from zero
constexpr double collapse_penalty = 1e-3; // g_a over yarn stiffness: far above the shear's scale

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
  m.fabric.warp = softened(fabric.warp, softening);
  m.fabric.weft = softened(fabric.weft, softening);
  m.omega0 = fabric.fibre_angle;
  m.cells_per_area = fabric.warp_density * fabric.weft_density * std::sin(m.omega0);
  m.side = {side_stiffness(m, m.fabric.warp, fabric.warp_density, m.softening[0]),
            side_stiffness(m, m.fabric.weft, fabric.weft_density, m.softening[1])};
  if (fabric.isotropic) kind = ElementKind::plain; // there is no yarn to lock
  std::vector<char> alone;                         // the paper's element where it does not lock
  if (kind == ElementKind::automatic) alone = along_fibres(mesh, warp_angle, warp_angle + m.omega0);
  const StrainGroups groups = kind == ElementKind::plain ? single_triangles(mesh.triangles.size())
                                                         : pair_triangles(mesh, alone);
  m.group_begin = groups.begin;
  for (std::int32_t e : groups.triangles)
    m.triangles.push_back(mesh.triangles[e]);
  m.node_area.assign(mesh.x.size(), 0.0);
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
  m.last_lambda.assign(static_cast<std::size_t>(m.groups()), {1.0, 1.0});
  m.last_viscous.assign(static_cast<std::size_t>(m.groups()), {0.0, 0.0});
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
  s.f1 = c.c11 * g1 + c.c12 * g2; // k_1 (11), made a unit vector below
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

namespace {

/// Stresses of a triangle without yarns.
IsotropicState isotropic_state(const Membrane& m, const FibreState& s) {
  return isotropic_state(*m.fabric.isotropic, s.lambda1 * s.f1, s.lambda2 * s.f2);
}

/// (q) of core/model/isotropic.hpp for triangles [begin, end).
GroupReport isotropic_forces(const Membrane& m, std::span<const Vec3> x, int begin, int end,
                             std::span<ElementForce> q) {
  GroupReport report;
  for (int i = begin; i < end; ++i) {
    const auto e = static_cast<std::size_t>(i);
    const FibreState s = fibre_state(m, x, i);
    const Vec3 k1 = s.lambda1 * s.f1, k2 = s.lambda2 * s.f2;
    const IsotropicState t = isotropic_state(*m.fabric.isotropic, k1, k2);
    q[e] = {m.area[e] * (t.s11 * k1 + t.s12 * k2), m.area[e] * (t.s12 * k1 + t.s22 * k2)};
    report.collapsed |= collapsed(s);
  }
  return report;
}

/// The triangles of one group and their mean stretches.
struct GroupState {
  int begin, size;
  std::array<FibreState, most_in_group> triangle;
  double area = 0.0, mean1 = 0.0, mean2 = 0.0;
};

GroupState group_state(const Membrane& m, std::span<const Vec3> x, int group) {
  const auto p = static_cast<std::size_t>(group);
  GroupState s;
  s.begin = m.group_begin[p];
  s.size = m.group_begin[p + 1] - s.begin;
  for (int i = 0; i < s.size; ++i) {
    const double area = m.area[s.begin + i];
    FibreState& t = s.triangle[i];
    t = fibre_state(m, x, s.begin + i);
    s.area += area;
    s.mean1 += area * t.lambda1;
    s.mean2 += area * t.lambda2;
  }
  s.mean1 /= s.area;
  s.mean2 /= s.area;
  return s;
}

/// Stabilisation and guard of (N) for one family.
double side_tension(const SideStiffness& side, double lambda, double mean) {
  return side.stabilisation * (lambda - mean) -
         side.collapse_penalty * std::max(0.0, collapse_stretch - lambda);
}

/// Their energy per yarn length, N.
double side_energy(const SideStiffness& side, double lambda, double mean) {
  const double deviation = lambda - mean, folded = std::max(0.0, collapse_stretch - lambda);
  return 0.5 *
         (side.stabilisation * deviation * deviation + side.collapse_penalty * folded * folded);
}

/// g of (E) for a triangle of a group.
double shear_measure(const FibreState& s, double mean1, double mean2) {
  const double d1 = s.lambda1 - mean1, d2 = s.lambda2 - mean2;
  return std::sqrt(s.gamma * s.gamma + deviation_weight * (d1 * d1 + d2 * d2));
}

/// n_c p of (N) and (Q), N/mm, for g = `measure`.
double secant_stiffness(const Membrane& m, double measure) {
  return m.cells_per_area * m.fabric.shear.secant(measure);
}

/// (Q) of one triangle; n1, n2: tensions (N) of its yarns; secant: n_c p (N/mm).
ElementForce triangle_force(const Membrane& m, const FibreState& s, double area, double n1,
                            double n2, double secant) {
  const double torque = area * secant * s.gamma / s.sin_omega;
  const double t1 = torque / s.lambda1, t2 = torque / s.lambda2;
  return {(area * m.fabric.warp_density * n1 - t1 * s.cos_omega) * s.f1 + t1 * s.f2,
          (area * m.fabric.weft_density * n2 - t2 * s.cos_omega) * s.f2 + t2 * s.f1};
}

/// (Q) of all triangles of a group whose yarns pull with n1 and n2 on the mean.
void patch_forces(const Membrane& m, const GroupState& s, double n1, double n2,
                  std::span<ElementForce> q) {
  std::array<double, most_in_group> secant{};
  double mean1 = 0.0, mean2 = 0.0; // of n_c p delta_a
  for (std::size_t i = 0; i < static_cast<std::size_t>(s.size); ++i) {
    const FibreState& t = s.triangle[i];
    secant[i] = secant_stiffness(m, shear_measure(t, s.mean1, s.mean2));
    const double share = m.area[static_cast<std::size_t>(s.begin) + i] / s.area * secant[i];
    mean1 += share * (t.lambda1 - s.mean1);
    mean2 += share * (t.lambda2 - s.mean2);
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(s.size); ++i) {
    const FibreState& t = s.triangle[i];
    const auto e = static_cast<std::size_t>(s.begin) + i;
    const double t1 = deviation_weight / m.fabric.warp_density *
                      (secant[i] * (t.lambda1 - s.mean1) - mean1); // t_a - mean t_a of (N)
    const double t2 =
        deviation_weight / m.fabric.weft_density * (secant[i] * (t.lambda2 - s.mean2) - mean2);
    q[e] = triangle_force(m, t, m.area[e], n1 + side_tension(m.side[0], t.lambda1, s.mean1) + t1,
                          n2 + side_tension(m.side[1], t.lambda2, s.mean2) + t2, secant[i]);
  }
}

} // namespace

double deviation_stiffness(const Membrane& m, double gamma) {
  const double slope = m.cells_per_area * m.fabric.shear.at(gamma).slope;
  return deviation_weight * std::max(slope, secant_stiffness(m, std::abs(gamma)));
}

std::vector<std::array<double, 2>> yarn_strains(const Membrane& m, std::span<const Vec3> x) {
  std::vector<std::array<double, 2>> strains(m.triangles.size());
  for (int p = 0; p < m.groups(); ++p) {
    const GroupState s = group_state(m, x, p);
    for (int i = 0; i < s.size; ++i)
      strains[s.begin + i] = {s.mean1 - 1.0, s.mean2 - 1.0};
  }
  return strains;
}

std::vector<std::array<double, 2>> yarn_tensions(const Membrane& m, std::span<const Vec3> x) {
  std::vector<std::array<double, 2>> tensions = yarn_strains(m, x);
  for (auto& [warp, weft] : tensions) {
    warp = m.fabric.warp.at(warp).value;
    weft = m.fabric.weft.at(weft).value;
  }
  std::vector<std::size_t> paired;
  for (std::size_t p = 0; p + 1 < m.group_begin.size(); ++p)
    for (int e = m.group_begin[p]; e < m.group_begin[p + 1]; ++e)
      if (m.group_begin[p + 1] - m.group_begin[p] > 1)
        paired.push_back(static_cast<std::size_t>(e));
  const int passes = paired.empty() ? 0 : 2;
  std::vector<std::array<double, 2>> at_node(x.size());
  for (int pass = 0; pass < passes; ++pass) {
    at_node.assign(x.size(), {0.0, 0.0});
    for (std::size_t e = 0; e < tensions.size(); ++e)
      for (const int n : m.triangles[e])
        for (std::size_t a = 0; a < 2; ++a) {
          const auto node = static_cast<std::size_t>(n);
          at_node[node][a] += m.area[e] / (3.0 * m.node_area[node]) * tensions[e][a];
        }
    for (const auto e : paired)
      for (std::size_t a = 0; a < 2; ++a) {
        tensions[e][a] = 0.0;
        for (const int n : m.triangles[e])
          tensions[e][a] += at_node[n][a] / 3.0;
      }
  }
  return tensions;
}

GroupReport element_forces(Membrane& m, std::span<const Vec3> x, double dt, int begin, int end,
                           std::span<ElementForce> q) {
  if (m.fabric.isotropic) return isotropic_forces(m, x, begin, end, q);
  const double d1 = m.fabric.warp_density, d2 = m.fabric.weft_density;
  const double per_dt = dt > 0.0 ? 1.0 / dt : 0.0;
  GroupReport report;
  for (int p = begin; p < end; ++p) {
    const GroupState s = group_state(m, x, p);
    double n1 = m.fabric.warp.at(s.mean1 - 1.0).value;
    double n2 = m.fabric.weft.at(s.mean2 - 1.0).value;
    // viscosity of taut fibres; its work by the trapezoidal rule over the step that led here
    auto& last = m.last_lambda[p];
    auto& viscous = m.last_viscous[p];
    const double dl1 = s.mean1 - last[0], dl2 = s.mean2 - last[1];
    const double v1 = n1 > 0.0 ? m.viscosity.warp * dl1 * per_dt : 0.0;
    const double v2 = n2 > 0.0 ? m.viscosity.weft * dl2 * per_dt : 0.0;
    report.viscous_work +=
        0.5 * s.area * (d1 * (v1 + viscous[0]) * dl1 + d2 * (v2 + viscous[1]) * dl2);
    last = {s.mean1, s.mean2};
    viscous = {v1, v2};
    n1 += v1;
    n2 += v2;
    patch_forces(m, s, n1, n2, q);
    for (std::size_t i = 0; i < static_cast<std::size_t>(s.size); ++i)
      report.collapsed |= collapsed(s.triangle[i]);
  }
  return report;
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

MembraneEnergy membrane_energy(const Membrane& m, std::span<const Vec3> x) {
  MembraneEnergy sum;
  const double d1 = m.fabric.warp_density, d2 = m.fabric.weft_density;
  for (int p = 0; p < m.groups(); ++p) {
    const GroupState s = group_state(m, x, p);
    sum.fibre += s.area * (d1 * m.fabric.warp.at(s.mean1 - 1.0).energy +
                           d2 * m.fabric.weft.at(s.mean2 - 1.0).energy);
    for (int i = 0; i < s.size; ++i) {
      const FibreState& t = s.triangle[i];
      const double area = m.area[s.begin + i];
      sum.fibre += area * (d1 * side_energy(m.side[0], t.lambda1, s.mean1) +
                           d2 * side_energy(m.side[1], t.lambda2, s.mean2));
      if (m.fabric.isotropic) sum.shear += area * isotropic_energy(isotropic_state(m, t));
      sum.shear +=
          area * m.cells_per_area * m.fabric.shear.at(shear_measure(t, s.mean1, s.mean2)).energy;
    }
  }
  return sum;
}

} // namespace plyform
