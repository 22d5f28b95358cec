// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/membrane_frequency.hpp"

#include "core/patches.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

/// Larger eigenvalue of {{a, off}, {off, b}}.
double largest(double a, double b, double off) {
  return 0.5 * (a + b) + std::sqrt(0.25 * (a - b) * (a - b) + off * off);
}

/// Stiffness of both families per area, N/mm, yarns taut or pressed flat.
std::array<double, 2> yarn_stiffness(const Membrane& m) {
  const auto slope = [](const TensionLaw& yarn, const SideStiffness& side) {
    return std::max(yarn.largest_slope(), yarn.compression + side.guard);
  };
  return {m.fabric.warp_density * slope(m.fabric.warp, m.side[0]),
          m.fabric.weft_density * slope(m.fabric.weft, m.side[1])};
}

/// Stiffness per area against deviations within a patch, N/mm.
std::array<double, 2> deviation_stiffness(const Membrane& m, const FibreState& s) {
  const double shear = deviation_stiffness(m, s.gamma);
  return {m.fabric.warp_density * m.side[0].stabilisation + shear,
          m.fabric.weft_density * m.side[1].stabilisation + shear};
}

/// G_ab = c_a . c_b of one triangle, 1/mm^2.
struct Gram {
  double g11, g22, g12;
};

Gram gram(const FibreGradients& c) {
  const double c10 = -c.c11 - c.c12, c20 = -c.c21 - c.c22;
  return {c10 * c10 + c.c11 * c.c11 + c.c12 * c.c12, c20 * c20 + c.c21 * c.c21 + c.c22 * c.c22,
          c10 * c20 + c.c11 * c.c21 + c.c12 * c.c22};
}

/// Shear and geometric part of H below, N/mm, bounded by norms; the second derivative of the angle
/// is below 2/sin(omega) (1/lambda1^2 + 1/lambda2^2).
double soft_stiffness(const Membrane& m, const FibreState& s) {
  const LawPoint shear = m.fabric.shear.at(s.gamma);
  const double inv2 = 1.0 / (s.lambda1 * s.lambda1) + 1.0 / (s.lambda2 * s.lambda2);
  const double n1 = m.fabric.warp_density * m.fabric.warp.at(s.lambda1 - 1.0).value / s.lambda1;
  const double n2 = m.fabric.weft_density * m.fabric.weft.at(s.lambda2 - 1.0).value / s.lambda2;
  return std::max({0.0, n1, n2}) +
         m.cells_per_area * inv2 *
             (std::abs(shear.slope) + 2.0 * std::abs(shear.value) / s.sin_omega);
}

} // namespace

