// SPDX-License-Identifier: GPL-3.0-or-later
// core/ply/viscous_membrane.hpp and viscous_bending.hpp, whose symbols these are, one triangle and
// one node after the other: what the kernels are compared with.
#pragma once

#include "core/mesh/pairs.hpp"
#include "core/ply/element_limits.hpp"
#include "core/ply/viscous_bending.hpp"
#include "core/ply/viscous_membrane.hpp"
#include "support/bending_reference.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {

/// q_1 of (B) of core/model/viscous_shear.hpp for D = c v: of a dashpot of viscosity c (N mm s)
/// behind a spring of modulus K (N mm) that is moved by `change` in dt (s).
inline double dashpot_torque(double viscosity, double spring, double dt, double q0, double change) {
  const double resist = viscosity + spring * dt;
  return resist > 0.0 ? viscosity / resist * (q0 + spring * change) : 0.0;
}
/// What a branch loses in a step: work less what its spring of this modulus stores more.
inline double branch_loss(double q0, double q1, double change, double modulus) {
  return 0.5 * (q0 + q1) * (change - (q1 - q0) / modulus);
}

/// What triangles keep: `states` numbers for the first, for the second ...
struct ViscousStates {
  std::span<const double> begin;
  std::span<double> end;
  /// m, what temperatures make of laws that are given at another one: of viscosities, and of the
  /// times in which branches relax; moduli stay (superposition of time and temperature). Empty: 1.
  std::span<const double> factors = {};
  double factor_of(std::size_t e) const { return factors.empty() ? 1.0 : factors[e]; }
};

inline const double root_of_weight = std::sqrt(deviation_weight);

/// A branch in a step: those of a crossing depend on dt alone where nothing changes the law.
struct BranchStep {
  MaxwellStep step;
  double modulus; ///< G, N mm
};
using BranchSteps = std::vector<BranchStep>;

inline void find_branch_steps(const ViscousShear& law, double dt, double by, BranchSteps& steps) {
  steps.clear();
  for (const MaxwellBranch& branch : law.branches) {
    const MaxwellBranch now{branch.modulus, branch.time * by};
    steps.push_back({dt > 0.0 ? maxwell_step(now, dt) : MaxwellStep{}, now.modulus});
  }
}

/// A number X of a triangle in a step.
struct Strain {
  double change;    ///< of X
  double dt;        ///< s
  double spring;    ///< K, N mm
  double viscosity; ///< c, N mm s
};

/// Moves the torques (dashpot, then branches, three numbers apart) of one X; returns their sum and
/// adds to `lost`, N mm a cell.
inline double move_torques(const ViscousCrossing& c, const BranchSteps& steps, const Strain& s,
                           const double* now, double* next, double& lost) {
  double sum = 0.0;
  const auto add = [&](double q0, double q1, double modulus) {
    lost += branch_loss(q0, q1, s.change, modulus);
    sum += q1;
  };
  if (c.law.has_dashpot()) {
    next[0] = dashpot_torque(s.viscosity, s.spring, s.dt, now[0], s.change);
    add(now[0], next[0], s.spring);
  }
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const auto& [step, modulus] = steps[k];
    const double q0 = now[3 * (k + 1)], q1 = step.keep * q0 + step.rise * s.change;
    next[3 * (k + 1)] = q1;
    add(q0, q1, modulus);
  }
  return sum;
}

inline double sum_of_torques(const ViscousCrossing& c, const double* q) {
  double sum = 0.0;
  for (std::size_t k = 0; k <= c.law.branches.size(); ++k)
    sum += q[3 * k];
  return sum;
}

/// Smooths a rate over some time, and keeps the largest.
inline void smooth_rate(double change, double dt, double time, const double* now, double* next) {
  next[0] = now[0] + dt / (dt + time) * (change / dt - now[0]);
  next[1] = std::max(now[1], std::abs(next[0]));
}

