// SPDX-License-Identifier: GPL-3.0-or-later
// (E), (N) and (Q) of core/ply/membrane.hpp, one strain group after the other.
#include "core/mesh/pairs.hpp"
#include "core/ply/element_limits.hpp"
#include "core/ply/in_plane_law.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

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

/// Stabilisation and collapse penalty of (N) for one family, N.
double side_tension(const SideStiffness& side, double lambda, double mean) {
  return side.stabilisation * (lambda - mean) -
         side.collapse_penalty * std::max(0.0, collapse_stretch - lambda);
}

/// Energy of stabilisation and collapse penalty per yarn length, N.
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

/// (Q) of all triangles of a group. n1, n2: W_a'(mean eps_a) of (N) with the viscous tension, N.
void group_forces(const Membrane& m, const GroupState& s, double n1, double n2,
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

/// (Q) of groups [begin, end).
GroupReport yarn_forces(const Membrane& m, std::span<const Vec3> x, double dt, int begin, int end,
                        const LawStates<YarnMemory>& states, std::span<ElementForce> q) {
  const double d1 = m.fabric.warp_density, d2 = m.fabric.weft_density;
  const AnyYarnLaw warp = m.law(0), weft = m.law(1);
  const double per_dt = dt > 0.0 ? 1.0 / dt : 0.0;
  GroupReport report;
  for (int p = begin; p < end; ++p) {
    const GroupState s = group_state(m, x, p);
    const YarnMemory& now = states.begin[at(p)];
    YarnMemory& next = states.end[at(p)];
    const LawAnswer one =
        answer_of(warp, m.input(s.mean1 - 1.0, per_dt), now[0].data(), next[0].data());
    const LawAnswer two =
        answer_of(weft, m.input(s.mean2 - 1.0, per_dt), now[1].data(), next[1].data());
    report.lost += s.area * (d1 * one.lost + d2 * two.lost);
    group_forces(m, s, one.value, two.value, q);
    for (std::size_t i = 0; i < static_cast<std::size_t>(s.size); ++i)
      report.collapsed |= collapsed(s.triangle[i]);
  }
  return report;
}

/// (E).
MembraneEnergy yarn_energy(const Membrane& m, std::span<const Vec3> x,
                           std::span<const YarnMemory> states, double dt) {
  MembraneEnergy sum;
  const double d1 = m.fabric.warp_density, d2 = m.fabric.weft_density;
  const double per_dt = dt > 0.0 ? 1.0 / dt : 0.0;
  std::vector<YarnMemory> start;
  if (states.empty()) start = memory_at_start(m), states = start;
  const auto stored = [&](std::size_t family, double mean, const YarnMemory& now) {
    YarnMemory next{}; // of no use: this is no step
    return answer_of(m.law(family), m.input(mean - 1.0, per_dt), now[family].data(),
                     next[family].data())
        .stored;
  };
  for (int p = 0; p < m.groups(); ++p) {
    const GroupState s = group_state(m, x, p);
    sum.fibre +=
        s.area * (d1 * stored(0, s.mean1, states[at(p)]) + d2 * stored(1, s.mean2, states[at(p)]));
    for (int i = 0; i < s.size; ++i) {
      const FibreState& t = s.triangle[i];
      const double area = m.area[s.begin + i];
      sum.fibre += area * (d1 * side_energy(m.side[0], t.lambda1, s.mean1) +
                           d2 * side_energy(m.side[1], t.lambda2, s.mean2));
      sum.shear +=
          area * m.cells_per_area * m.fabric.shear.at(shear_measure(t, s.mean1, s.mean2)).energy;
    }
  }
  return sum;
}

} // namespace

const InPlaneLaw yarns_in_plane{true, yarn_forces, yarn_energy, nullptr};

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
    warp = m.yarn[0].at(warp).value;
    weft = m.yarn[1].at(weft).value;
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

} // namespace plyform
