// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/ply/membrane_eigenvalue.hpp"

#include "core/ply/element_limits.hpp"
#include "core/ply/mass_normalise.hpp"
#include "core/ply/membrane_crimp.hpp"

#include <Eigen/Eigenvalues>
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

/// Largest eigenvalue of K_ab = sqrt(k_a k_b) (v_a . G v_b) cos(f_a, f_b), that of the families'
/// part of H (G x I) with stiffnesses k (N/mm); N/mm^3 for a Gram matrix in 1/mm^2.
double largest_of_families(const Membrane& m, const TriangleState& t, const Gram& g,
                           const OfFamilies& k) {
  const std::size_t n = m.families.size();
  const auto entry = [&](std::size_t a, std::size_t b) {
    const Vec2 &v = m.families[a].along, &w = m.families[b].along;
    const double vgw =
        v.x() * w.x() * g.g11 + v.y() * w.y() * g.g22 + (v.x() * w.y() + v.y() * w.x()) * g.g12;
    return a == b ? k[a] * vgw : std::sqrt(k[a] * k[b]) * vgw * t.yarn[a].f.dot(t.yarn[b].f);
  };
  if (n == 0) return 0.0;
  if (n == 1) return entry(0, 0);
  if (n == 2) return largest(entry(0, 0), entry(1, 1), entry(1, 0));
  constexpr int most = static_cast<int>(most_families);
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most, most> matrix(n, n);
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = 0; b <= a; ++b)
      matrix(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b)) = entry(a, b);
  return Eigen::SelfAdjointEigenSolver<decltype(matrix)>(matrix, Eigen::EigenvaluesOnly)
      .eigenvalues()
      .maxCoeff();
}

/// Stiffness of the families per area, N/mm, in tension or in compression, whichever is stiffer.
/// Those of a crimped cell are at most as stiff as if they were straight and nothing gave way, each
/// by itself (core/model/crimp.hpp), and can be pressed while the cell pulls them.
OfFamilies yarn_stiffness(const Membrane& m) {
  OfFamilies k{};
  for (std::size_t a = 0; a < m.families.size(); ++a) {
    const MembraneFamily& f = m.families[a];
    const double pulled = bound_of(f.law()).slope;
    k[a] = f.density * std::max(pulled, f.yarn.compression + f.side.collapse_penalty);
  }
  return k;
}

/// N, LawBound::unrelaxed of each family.
OfFamilies unrelaxed(const Membrane& m) {
  OfFamilies k{};
  for (std::size_t a = 0; a < m.families.size(); ++a)
    k[a] = bound_of(m.families[a].law()).unrelaxed;
  return k;
}

/// Stiffness per area of the deviations within a group, N/mm.
OfFamilies deviation_stiffness(const Membrane& m, const TriangleState& t) {
  OfFamilies k{};
  for (std::size_t a = 0; a < m.families.size(); ++a)
    k[a] = m.families[a].density * m.families[a].side.stabilisation;
  for (std::size_t i = 0; i < m.crossings.size(); ++i) {
    const MembraneCrossing& c = m.crossings[i];
    const double shear = deviation_stiffness(c, t.crossing[i].gamma) +
                         deviation_weight * c.cells * (c.deviation_spring + c.branches);
    k[c.first] += shear, k[c.second] += shear;
  }
  return k;
}

Gram gram(const AxesGradients& c) {
  const double c10 = -c.c11 - c.c12, c20 = -c.c21 - c.c22;
  return {c10 * c10 + c.c11 * c.c11 + c.c12 * c.c12, c20 * c20 + c.c21 * c.c21 + c.c22 * c.c22,
          c10 * c20 + c.c11 * c.c21 + c.c12 * c.c22};
}

/// 3/rho of a triangle, mm^2/t: over its area the inverse of the mass that it gives each corner.
double corners_per_mass(const Membrane& m, std::size_t e) {
  const double per_mass = 3.0 / m.fabric.surface_density;
  return m.density_factor.empty() ? per_mass : per_mass / m.density_factor[e];
}

/// Largest eigenvalue of sum_a v_a v_a^T over the two families of a crossing: 1 for the axes.
double largest_of_crossing(const Membrane& m, const MembraneCrossing& c) {
  const Vec2 &v = m.families[c.first].along, &w = m.families[c.second].along;
  return largest(v.x() * v.x() + w.x() * w.x(), v.y() * v.y() + w.y() * w.y(),
                 v.x() * v.y() + w.x() * w.y());
}

