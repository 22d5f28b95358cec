// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/ply/membrane_eigenvalue.hpp"

#include "core/ply/element_limits.hpp"
#include "core/ply/in_plane_law.hpp"
#include "core/ply/mass_normalise.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace plyform {
namespace {

/// Whether some strain groups are pairs of triangles.
bool is_paired(const Membrane& m) {
  return static_cast<std::size_t>(m.groups()) < m.triangles.size();
}

/// Larger eigenvalue of {{a, off}, {off, b}}.
double largest(double a, double b, double off) {
  return 0.5 * (a + b) + std::sqrt(0.25 * (a - b) * (a - b) + off * off);
}

/// Stiffness of both families per area, N/mm, in tension or in compression, whichever is stiffer.
std::array<double, 2> yarn_stiffness(const Membrane& m) {
  const auto slope = [](const TensionLaw& yarn, const SideStiffness& side) {
    return std::max(yarn.largest_slope(), yarn.compression + side.collapse_penalty);
  };
  return {m.fabric.warp_density * slope(m.yarn[0], m.side[0]),
          m.fabric.weft_density * slope(m.yarn[1], m.side[1])};
}

/// Stiffness per area of the deviations within a group, N/mm.
std::array<double, 2> deviation_stiffness(const Membrane& m, const FibreState& s) {
  const double shear = deviation_stiffness(m, s.gamma);
  return {m.fabric.warp_density * m.side[0].stabilisation + shear,
          m.fabric.weft_density * m.side[1].stabilisation + shear};
}

Gram gram(const FibreGradients& c) {
  const double c10 = -c.c11 - c.c12, c20 = -c.c21 - c.c22;
  return {c10 * c10 + c.c11 * c.c11 + c.c12 * c.c12, c20 * c20 + c.c21 * c.c21 + c.c22 * c.c22,
          c10 * c20 + c.c11 * c.c21 + c.c12 * c.c22};
}

/// 3/rho of a triangle, mm^2/t: over its area the inverse of the mass that it gives each corner.
double corners_per_mass(const Membrane& m, std::size_t e) {
  const double per_mass = 3.0 / m.fabric.surface_density;
  return m.density_factor.empty() ? per_mass : per_mass / m.density_factor[e];
}

/// Shear and geometric part of H (see eigenvalue_bound), N/mm, bounded by norms; the second
/// derivative of the angle is below 2/sin(omega) (1/lambda1^2 + 1/lambda2^2).
double soft_stiffness(const Membrane& m, const FibreState& s) {
  const LawPoint shear = m.fabric.shear.at(s.gamma);
  const double inv2 = 1.0 / (s.lambda1 * s.lambda1) + 1.0 / (s.lambda2 * s.lambda2);
  const double n1 = m.fabric.warp_density * m.yarn[0].at(s.lambda1 - 1.0).value / s.lambda1;
  const double n2 = m.fabric.weft_density * m.yarn[1].at(s.lambda2 - 1.0).value / s.lambda2;
  return std::max({0.0, n1, n2}) +
         m.cells_per_area * inv2 *
             (std::abs(shear.slope) + 2.0 * std::abs(shear.value) / s.sin_omega);
}

/// What a strain group gives a node: its mass, t, and its area times mean gradients, mm.
struct GroupNode {
  double mass = 0.0, b1 = 0.0, b2 = 0.0;
};

/// The nodes of strain group p.
std::map<int, GroupNode> nodes_of_group(const Membrane& m, std::size_t p) {
  std::map<int, GroupNode> nodes;
  for (auto e = static_cast<std::size_t>(m.group_begin[p]);
       e < static_cast<std::size_t>(m.group_begin[p + 1]); ++e) {
    const FibreGradients& c = m.c[e];
    const std::array<double, 3> c1{-c.c11 - c.c12, c.c11, c.c12}, c2{-c.c21 - c.c22, c.c21, c.c22};
    for (std::size_t k = 0; k < 3; ++k) {
      GroupNode& node = nodes[m.triangles[e][k]];
      node.mass += m.area[e] / corners_per_mass(m, e);
      node.b1 += m.area[e] * c1[k];
      node.b2 += m.area[e] * c2[k];
    }
  }
  return nodes;
}

/// 1/s^2, of group_omega2. As the bound of a triangle, with the nodes and mean gradients of the
/// group: K_g = A sum_a k_a b_a b_a^T x f_a f_a^T, M_g the masses that it gives its nodes.
double omega2_of_group(const Membrane& m, std::span<const Vec3> x, std::size_t p) {
  Gram g{0.0, 0.0, 0.0}; // (A b)^2 over the masses, mm^2/t
  for (const auto& [n, node] : nodes_of_group(m, p)) {
    g.g11 += node.b1 * node.b1 / node.mass;
    g.g22 += node.b2 * node.b2 / node.mass;
    g.g12 += node.b1 * node.b2 / node.mass;
  }
  const InPlaneLaw& law = in_plane_law(m.fabric);
  double area = 0.0, soft = 0.0, cos_omega = 0.0;
  for (auto e = static_cast<std::size_t>(m.group_begin[p]);
       e < static_cast<std::size_t>(m.group_begin[p + 1]); ++e) {
    const FibreState s = fibre_state(m, x, static_cast<int>(e));
    const Gram of = gram(m.c[e]);
    const double sheet = law.stiffness ? law.stiffness(m, s, of) : 0.0;
    soft = std::max(soft, corners_per_mass(m, e) *
                              (sheet + soft_stiffness(m, s) * largest(of.g11, of.g22, of.g12)));
    area += m.area[e];
    cos_omega = s.cos_omega;
  }
  const auto [s1, s2] = yarn_stiffness(m);
  return largest(s1 * g.g11, s2 * g.g22, std::sqrt(s1 * s2) * g.g12 * cos_omega) / area + soft;
}

} // namespace

