// SPDX-License-Identifier: GPL-3.0-or-later
// (E), (N), (P) and (Q) of core/ply/membrane.hpp, one strain group after the other.
#include "core/mesh/pairs.hpp"
#include "core/ply/element_limits.hpp"
#include "core/ply/membrane_crimp.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

/// The triangles of one group and the mean stretches of the yarns.
struct GroupState {
  int begin, size;
  std::array<TriangleState, most_in_group> triangle;
  double area = 0.0;
  std::array<double, most_families> mean{};
  std::array<double, most_in_group> shear_factor{}; ///< f
};

GroupState group_state(const Membrane& m, std::span<const Vec3> x, int group,
                       std::span<const double> shear_factors = {}) {
  const auto p = static_cast<std::size_t>(group);
  GroupState s;
  s.begin = m.group_begin[p];
  s.size = m.group_begin[p + 1] - s.begin;
  for (int i = 0; i < s.size; ++i) {
    const double area = m.area[s.begin + i];
    TriangleState& t = s.triangle[i];
    find_triangle(m, x, s.begin + i, t);
    s.shear_factor[at(i)] = shear_factors.empty() ? 1.0 : shear_factors[at(s.begin + i)];
    s.area += area;
    for (std::size_t a = 0; a < m.families.size(); ++a)
      s.mean[a] += area * t.yarn[a].lambda;
  }
  for (std::size_t a = 0; a < m.families.size(); ++a)
    s.mean[a] /= s.area;
  return s;
}

/// The mean strains of a group.
OfFamilies mean_strains(const Membrane& m, const GroupState& s) {
  OfFamilies strain{};
  for (std::size_t a = 0; a < m.families.size(); ++a)
    strain[a] = s.mean[a] - 1.0;
  return strain;
}