/// Shear and geometric part of H (see eigenvalue_bound), N/mm, bounded by norms; the second
/// derivative of the angle is below 2/sin(omega) (1/lambda_a^2 + 1/lambda_b^2). unrelaxed: N, of
/// each family.
double soft_stiffness(const Membrane& m, const TriangleState& t, const OfFamilies& unrelaxed) {
  std::array<double, 2> pull{}; // of families along the axes
  double oblique = 0.0;         // of the others
  OfFamilies strain{};
  for (std::size_t a = 0; a < m.families.size(); ++a)
    strain[a] = t.yarn[a].lambda - 1.0;
  const OfFamilies tension = elastic_tensions(m, strain);
  for (std::size_t a = 0; a < m.families.size(); ++a) {
    const MembraneFamily& f = m.families[a];
    const double lambda = t.yarn[a].lambda;
    // what relaxes pulls as if it had not yet
    const double pulled = tension[a] + unrelaxed[a] * std::max(0.0, strain[a]);
    const double n = std::max(0.0, f.density * pulled / lambda);
    if (f.along == Vec2::UnitX())
      pull[0] += n;
    else if (f.along == Vec2::UnitY())
      pull[1] += n;
    else
      oblique += n * f.along.squaredNorm();
  }
  double sum = std::max(pull[0], pull[1]) + oblique;
  for (std::size_t i = 0; i < m.crossings.size(); ++i) {
    const MembraneCrossing& c = m.crossings[i];
    const double lambda1 = t.yarn[c.first].lambda, lambda2 = t.yarn[c.second].lambda;
    const double gamma = t.crossing[i].gamma, torque = c.stiffest * c.shear.at(gamma).value;
    const double inv2 = 1.0 / (lambda1 * lambda1) + 1.0 / (lambda2 * lambda2);
    // a branch pulls as if it had not yet relaxed; springs of dashpots are hardly stretched
    const double turned = std::abs(torque) + c.branches * std::abs(gamma);
    sum += (c.is_axes ? 1.0 : largest_of_crossing(m, c)) * c.cells * inv2 *
           (std::abs(shear_slope(c, gamma)) + (c.spring + c.branches) +
            2.0 * turned / t.crossing[i].sin_omega);
  }
  return sum;
}

/// Bound of the part of the sheet's law in H (G x I), N/mm^3.
double sheet_stiffness(const Membrane& m, const AxesState& s, const Gram& g) {
  if (!m.fabric.sheet) return 0.0;
  const double x = m.across.x(), y = m.across.y();
  const Gram turned{g.g11, x * x * g.g11 + 2.0 * x * y * g.g12 + y * y * g.g22,
                    x * g.g11 + y * g.g12};
  const Vec3 across = x * s.k1() + y * s.k2();
  return std::visit([&](const auto& law) { return law.stiffness_bound(s.k1(), across, turned); },
                    *m.fabric.sheet);
}

/// Bound of the part of a melt's springs in H (G x I), N/mm^3: gradients in space are at most those
/// before over the least stretch, and shear of d_ab + d_ba counts twice.
double matrix_stiffness(const Membrane& m, const AxesState& s, const Gram& g) {
  if (!(m.matrix_spring > 0.0)) return 0.0;
  const Vec3 k1 = s.k1(), k2 = m.across.x() * k1 + m.across.y() * s.k2();
  const double a = k1.squaredNorm(), b = k2.squaredNorm(), c = k1.dot(k2);
  const double least2 = std::max(0.0, a * b - c * c) / largest(a, b, c); // of stretches
  return 3.0 * m.matrix_spring * largest(g.g11, g.g22, g.g12) /
         std::max(least_stretch * least_stretch, least2);
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
    const AxesGradients& c = m.c[e];
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
  double area = 0.0, soft = 0.0;
  const OfFamilies to_relax = unrelaxed(m);
  TriangleState t;
  for (auto e = static_cast<std::size_t>(m.group_begin[p]);
       e < static_cast<std::size_t>(m.group_begin[p + 1]); ++e) {
    find_triangle(m, x, static_cast<int>(e), t);
    const Gram of = gram(m.c[e]);
    soft = std::max(soft, corners_per_mass(m, e) *
                              (sheet_stiffness(m, t.axes, of) + matrix_stiffness(m, t.axes, of) +
                               soft_stiffness(m, t, to_relax) * largest(of.g11, of.g22, of.g12)));
    area += m.area[e];
  }
  return largest_of_families(m, t, g, yarn_stiffness(m)) / area + soft;
}

} // namespace