EigenvalueBound eigenvalue_bound(const Membrane& m, std::span<const Vec3> x) {
  // K_e = A0 B^T H B with B = [c_1; c_2] x I. Its non-zero eigenvalues are those of H (G x I),
  // and each node has a mass of at least rho A0 / 3: so omega^2 <= 3/rho times the largest of them.
  // The fibre part of H is exact, a 2 x 2 problem. A sheet without yarns has only the part of its
  // own law (core/model/sheet_law.hpp).
  EigenvalueBound bound;
  const InPlaneLaw& law = in_plane_law(m.fabric);
  const auto [s1, s2] = yarn_stiffness(m);
  const double v1 = m.fabric.warp_density * m.viscosity.warp;
  const double v2 = m.fabric.weft_density * m.viscosity.weft;
  bound.viscous = std::max(s1 > 0.0 ? v1 / s1 : 0.0, s2 > 0.0 ? v2 / s2 : 0.0);
  // the collapse penalty of a triangle adds to the stiffness of the taut yarns of its pair
  const bool paired = is_paired(m);
  const double g1 = m.fabric.warp_density * m.side[0].collapse_penalty;
  const double g2 = m.fabric.weft_density * m.side[1].collapse_penalty;
  constexpr double considerable = 0.2; // of the yarn stiffness: step_factor covers less
  for (std::size_t e = 0; e < m.triangles.size(); ++e) {
    const double per_mass = corners_per_mass(m, e);
    const Gram g = gram(m.c[e]);
    const FibreState s = fibre_state(m, x, static_cast<int>(e));
    const auto [d1, d2] = deviation_stiffness(m, s);
    const double k1 = s1 + d1 + (paired && s.lambda1 < collapse_reach ? g1 : 0.0);
    const double k2 = s2 + d2 + (paired && s.lambda2 < collapse_reach ? g2 : 0.0);
    const double fibre = largest(k1 * g.g11, k2 * g.g22, std::sqrt(k1 * k2) * g.g12 * s.cos_omega);
    const double viscous =
        largest(v1 * g.g11, v2 * g.g22, std::sqrt(v1 * v2) * g.g12 * s.cos_omega);
    const double sheet = law.stiffness ? law.stiffness(m, s, g) : 0.0;
    const double soft = soft_stiffness(m, s) * largest(g.g11, g.g22, g.g12);
    for (std::size_t a = 0; a < 2; ++a) {
      const double lambda = a == 0 ? s.lambda1 : s.lambda2;
      bound.penalty_acts = bound.penalty_acts ||
                           (lambda < collapse_reach &&
                            m.side[a].collapse_penalty > considerable * m.yarn[a].largest_slope());
    }
    bound.yarns = std::max(bound.yarns, per_mass * (fibre + sheet));
    bound.soft = std::max(bound.soft, per_mass * soft);
    const double omega2 = per_mass * (fibre + sheet + soft);
    if (!(omega2 <= bound.omega2)) {
      bound.omega2 = omega2;
      bound.triangle = static_cast<int>(e);
    }
    bound.damping = std::max(bound.damping, per_mass * viscous);
  }
  return bound;
}

std::vector<double> group_omega2(const Membrane& m, std::span<const Vec3> x) {
  std::vector<double> omega2;
  omega2.reserve(m.triangles.size());
  for (std::size_t p = 0; p < static_cast<std::size_t>(m.groups()); ++p)
    omega2.resize(static_cast<std::size_t>(m.group_begin[p + 1]), omega2_of_group(m, x, p));
  return omega2;
}

