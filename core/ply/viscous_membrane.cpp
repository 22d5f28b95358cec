// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/ply/viscous_membrane.hpp"

#include "core/mesh/pairs.hpp"
#include "core/ply/element_limits.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

constexpr double rate_share = 0.01; // of the stroke: over which told rates are smoothed
const double root_of_weight = std::sqrt(deviation_weight);

/// A branch in a step: those of a crossing depend on dt alone where nothing changes the law.
struct BranchStep {
  MaxwellStep step;
  double modulus; ///< G, N mm
};
using BranchSteps = std::vector<BranchStep>;

void find_branch_steps(const ViscousShear& law, double dt, double by, BranchSteps& steps) {
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
double move_torques(const ViscousCrossing& c, const BranchSteps& steps, const Strain& s,
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

double sum_of_torques(const ViscousCrossing& c, const double* q) {
  double sum = 0.0;
  for (std::size_t k = 0; k <= c.law.branches.size(); ++k)
    sum += q[3 * k];
  return sum;
}

/// Smooths a rate over some time, and keeps the largest.
void smooth_rate(double change, double dt, double time, const double* now, double* next) {
  next[0] = now[0] + dt / (dt + time) * (change / dt - now[0]);
  next[1] = std::max(now[1], std::abs(next[0]));
}

/// Takes the state of a crossing in a triangle over a step. X: at its end. torque: Q of each X.
/// Returns what is lost, N mm a cell.
double step_crossing(const ViscousCrossing& c, const MembraneCrossing& of, const BranchSteps& steps,
                     double dt, double factor, const std::array<double, 3>& X, const double* now,
                     double* next, std::array<double, 3>& torque) {
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
double step_sheet(const ViscousSheet& sheet, const Membrane& m, const AxesState& axes, double dt,
                  double factor, double area, const double* now, double* next, ElementForce& q) {
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

void find_group(const Membrane& m, std::span<const Vec3> x, int group, ViscousGroup& g) {
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
ElementForce force_of(const ViscousMembrane& v, const Membrane& m, const TriangleState& t,
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
void step_group(const ViscousMembrane& v, const Membrane& m, const ViscousGroup& g,
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

} // namespace

std::optional<ViscousMembrane> make_viscous(Membrane& m, double stroke) {
  ViscousMembrane v;
  for (std::size_t c = 0; c < m.crossings.size(); ++c) {
    MembraneCrossing& of = m.crossings[c];
    const std::optional<ViscousShear>& law = m.fabric.crossings[c].viscous;
    if (!law) continue;
    const auto stiffness = [&](std::size_t a) {
      return m.families[a].density * m.families[a].yarn.largest_slope();
    };
    const double k = std::min(stiffness(of.first), stiffness(of.second)) / of.cells;
    of.branches = law->instant_modulus();
    if (law->has_dashpot())
      of.spring = spring_share * k, of.deviation_spring = deviation_share / deviation_weight * k;
    v.crossings.push_back({c, *law, v.states, rate_share * stroke});
    v.states = v.crossings.back().end();
  }
  if (const std::optional<ViscousMatrix>& melt = m.fabric.matrix) {
    const double h = m.fabric.thickness;
    v.sheet = ViscousSheet{melt->longitudinal * h, 4.0 * melt->transverse * h, v.states,
                           rate_share * stroke};
    v.states = v.sheet->end();
    for (const MembraneFamily& family : m.families)
      m.matrix_spring += matrix_spring_share * family.density * family.yarn.largest_slope();
  }
  if (v.crossings.empty() && !v.sheet) return std::nullopt;
  return v;
}

void viscous_forces(const ViscousMembrane& v, const Membrane& m, std::span<const Vec3> x, double dt,
                    int begin, int end, const ViscousStates& states, std::span<ElementForce> q) {
  std::vector<BranchSteps> steps(v.crossings.size());
  for (std::size_t k = 0; k < steps.size(); ++k)
    find_branch_steps(v.crossings[k].law, dt, 1.0, steps[k]);
  ViscousGroup g;
  for (int p = begin; p < end; ++p) {
    find_group(m, x, p, g);
    step_group(v, m, g, steps, dt, states, q);
  }
}

ViscousEnergy viscous_energy(const ViscousMembrane& v, const Membrane& m,
                             std::span<const double> states) {
  ViscousEnergy sum;
  for (std::size_t e = 0; e < m.triangles.size(); ++e) {
    const double* state = states.data() + e * v.states;
    sum.lost += state[0];
    for (const ViscousCrossing& c : v.crossings) {
      const MembraneCrossing& of = m.crossings[c.crossing];
      const double* q = state + c.state + 3;
      double stored = 0.0;
      for (std::size_t i = 0; i < 3; ++i) {
        const double spring = i == 0 ? of.spring : of.deviation_spring;
        if (spring > 0.0) stored += 0.5 * q[i] * q[i] / spring;
        for (std::size_t k = 0; k < c.law.branches.size(); ++k)
          stored += 0.5 * q[3 * (k + 1) + i] * q[3 * (k + 1) + i] / c.law.branches[k].modulus;
      }
      sum.stored += m.area[e] * of.cells * stored;
    }
    if (v.sheet) {
      const double* n = state + v.sheet->state + 3;
      sum.stored += 0.5 * m.area[e] * (n[0] * n[0] + n[1] * n[1]) / m.matrix_spring;
    }
  }
  return sum;
}

ShownRate shown_rate(const ViscousMembrane& v, const Membrane& m, std::span<const double> states,
                     std::size_t e) {
  const double* state = states.data() + e * v.states;
  if (v.crossings.empty())
    return {state[v.sheet->rates()], state[v.sheet->rates() + 1], state[v.sheet->state + 3]};
  const ViscousCrossing& c = v.crossings.front();
  return {state[c.rates()], state[c.rates() + 1],
          m.crossings[c.crossing].cells * sum_of_torques(c, state + c.state + 3)};
}

double lag_of(const ViscousMembrane& v, const Membrane& m, double rate) {
  double lag = 0.0;
  for (const ViscousCrossing& c : v.crossings)
    for (int i = 0; i <= 9 && c.law.has_dashpot(); ++i)
      lag = std::max(lag, c.law.torque(0.25 * M_PI * i / 9.0, rate) / rate /
                              m.crossings[c.crossing].spring);
  if (v.sheet) lag = std::max(lag, std::max(v.sheet->shear, v.sheet->apart) / m.matrix_spring);
  return lag;
}

} // namespace plyform