EigenvalueBound eigenvalue_bound(const Membrane& m, std::span<const Vec3> x) {
  // K_e = A0 B^T H B with B = [c_1; c_2] x I. Its non-zero eigenvalues are those of H (G x I),
  // and each node has a mass of at least rho A0 / 3: so omega^2 <= 3/rho times the largest of them.
  // The fibre part of H, sum_a k_a (v_a v_a^T) x (f_a f_a^T), is exact. The sheet's law has a part
  // of its own (core/model/sheet_law.hpp); where there are yarns it counts as soft.
  EigenvalueBound bound;
  const OfFamilies yarns = yarn_stiffness(m), to_relax = unrelaxed(m);
  OfFamilies viscosity{}, penalty{};
  for (std::size_t a = 0; a < m.families.size(); ++a) {
    const MembraneFamily& f = m.families[a];
    viscosity[a] = f.density * f.viscosity;
    penalty[a] = f.density * f.side.collapse_penalty;
    if (yarns[a] > 0.0) bound.viscous = std::max(bound.viscous, viscosity[a] / yarns[a]);
  }
  // the collapse penalty of a triangle adds to the stiffness of the taut yarns of its pair
  const bool paired = is_paired(m);
  constexpr double considerable = 0.2; // of the yarn stiffness: step_factor covers less
  TriangleState t;
  for (std::size_t e = 0; e < m.triangles.size(); ++e) {
    const double per_mass = corners_per_mass(m, e);
    const Gram g = gram(m.c[e]);
    find_triangle(m, x, static_cast<int>(e), t);
    OfFamilies k = deviation_stiffness(m, t);
    for (std::size_t a = 0; a < m.families.size(); ++a) {
      const MembraneFamily& f = m.families[a];
      const bool folded = t.yarn[a].lambda < collapse_reach;
      k[a] = yarns[a] + k[a] + (paired && folded ? penalty[a] : 0.0);
      bound.penalty_acts =
          bound.penalty_acts ||
          (folded && f.side.collapse_penalty > considerable * f.yarn.largest_slope());
    }
    const double fibre = largest_of_families(m, t, g, k);
    const double viscous = largest_of_families(m, t, g, viscosity);
    const double sheet = sheet_stiffness(m, t.axes, g);
    const bool foil = m.families.empty();
    const double soft = soft_stiffness(m, t, to_relax) * largest(g.g11, g.g22, g.g12) +
                        (foil ? 0.0 : sheet) + matrix_stiffness(m, t.axes, g);
    bound.yarns = std::max(bound.yarns, per_mass * (fibre + (foil ? sheet : 0.0)));
    bound.soft = std::max(bound.soft, per_mass * soft);
    const double omega2 = per_mass * (fibre + (foil ? sheet : 0.0) + soft);
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
    : m_(m), taut_(m.families.size()), q_(m.triangles.size()) {
  const OfFamilies yarns = yarn_stiffness(m);
  const bool paired = is_paired(m);
  for (const MembraneFamily& family : m.families)
    along_.push_back(family.along);
  for (std::size_t a = 0; a < m.families.size(); ++a)
    taut_[a] = stiffness * yarns[a] + damping * m.families[a].density * m.families[a].viscosity;
  rows_.reserve(m.triangles.size() * m.families.size());
  TriangleState t;
  for (std::size_t e = 0; e < m.triangles.size(); ++e) {
    find_triangle(m, x, static_cast<int>(e), t);
    const OfFamilies deviation = deviation_stiffness(m, t);
    for (std::size_t a = 0; a < m.families.size(); ++a) {
      const MembraneFamily& f = m.families[a];
      const bool folded = paired && t.yarn[a].lambda < collapse_reach;
      rows_.push_back({t.yarn[a].f, stiffness * deviation[a],
                       folded ? stiffness * f.density * f.side.collapse_penalty : 0.0});
    }
  }
}

template <std::size_t known>
void YarnStiffness::strain_group(std::span<const Vec3> y, std::size_t group) {
  constexpr std::size_t most = known > 0 ? known : most_families;
  const auto begin = static_cast<std::size_t>(m_.group_begin[group]),
             end = static_cast<std::size_t>(m_.group_begin[group + 1]);
  const std::size_t families = known > 0 ? known : along_.size();
  double area = 0.0;
  std::array<double, most> mean{};
  std::array<std::array<double, most>, most_in_group> strain;
  for (std::size_t e = begin; e < end; ++e) {
    const AxesGradients& c = m_.c[e];
    const Triangle& t = m_.triangles[e];
    const Vec3& y0 = y[t[0]];
    const Vec3 g1 = y[t[1]] - y0, g2 = y[t[2]] - y0;
    const Vec3 k1 = c.c11 * g1 + c.c12 * g2, k2 = c.c21 * g1 + c.c22 * g2;
    area += m_.area[e];
    for (std::size_t a = 0; a < families; ++a) {
      const Vec2& along = along_[a];
      double& own = strain[e - begin][a];
      own = 0.0;
      if (along.x() != 0.0) own += along.x() * rows_[e * families + a].f.dot(k1);
      if (along.y() != 0.0) own += along.y() * rows_[e * families + a].f.dot(k2);
      mean[a] += m_.area[e] * own;
    }
  }
  for (std::size_t a = 0; a < families; ++a)
    mean[a] /= area;
  for (std::size_t e = begin; e < end; ++e) {
    q_[e] = {Vec3::Zero(), Vec3::Zero()};
    for (std::size_t a = 0; a < families; ++a) {
      const Row& row = rows_[e * families + a];
      const double own = strain[e - begin][a];
      const double pull = m_.area[e] * (taut_[a] * mean[a] + row.deviation * (own - mean[a]) +
                                        row.collapse_penalty * own);
      const Vec2& along = along_[a];
      if (along.x() != 0.0) q_[e].q1 += (along.x() * pull) * row.f;
      if (along.y() != 0.0) q_[e].q2 += (along.y() * pull) * row.f;
    }
  }
}

void YarnStiffness::add_to(std::span<const Vec3> y, std::span<Vec3> f) {
  for (std::size_t p = 0; p < static_cast<std::size_t>(m_.groups()); ++p)
    along_.size() == 2 ? strain_group<2>(y, p) : strain_group<0>(y, p);
  for (std::size_t n = 0; n < f.size(); ++n)
    f[n] -= node_force(m_, q_, static_cast<int>(n));
}

Eigen::VectorXd scattered_motion(const Membrane& m, std::span<const Vec3> x) {
  Eigen::VectorXd v(static_cast<Eigen::Index>(3 * x.size()));
  RandomNumbers scatter;
  for (std::size_t n = 0; n < x.size(); ++n) {
    const int triangle = m.gather[m.gather_begin[n]] / 3;
    const AxesState s = axes_state(m, x, triangle);
    const double along1 = scatter.next(), along2 = scatter.next(), across = scatter.next();
    v.segment<3>(static_cast<Eigen::Index>(3 * n)) =
        along1 * s.f1 + along2 * s.f2 + across * s.f1.cross(s.f2);
  }
  return v;
}

double eigenvalue_ratio(const Membrane& m, std::span<const Vec3> x) {
  if (m.families.empty()) return 1.0;
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
  for (const MembraneFamily& family : m.families) {
    const double tension = family.yarn.largest_slope(), compression = family.yarn.compression;
    if (!(tension > 0.0)) continue;
    // of a crimped cell: pressed while the cell pulls it, or not
    const double pressed = family.crimped ? tension + compression : compression;
    const double r = std::min(tension, pressed) / std::max(tension, pressed);
    most = std::max(most, r * (1.0 - r));
  }
  return 1.0 + 0.8 * most; // (R)
}

double highest_omega2(const EigenvalueBound& bound, double eigenvalue_ratio) {
  if (bound.penalty_acts) return bound.omega2;
  return std::min(bound.omega2, eigenvalue_ratio * bound.yarns + bound.soft);
}

} // namespace plyform