/// Takes the state of a crossing in a triangle over a step. X: at its end. torque: Q of each X.
/// Returns what is lost, N mm a cell.
inline double step_crossing(const ViscousCrossing& c, const MembraneCrossing& of,
                            const BranchSteps& steps, double dt, double factor,
                            const std::array<double, 3>& X, const double* now, double* next,
                            std::array<double, 3>& torque) {
  const double *x = now + c.state, *q = x + 3;
  double *x1 = next + c.state, *q1 = x1 + 3;
  const double* rate = now + c.rates();
  double* rate1 = next + c.rates();
  std::copy(X.begin(), X.end(), x1);
  double lost = 0.0;
  if (!(dt > 0.0)) {
    std::copy(q, q + 3 * (1 + steps.size()), q1);
    rate1[0] = rate[0], rate1[1] = rate[1];
    for (std::size_t i = 0; i < 3; ++i)
      torque[i] = sum_of_torques(c, q + i);
    return lost;
  }
  const double change = X[0] - x[0];
  double viscosity = 0.0;
  if (c.law.has_dashpot())
    viscosity = c.law.viscosity(X[0], q[0] + of.spring * change, of.spring * dt, factor);
  for (std::size_t i = 0; i < 3; ++i)
    torque[i] = move_torques(c, steps,
                             {X[i] - x[i], dt, i == 0 ? of.spring : of.deviation_spring, viscosity},
                             q + i, q1 + i, lost);
  smooth_rate(change, dt, c.rate_time, rate, rate1);
  return lost;
}

/// Takes the melt in a triangle over a step (F), and adds to (Q) and to what is lost, N/mm.
inline double step_sheet(const ViscousSheet& sheet, const Membrane& m, const AxesState& axes,
                         double dt, double factor, double area, const double* now, double* next,
                         ElementForce& q) {
  const Vec3 k1 = axes.k1(), k2 = m.across.x() * k1 + m.across.y() * axes.k2();
  const double *before = now + sheet.state, *n0 = before + 3, *rate = now + sheet.rates();
  double *after = next + sheet.state, *n1 = after + 3, *rate1 = next + sheet.rates();
  const double c11 = k1.squaredNorm(), lambda = std::sqrt(c11), c12 = k1.dot(k2);
  const double u = c12 / lambda, v = std::max(least_stretch, (k2 - u / lambda * k1).norm());
  after[0] = c11 - 1.0, after[1] = k2.squaredNorm() - 1.0, after[2] = c12;
  n1[0] = n0[0], n1[1] = n0[1], rate1[0] = rate[0], rate1[1] = rate[1];
  double lost = 0.0;
  if (dt > 0.0) {
    const double d11 = after[0] - before[0], d22 = after[1] - before[1], d12 = after[2] - before[2];
    const double change[] = {d12 / (lambda * v) - u * d11 / (c11 * v),
                             (0.5 * d22 - u * d12 / lambda + 0.5 * u * u * d11 / c11) / (v * v)};
    const double viscosity[] = {factor * sheet.shear, factor * sheet.apart};
    for (int i = 0; i < 2; ++i) {
      n1[i] = dashpot_torque(viscosity[i], m.matrix_spring, dt, n0[i], change[i]);
      lost += branch_loss(n0[i], n1[i], change[i], m.matrix_spring);
    }
    smooth_rate(change[0], dt, sheet.rate_time, rate, rate1);
  }
  const double s11 = -2.0 * n1[0] * u / (c11 * v) + n1[1] * u * u / (c11 * v * v),
               s12 = n1[0] / (lambda * v) - n1[1] * u / (lambda * v * v), s22 = n1[1] / (v * v);
  const Vec3 q2 = area * (s12 * k1 + s22 * k2);
  q.q1 += area * (s11 * k1 + s12 * k2) + m.across.x() * q2;
  q.q2 += m.across.y() * q2;
  return lost;
}