/// What cells give the families of a group.
std::array<LawPoint, most_families> cells_of(const Membrane& m, const GroupState& s) {
  if (!m.crimped) return {};
  return cell_points(m, mean_strains(m, s));
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

/// Es, p and T of a cell for triangle i of a group.
ShearResponse shear_response(const MembraneCrossing& c, const CrossingState& crossing,
                             const GroupState& s, std::size_t i) {
  const TriangleState& t = s.triangle[i];
  const double d1 = t.yarn[c.first].lambda - s.mean[c.first],
               d2 = t.yarn[c.second].lambda - s.mean[c.second];
  ShearResponse of = c.shear.respond(crossing.gamma, deviation_weight * (d1 * d1 + d2 * d2));
  of.energy *= s.shear_factor[i], of.secant *= s.shear_factor[i], of.torque *= s.shear_factor[i];
  return of;
}

/// The larger of a number of both signs of the shear angle, if they may differ.
template <class Of>
double of_stiffer_side(const ShearLaw& law, double gamma, const Of& of) {
  return law.odd() ? of(gamma) : std::max(of(gamma), of(-gamma));
}

/// The sheet's law with k across the first axis.
SheetResponse sheet_response(const Membrane& m, const AxesState& axes, const Vec3& across) {
  return std::visit([&](const auto& law) { return law.at(axes.k1(), across); }, *m.fabric.sheet);
}

/// k across the first axis: that of the second, if they are at right angles.
Vec3 across_axis(const Membrane& m, const AxesState& axes) {
  return m.across.x() * axes.k1() + m.across.y() * axes.k2();
}

/// Adds the sheet's law to (Q).
void add_sheet(const Membrane& m, const AxesState& axes, double area, ElementForce& q) {
  if (!m.fabric.sheet) return;
  const Vec3 k1 = axes.k1(), k2 = across_axis(m, axes);
  const SheetResponse r = sheet_response(m, axes, k2);
  const Vec3 q2 = area * (r.s12 * k1 + r.s22 * k2);
  q.q1 += area * (r.s11 * k1 + r.s12 * k2) + m.across.x() * q2;
  q.q2 += m.across.y() * q2;
}

/// (Q) of one triangle. n: tensions (N) of its yarns; shear: n_c T (N/mm) of its crossings.
ElementForce triangle_force(const Membrane& m, const TriangleState& t, double area,
                            const OfFamilies& n, const std::array<double, most_crossings>& shear) {
  std::array<Vec3, most_families> p; // (P)
  for (std::size_t a = 0; a < m.families.size(); ++a)
    p[a] = area * m.families[a].density * n[a] * t.yarn[a].f;
  for (std::size_t c = 0; c < m.crossings.size(); ++c) {
    const auto [first, second] = std::pair(m.crossings[c].first, m.crossings[c].second);
    const FamilyState &a = t.yarn[first], &b = t.yarn[second];
    const CrossingState& s = t.crossing[c];
    const double torque = area * shear[c] / s.sin_omega;
    p[first] += torque / a.lambda * (b.f - s.cos_omega * a.f);
    p[second] += torque / b.lambda * (a.f - s.cos_omega * b.f);
  }
  ElementForce q{Vec3::Zero(), Vec3::Zero()};
  for (std::size_t a = 0; a < m.families.size(); ++a) {
    q.q1 += m.families[a].along.x() * p[a];
    q.q2 += m.families[a].along.y() * p[a];
  }
  add_sheet(m, t.axes, area, q);
  return q;
}

/// (Q) of all triangles of a group. n: W_a'(mean eps_a) of (N) with the viscous tension, N.
void group_forces(const Membrane& m, const GroupState& s, const OfFamilies& n,
                  std::span<ElementForce> q) {
  std::array<std::array<double, most_crossings>, most_in_group> shear{};
  std::array<OfFamilies, most_in_group> held{}; // sum_c n_c p delta_a
  OfFamilies mean{};
  for (std::size_t i = 0; i < static_cast<std::size_t>(s.size); ++i) {
    const TriangleState& t = s.triangle[i];
    for (std::size_t c = 0; c < m.crossings.size(); ++c) {
      const MembraneCrossing& of = m.crossings[c];
      const ShearResponse cell = shear_response(of, t.crossing[c], s, i);
      shear[i][c] = of.cells * cell.torque;
      for (const std::size_t a : {of.first, of.second})
        held[i][a] += of.cells * cell.secant * (t.yarn[a].lambda - s.mean[a]);
    }
    const double share = m.area[static_cast<std::size_t>(s.begin) + i] / s.area;
    for (std::size_t a = 0; a < m.families.size(); ++a)
      mean[a] += share * held[i][a];
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(s.size); ++i) {
    const TriangleState& t = s.triangle[i];
    const auto e = static_cast<std::size_t>(s.begin) + i;
    OfFamilies own{};
    for (std::size_t a = 0; a < m.families.size(); ++a) {
      const MembraneFamily& f = m.families[a];
      own[a] = n[a] + side_tension(f.side, t.yarn[a].lambda, s.mean[a]) +
               deviation_weight / f.density * (held[i][a] - mean[a]); // t_a - mean t_a of (N)
    }
    q[e] = triangle_force(m, t, m.area[e], own, shear[i]);
  }
}

/// N, of the yarns of a family in each triangle at these strains with what they remember, after no
/// time.
std::vector<double> remembered_tensions(const Membrane& m, const std::vector<double>& strain,
                                        std::span<const YarnMemory> states, std::size_t family) {
  std::vector<double> tension(strain.size());
  for (int p = 0; p < m.groups(); ++p)
    for (std::size_t e = at(m.group_begin[at(p)]); e < at(m.group_begin[at(p) + 1]); ++e) {
      YarnMemory next{}; // of no use: this is no step
      tension[e] = answer_of(m.families[family].law(), m.input(strain[e], 0.0),
                             states[at(p) * m.families.size() + family].data(), next.data())
                       .value;
    }
  return tension;
}

} // namespace

GroupReport element_forces(const Membrane& m, std::span<const Vec3> x, double dt, int begin,
                           int end, const LawStates<YarnMemory>& states, std::span<ElementForce> q,
                           std::span<const double> shear_factors) {
  const double per_dt = dt > 0.0 ? 1.0 / dt : 0.0;
  GroupReport report;
  for (int p = begin; p < end; ++p) {
    const GroupState s = group_state(m, x, p, shear_factors);
    OfFamilies n{};
    const auto cells = cells_of(m, s);
    for (std::size_t a = 0; a < m.families.size(); ++a) {
      const MembraneFamily& f = m.families[a];
      const std::size_t at_state = at(p) * m.families.size() + a;
      const LawAnswer answer =
          answer_of(f.law(), m.input(s.mean[a] - 1.0, per_dt, cells[a]),
                    states.begin[at_state].data(), states.end[at_state].data());
      n[a] = answer.value;
      (f.stitch ? report.torn : report.lost) += s.area * f.density * answer.lost;
      report.flowed += s.area * f.density * answer.flowed;
    }
    group_forces(m, s, n, q);
    for (std::size_t i = 0; i < static_cast<std::size_t>(s.size); ++i)
      report.collapsed |= collapsed(s.triangle[i].axes);
  }
  return report;
}