YarnStiffness::YarnStiffness(const Membrane& m, std::span<const Vec3> x, double stiffness,
                             double damping)
    : m_(m), q_(m.triangles.size()) {
  const auto yarn = yarn_stiffness(m);
  taut_ = {stiffness * yarn[0] + damping * m.fabric.warp_density * m.viscosity.warp,
           stiffness * yarn[1] + damping * m.fabric.weft_density * m.viscosity.weft};
  const std::array<double, 2> collapse_penalty{
      stiffness * m.fabric.warp_density * m.side[0].collapse_penalty,
      stiffness * m.fabric.weft_density * m.side[1].collapse_penalty};
  for (std::size_t e = 0; e < m.triangles.size(); ++e) {
    const FibreState s = fibre_state(m, x, static_cast<int>(e));
    const auto [d1, d2] = deviation_stiffness(m, s);
    const bool paired = is_paired(m);
    rows_.push_back({s.f1,
                     s.f2,
                     {stiffness * d1, stiffness * d2},
                     {paired && s.lambda1 < collapse_reach ? collapse_penalty[0] : 0.0,
                      paired && s.lambda2 < collapse_reach ? collapse_penalty[1] : 0.0}});
  }
}

void YarnStiffness::strain_group(std::span<const Vec3> y, std::size_t group) {
  const auto begin = static_cast<std::size_t>(m_.group_begin[group]),
             end = static_cast<std::size_t>(m_.group_begin[group + 1]);
  double area = 0.0;
  std::array<double, 2> mean{};
  std::array<std::array<double, 2>, most_in_group> strain{};
  for (std::size_t e = begin; e < end; ++e) {
    const FibreGradients& c = m_.c[e];
    const Triangle& t = m_.triangles[e];
    const Vec3& y0 = y[t[0]];
    const Vec3 g1 = y[t[1]] - y0, g2 = y[t[2]] - y0;
    strain[e - begin] = {rows_[e].f1.dot(c.c11 * g1 + c.c12 * g2),
                         rows_[e].f2.dot(c.c21 * g1 + c.c22 * g2)};
    area += m_.area[e];
    for (std::size_t a = 0; a < 2; ++a)
      mean[a] += m_.area[e] * strain[e - begin][a];
  }
  for (double& value : mean)
    value /= area;
  for (std::size_t e = begin; e < end; ++e) {
    const Row& row = rows_[e];
    std::array<double, 2> pull;
    for (std::size_t a = 0; a < 2; ++a) {
      const double own = strain[e - begin][a];
      pull[a] = m_.area[e] * (taut_[a] * mean[a] + row.deviation[a] * (own - mean[a]) +
                              row.collapse_penalty[a] * own);
    }
    q_[e] = {pull[0] * row.f1, pull[1] * row.f2};
  }
}

void YarnStiffness::add_to(std::span<const Vec3> y, std::span<Vec3> f) {
  for (std::size_t p = 0; p < static_cast<std::size_t>(m_.groups()); ++p)
    strain_group(y, p);
  for (std::size_t n = 0; n < f.size(); ++n)
    f[n] -= node_force(m_, q_, static_cast<int>(n));
}

Eigen::VectorXd scattered_motion(const Membrane& m, std::span<const Vec3> x) {
  Eigen::VectorXd v(static_cast<Eigen::Index>(3 * x.size()));
  RandomNumbers scatter;
  for (std::size_t n = 0; n < x.size(); ++n) {
    const int triangle = m.gather[m.gather_begin[n]] / 3;
    const FibreState s = fibre_state(m, x, triangle);
    const double along1 = scatter.next(), along2 = scatter.next(), across = scatter.next();
    v.segment<3>(static_cast<Eigen::Index>(3 * n)) =
        along1 * s.f1 + along2 * s.f2 + across * s.f1.cross(s.f2);
  }
  return v;
}

double eigenvalue_ratio(const Membrane& m, std::span<const Vec3> x) {
  if (!in_plane_law(m.fabric).yarns) return 1.0;
  YarnStiffness stiffness(m, x, 1.0, 0.0);
  std::vector<Vec3> y(x.size()), f(x.size());
  const auto apply = [&](const Eigen::VectorXd& v) { // M^-1/2 K M^-1/2
    over_root_of_mass(m.node_mass, v, y);
    std::fill(f.begin(), f.end(), Vec3::Zero());
    stiffness.add_to(y, f);
    Eigen::VectorXd w(v.size());
    over_root_of_mass(m.node_mass, std::span<const Vec3>(f), w);
    return w;
  };
  const RitzValue found = largest_ritz_value(apply, scattered_motion(m, x), ritz_steps);
  return std::min(1.0, upper_bound(found) / eigenvalue_bound(m, x).yarns);
}

double kink_factor(const Membrane& m) {
  double most = 0.0;
  for (const TensionLaw& yarn : m.yarn) {
    const double tension = yarn.largest_slope(), compression = yarn.compression;
    if (!(tension > 0.0)) continue; // no yarns
    const double r = std::min(tension, compression) / std::max(tension, compression);
    most = std::max(most, r * (1.0 - r));
  }
  return 1.0 + 0.8 * most; // (R)
}

double highest_omega2(const EigenvalueBound& bound, double eigenvalue_ratio) {
  if (bound.penalty_acts) return bound.omega2;
  return std::min(bound.omega2, eigenvalue_ratio * bound.yarns + bound.soft);
}

} // namespace plyform