/// The triangles of one group.
struct ViscousGroup {
  int begin, size;
  std::array<TriangleState, most_in_group> triangle;
  std::array<double, most_in_group> share; ///< of the group's area
  OfFamilies mean{};
};

inline void find_group(const Membrane& m, std::span<const Vec3> x, int group, ViscousGroup& g) {
  const auto p = static_cast<std::size_t>(group);
  g.begin = m.group_begin[p];
  g.size = m.group_begin[p + 1] - g.begin;
  double area = 0.0;
  for (int i = 0; i < g.size; ++i)
    area += m.area[g.begin + i];
  g.mean = {};
  for (int i = 0; i < g.size; ++i) {
    find_triangle(m, x, g.begin + i, g.triangle[i]);
    g.share[i] = m.area[g.begin + i] / area;
    for (std::size_t a = 0; a < m.families.size(); ++a)
      g.mean[a] += g.share[i] * g.triangle[i].yarn[a].lambda;
  }
}

/// (P) and (Q) of a triangle. held: as n of `own`, d_a N_a; shear: n_c Q of viscous crossings.
inline ElementForce force_of(const ViscousMembrane& v, const Membrane& m, const TriangleState& t,
                             double area, const OfFamilies& own, const double* shear) {
  std::array<Vec3, most_families> p;
  for (std::size_t a = 0; a < m.families.size(); ++a)
    p[a] = area * own[a] * t.yarn[a].f;
  for (std::size_t i = 0; i < v.crossings.size(); ++i) {
    const MembraneCrossing& of = m.crossings[v.crossings[i].crossing];
    const FamilyState &a = t.yarn[of.first], &b = t.yarn[of.second];
    const CrossingState& s = t.crossing[v.crossings[i].crossing];
    const double torque = area * shear[i] / s.sin_omega;
    p[of.first] += torque / a.lambda * (b.f - s.cos_omega * a.f);
    p[of.second] += torque / b.lambda * (a.f - s.cos_omega * b.f);
  }
  ElementForce q{Vec3::Zero(), Vec3::Zero()};
  for (std::size_t a = 0; a < m.families.size(); ++a) {
    q.q1 += m.families[a].along.x() * p[a];
    q.q2 += m.families[a].along.y() * p[a];
  }
  return q;
}

/// Takes the crossings of a group over a step.
inline void step_group(const ViscousMembrane& v, const Membrane& m, const ViscousGroup& g,
                       std::vector<BranchSteps>& steps, double dt, const ViscousStates& states,
                       std::span<ElementForce> q) {
  std::array<std::array<double, most_crossings>, most_in_group> shear{};
  std::array<OfFamilies, most_in_group> held{};
  OfFamilies mean{};
  for (std::size_t i = 0; i < static_cast<std::size_t>(g.size); ++i) {
    const TriangleState& t = g.triangle[i];
    const std::size_t e = static_cast<std::size_t>(g.begin) + i, at_state = e * v.states;
    const double* now = states.begin.data() + at_state;
    double* next = states.end.data() + at_state;
    next[0] = now[0];
    const double by = states.factor_of(e);
    for (std::size_t k = 0; k < v.crossings.size(); ++k) {
      const ViscousCrossing& c = v.crossings[k];
      const MembraneCrossing& of = m.crossings[c.crossing];
      const std::array<std::size_t, 2> ab{of.first, of.second};
      std::array<double, 3> X{t.crossing[c.crossing].gamma, 0.0, 0.0}, torque{};
      for (std::size_t a = 0; a < 2 && g.size > 1; ++a)
        X[a + 1] = root_of_weight * (t.yarn[ab[a]].lambda - g.mean[ab[a]]);
      if (!states.factors.empty()) find_branch_steps(c.law, dt, by, steps[k]);
      const double lost = step_crossing(c, of, steps[k], dt, by, X, now, next, torque);
      next[0] += m.area[e] * of.cells * lost;
      shear[i][k] = of.cells * torque[0];
      for (std::size_t a = 0; a < 2; ++a)
        held[i][ab[a]] += of.cells * root_of_weight * torque[a + 1];
    }
    for (std::size_t a = 0; a < m.families.size(); ++a)
      mean[a] += g.share[i] * held[i][a];
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(g.size); ++i) {
    const std::size_t e = static_cast<std::size_t>(g.begin) + i;
    for (std::size_t a = 0; a < m.families.size(); ++a)
      held[i][a] -= mean[a];
    q[e] = force_of(v, m, g.triangle[i], m.area[e], held[i], shear[i].data());
    if (!v.sheet) continue;
    double* next = states.end.data() + e * v.states;
    next[0] += m.area[e] * step_sheet(*v.sheet, m, g.triangle[i].axes, dt, states.factor_of(e),
                                      m.area[e], states.begin.data() + e * v.states, next, q[e]);
  }
}