MembraneEnergy membrane_energy(const Membrane& m, std::span<const Vec3> x,
                               std::span<const YarnMemory> states, double dt,
                               std::span<const double> shear_factors) {
  MembraneEnergy sum;
  const double per_dt = dt > 0.0 ? 1.0 / dt : 0.0;
  std::vector<YarnMemory> start;
  if (states.empty()) start = memory_at_start(m), states = start;
  for (int p = 0; p < m.groups(); ++p) {
    const GroupState s = group_state(m, x, p, shear_factors);
    const auto cells = cells_of(m, s);
    for (std::size_t a = 0; a < m.families.size(); ++a) {
      const MembraneFamily& f = m.families[a];
      YarnMemory next{}; // of no use: this is no step
      const LawAnswer answer = answer_of(f.law(), m.input(s.mean[a] - 1.0, per_dt, cells[a]),
                                         states[at(p) * m.families.size() + a].data(), next.data());
      (f.stitch ? sum.stitch : sum.fibre) += s.area * f.density * answer.stored;
    }
    for (int i = 0; i < s.size; ++i) {
      const TriangleState& t = s.triangle[i];
      const double area = m.area[s.begin + i];
      for (std::size_t a = 0; a < m.families.size(); ++a)
        sum.fibre += area * m.families[a].density *
                     side_energy(m.families[a].side, t.yarn[a].lambda, s.mean[a]);
      for (std::size_t c = 0; c < m.crossings.size(); ++c) {
        const MembraneCrossing& of = m.crossings[c];
        sum.shear += area * of.cells * shear_response(of, t.crossing[c], s, at(i)).energy;
      }
      if (m.fabric.sheet)
        sum.shear += area * sheet_response(m, t.axes, across_axis(m, t.axes)).energy;
    }
  }
  return sum;
}

double shear_slope(const MembraneCrossing& c, double gamma) {
  if (c.shear.tabulated()) return c.stiffest * c.steepest;
  return c.stiffest *
         of_stiffer_side(c.shear, gamma, [&](double g) { return c.shear.at(g).slope; });
}

double deviation_stiffness(const MembraneCrossing& c, double gamma) {
  const double secant = c.stiffest * of_stiffer_side(c.shear, std::abs(gamma),
                                                     [&](double g) { return c.shear.secant(g); });
  return deviation_weight * std::max(c.cells * shear_slope(c, gamma), c.cells * secant);
}

std::vector<std::vector<double>> yarn_strains(const Membrane& m, std::span<const Vec3> x) {
  std::vector<std::vector<double>> strains(m.families.size(),
                                           std::vector<double>(m.triangles.size()));
  for (int p = 0; p < m.groups(); ++p) {
    const GroupState s = group_state(m, x, p);
    for (std::size_t a = 0; a < m.families.size(); ++a)
      for (int i = 0; i < s.size; ++i)
        strains[a][at(s.begin + i)] = s.mean[a] - 1.0;
  }
  return strains;
}

std::vector<std::vector<double>> yarn_tensions(const Membrane& m, std::span<const Vec3> x,
                                               std::span<const YarnMemory> states) {
  std::vector<std::vector<double>> tensions = yarn_strains(m, x), with_rates(m.families.size());
  for (std::size_t a = 0; a < m.families.size() && !states.empty(); ++a)
    if (has_rates(m.families[a].law()))
      with_rates[a] = remembered_tensions(m, tensions[a], states, a);
  std::vector<std::size_t> paired;
  for (std::size_t p = 0; p + 1 < m.group_begin.size(); ++p)
    for (int e = m.group_begin[p]; e < m.group_begin[p + 1]; ++e)
      if (m.group_begin[p + 1] - m.group_begin[p] > 1) paired.push_back(at(e));
  const int passes = paired.empty() ? 0 : 2;
  std::vector<double> at_node(x.size());
  for (std::size_t e = 0; e < m.triangles.size(); ++e) {
    OfFamilies strain{};
    for (std::size_t a = 0; a < m.families.size(); ++a)
      strain[a] = tensions[a][e];
    const OfFamilies tension = elastic_tensions(m, strain);
    for (std::size_t a = 0; a < m.families.size(); ++a)
      tensions[a][e] = with_rates[a].empty() ? tension[a] : with_rates[a][e];
  }
  for (std::size_t a = 0; a < m.families.size(); ++a) {
    if (m.families[a].stitch) continue; // no multipliers
    for (int pass = 0; pass < passes; ++pass) {
      at_node.assign(x.size(), 0.0);
      for (std::size_t e = 0; e < m.triangles.size(); ++e)
        for (const int n : m.triangles[e])
          at_node[at(n)] += m.area[e] / (3.0 * m.node_area[at(n)]) * tensions[a][e];
      for (const std::size_t e : paired) {
        tensions[a][e] = 0.0;
        for (const int n : m.triangles[e])
          tensions[a][e] += at_node[at(n)] / 3.0;
      }
    }
  }
  return tensions;
}

} // namespace plyform