FrequencyBound frequency_bound(const Membrane& m, std::span<const Vec3> x) {
  // K_e = A0 B^T H B with B = [c_1; c_2] x I. Its non-zero eigenvalues are those of H (G x I),
  // and every node carries at least rho A0 / 3: so omega^2 <= 3/rho * them. Fibre part of H: exact,
  // a 2 x 2 problem. A sheet without yarns has only its own (core/isotropic.hpp).
  FrequencyBound bound;
  const auto [s1, s2] = yarn_stiffness(m);
  const double v1 = m.fabric.warp_density * m.viscosity.warp;
  const double v2 = m.fabric.weft_density * m.viscosity.weft;
  const double per_mass = 3.0 / m.fabric.surface_density;
  // a triangle's guard adds to the stiffness of its pair's taut yarns
  const bool paired = static_cast<std::size_t>(m.patches()) < m.triangles.size();
  const double g1 = m.fabric.warp_density * m.side[0].guard;
  const double g2 = m.fabric.weft_density * m.side[1].guard;
  constexpr double guard_reach = 0.55; // stretch: the guard acts below 0.5
  constexpr double considerable = 0.2; // of the yarn's stiffness: less is covered by step factors
  for (std::size_t e = 0; e < m.triangles.size(); ++e) {
    const Gram g = gram(m.c[e]);
    const FibreState s = fibre_state(m, x, static_cast<int>(e));
    const auto [d1, d2] = deviation_stiffness(m, s);
    const double k1 = s1 + d1 + (paired && s.lambda1 < guard_reach ? g1 : 0.0);
    const double k2 = s2 + d2 + (paired && s.lambda2 < guard_reach ? g2 : 0.0);
    const double fibre = largest(k1 * g.g11, k2 * g.g22, std::sqrt(k1 * k2) * g.g12 * s.cos_omega);
    const double viscous =
        largest(v1 * g.g11, v2 * g.g22, std::sqrt(v1 * v2) * g.g12 * s.cos_omega);
    const double sheet =
        m.fabric.isotropic
            ? isotropic_stiffness(
                  *m.fabric.isotropic,
                  isotropic_state(*m.fabric.isotropic, s.lambda1 * s.f1, s.lambda2 * s.f2), g.g11,
                  g.g22, g.g12)
            : 0.0;
    const double soft = soft_stiffness(m, s) * largest(g.g11, g.g22, g.g12);
    for (std::size_t a = 0; a < 2; ++a) {
      const TensionLaw& yarn = a == 0 ? m.fabric.warp : m.fabric.weft;
      const double lambda = a == 0 ? s.lambda1 : s.lambda2;
      bound.guarded = bound.guarded || (lambda < guard_reach &&
                                        m.side[a].guard > considerable * yarn.largest_slope());
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

namespace {

/// (K) for the yarns of one patch, into q.
void strain_patch(const Membrane& m, const std::vector<FibreState>& states, std::span<const Vec3> y,
                  std::size_t patch, std::vector<ElementForce>& q) {
  const auto yarn = yarn_stiffness(m);
  const auto begin = static_cast<std::size_t>(m.patch_begin[patch]),
             end = static_cast<std::size_t>(m.patch_begin[patch + 1]);
  double area = 0.0;
  std::array<double, 2> mean{};
  std::array<std::array<double, 2>, most_in_patch> strain{};
  for (std::size_t e = begin; e < end; ++e) {
    const FibreGradients& c = m.c[e];
    const Triangle& t = m.triangles[e];
    const Vec3& y0 = y[static_cast<std::size_t>(t[0])];
    const Vec3 g1 = y[static_cast<std::size_t>(t[1])] - y0,
               g2 = y[static_cast<std::size_t>(t[2])] - y0;
    strain[e - begin] = {states[e].f1.dot(c.c11 * g1 + c.c12 * g2),
                         states[e].f2.dot(c.c21 * g1 + c.c22 * g2)};
    area += m.area[e];
    for (std::size_t a = 0; a < 2; ++a)
      mean[a] += m.area[e] * strain[e - begin][a];
  }
  for (double& value : mean)
    value /= area;
  for (std::size_t e = begin; e < end; ++e) {
    const auto stiff = deviation_stiffness(m, states[e]);
    std::array<double, 2> pull;
    for (std::size_t a = 0; a < 2; ++a)
      pull[a] = m.area[e] * (yarn[a] * mean[a] + stiff[a] * (strain[e - begin][a] - mean[a]));
    q[e] = {pull[0] * states[e].f1, pull[1] * states[e].f2};
  }
}

/// Largest Ritz value of a symmetric operator after `steps` of Lanczos' iteration from `v`.
template <typename Operator>
double ritz_value(const Operator& apply, Eigen::VectorXd v, int steps) {
  Eigen::VectorXd diagonal(steps), beside(std::max(0, steps - 1)), before;
  before.setZero(v.size());
  v.normalize();
  double last = 0.0;
  int found = 0;
  while (found < steps) {
    Eigen::VectorXd w = apply(v) - last * before;
    diagonal[found] = w.dot(v);
    w -= diagonal[found] * v;
    last = w.norm();
    ++found;
    if (found == steps || !(last > 1e-12 * std::abs(diagonal[0]))) break; // all there is
    beside[found - 1] = last;
    before = v;
    v = w / last;
  }
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(diagonal.head(found), beside.head(std::max(0, found - 1)),
                                Eigen::EigenvaluesOnly);
  return solver.eigenvalues().maxCoeff();
}

/// The same start every time, with a share of every mode.
Eigen::VectorXd scattered(Eigen::Index size) {
  Eigen::VectorXd v(size);
  std::uint64_t state = 1;
  for (double& value : v) {
    state = state * 6364136223846793005u + 1442695040888963407u; // Knuth's MMIX generator
    value = static_cast<double>(state >> 11) * 0x1p-53 - 0.5;
  }
  return v;
}

} // namespace

double sharpness(const Membrane& m, std::span<const Vec3> x) {
  if (m.fabric.isotropic) return 1.0;
  constexpr int steps = 30;       // leaves 1 % to find on meshes of 1e6 triangles
  constexpr double margin = 1.03; // for that, three times
  std::vector<FibreState> states;
  for (std::size_t e = 0; e < m.triangles.size(); ++e)
    states.push_back(fibre_state(m, x, static_cast<int>(e)));
  std::vector<Vec3> y(x.size());
  std::vector<ElementForce> q(m.triangles.size());
  const auto apply = [&](const Eigen::VectorXd& v) { // M^-1/2 K M^-1/2
    for (std::size_t n = 0; n < y.size(); ++n)
      y[n] = v.segment<3>(static_cast<Eigen::Index>(3 * n)) / std::sqrt(m.node_mass[n]);
    for (std::size_t p = 0; p < static_cast<std::size_t>(m.patches()); ++p)
      strain_patch(m, states, y, p, q);
    Eigen::VectorXd w(v.size());
    for (std::size_t n = 0; n < y.size(); ++n)
      w.segment<3>(static_cast<Eigen::Index>(3 * n)) =
          -node_force(m, q, static_cast<int>(n)) / std::sqrt(m.node_mass[n]);
    return w;
  };
  const double found = ritz_value(apply, scattered(static_cast<Eigen::Index>(3 * x.size())), steps);
  return std::min(1.0, margin * found / frequency_bound(m, x).yarns);
}

double highest_omega2(const FrequencyBound& bound, double sharpness) {
  if (bound.guarded) return bound.omega2;
  return std::min(bound.omega2, sharpness * bound.yarns + bound.soft);
}

} // namespace plyform