/// (Q) of groups [begin, end) by rates at positions x (mm, n). dt: s of the process, of the step
/// that led to x; 0 at the start. q: N mm, m, of which those of the groups are written.
inline void viscous_forces(const ViscousMembrane& v, const Membrane& m, std::span<const Vec3> x,
                           double dt, int begin, int end, const ViscousStates& states,
                           std::span<ElementForce> q) {
  std::vector<BranchSteps> steps(v.crossings.size());
  for (std::size_t k = 0; k < steps.size(); ++k)
    find_branch_steps(v.crossings[k].law, dt, 1.0, steps[k]);
  ViscousGroup g;
  for (int p = begin; p < end; ++p) {
    find_group(m, x, p, g);
    step_group(v, m, g, steps, dt, states, q);
  }
}

/// Moves the moment of one family over a step; returns it and adds what is lost, N/mm. state:
/// kappa, moment.
inline double move_moment(double viscosity, double spring, double kappa, double dt,
                          const double* now, double* next, double& lost) {
  next[0] = kappa, next[1] = now[1];
  if (!(dt > 0.0)) return next[1];
  const double change = kappa - now[0];
  next[1] = dashpot_torque(viscosity, spring, dt, now[1], change);
  lost += branch_loss(now[1], next[1], change, spring);
  return next[1];
}

/// Forces (N) on all nodes at positions x (mm). dt: s of the process, of the step that led to x; 0
/// at the start. begin, end: `states` numbers of the first node, of the second ... factors: of the
/// viscosity at each node, or empty: 1.
inline void viscous_bending_forces(const ViscousBending& v, const Bending& bending,
                                   std::span<const Vec3> x, double dt,
                                   std::span<const double> begin, std::span<double> end,
                                   std::vector<Vec3>& force, std::span<const double> factors = {}) {
  std::fill(force.begin(), force.end(), Vec3::Zero());
  for (std::size_t n = 0; n < x.size(); ++n) {
    const StencilShape s = stencil_shape(bending, x, n);
    const double* now = begin.data() + n * v.states();
    double* next = end.data() + n * v.states();
    const double by = factors.empty() ? 1.0 : factors[n];
    double lost = 0.0;
    std::array<double, 3> m{};
    for (std::size_t f = 0; f < v.viscosity.size(); ++f) {
      const Vec3 p = bending.law.families[v.family[f]].of_axes();
      const double kappa = p[0] * s.kappa[0] + p[1] * s.kappa[1] + p[2] * s.kappa[2];
      const double moment = move_moment(by * v.viscosity[f], v.spring, kappa, dt, now + 1 + 2 * f,
                                        next + 1 + 2 * f, lost);
      for (std::size_t k = 0; k < 3; ++k)
        m[k] += moment * p[static_cast<Eigen::Index>(k)];
    }
    next[0] = now[0] + bending.area[n] * lost;
    add_moment_forces(bending, x, n, s, m, force);
  }
}

} // namespace plyform
