// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/ply/bending.hpp"

#include "base/lanczos.hpp"
#include "core/ply/bending_fit.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace plyform {
namespace {

/// Bound of omega^2, 1/s^2, of nodes that move along one common direction, with the curvatures of
/// that motion and the stiffnesses (N mm) of(stencil); Lanczos' iteration. root: of the masses,
/// t^1/2. across: the planes of symmetry, as bits, that the direction is normal to, so that images
/// there move the other way.
template <class Of>
double largest_omega2(const Bending& b, const Eigen::VectorXd& root, unsigned across,
                      const Of& of) {
  const auto sign = [&](std::int32_t n) {
    const auto i = static_cast<std::size_t>(n);
    if (i < b.area.size()) return 1.0;
    const auto bits = static_cast<unsigned>(b.images[i - b.area.size()].mirror) & across;
    return std::popcount(bits) % 2 == 1 ? -1.0 : 1.0;
  };
  const auto apply = [&](const Eigen::VectorXd& v) { // M^-1/2 K M^-1/2
    const Eigen::VectorXd y = v.cwiseQuotient(root);
    Eigen::VectorXd force = Eigen::VectorXd::Zero(v.size());
    for (std::size_t e = 0; e < b.area.size(); ++e) {
      const auto begin = static_cast<std::size_t>(b.begin[e]),
                 end = static_cast<std::size_t>(b.begin[e + 1]);
      std::array<double, 3> kappa{};
      for (std::size_t i = begin; i < end; ++i) {
        const double moved = sign(b.node[i]) * y[static_cast<Eigen::Index>(b.of_ply(b.node[i]))];
        for (std::size_t k = 0; k < 3; ++k)
          kappa[k] += b.b[i][k] * moved;
      }
      const Eigen::Matrix3d d = of(e);
      std::array<double, 3> moment{};
      for (std::size_t k = 0; k < 3; ++k)
        moment[k] = d(static_cast<Eigen::Index>(k), 0) * kappa[0] +
                    d(static_cast<Eigen::Index>(k), 1) * kappa[1] +
                    d(static_cast<Eigen::Index>(k), 2) * kappa[2];
      for (std::size_t i = begin; i < end; ++i) {
        double& on = force[static_cast<Eigen::Index>(b.of_ply(b.node[i]))];
        for (std::size_t k = 0; k < 3; ++k)
          on += sign(b.node[i]) * (b.area[e] * b.b[i][k] * moment[k]);
      }
    }
    return Eigen::VectorXd(force.cwiseQuotient(root));
  };
  Eigen::VectorXd start(root.size());
  RandomNumbers scatter;
  for (double& value : start)
    value = scatter.next();
  return upper_bound(largest_ritz_value(apply, start, ritz_steps));
}

/// D_g of the families at a node, N mm; none without in-plane bending.
std::span<const double> in_plane_at(const Bending& b, std::size_t node) {
  const std::size_t families = b.law.families.size();
  return b.in_plane.empty() ? std::span<const double>()
                            : std::span(b.in_plane).subspan(node * families, families);
}

/// kappa_f of (K).
double family_curvature(const FamilyBending& family, const std::array<double, 3>& kappa) {
  const Vec3 p = family.of_axes();
  return p[0] * kappa[0] + p[1] * kappa[1] + p[2] * kappa[2];
}

/// Stiffness (N mm) of the families in their plane at a node against the second derivatives along
/// the axes.
Eigen::Matrix3d in_plane_stiffness(const Bending& b, std::size_t node) {
  Eigen::Matrix3d d = Eigen::Matrix3d::Zero();
  for (std::size_t a = 0; a < b.law.families.size(); ++a) {
    const Vec3 p = b.law.families[a].of_axes();
    d += in_plane_at(b, node)[a] * (p * p.transpose());
  }
  return d;
}

} // namespace

Bending make_bending(std::span<const Vec2> x, const std::vector<Triangle>& triangles,
                     const BendingLaw& law, double axis1, double axis2,
                     std::span<const double> node_mass, const std::vector<SymmetryPlane>& planes) {
  Bending b;
  b.law = law;
  fit_stencils(b, x, triangles, axis1, axis2, planes);
  b.omega2 = bending_omega2(b, node_mass);
  return b;
}

double bending_omega2(const Bending& b, std::span<const double> node_mass) {
  // In a flat sheet out-of-plane and in-plane motions are not coupled, so the larger of the two is
  // enough. In the plane all families are taken to bend along the same direction, which they
  // approach in a sheared ply: there they are coupled the most.
  const Eigen::VectorXd root = Eigen::Map<const Eigen::VectorXd>(
                                   node_mass.data(), static_cast<Eigen::Index>(node_mass.size()))
                                   .cwiseSqrt();
  const Eigen::Matrix3d across = b.law.largest_stiffness();
  double found = largest_omega2(b, root, 0, [&](std::size_t) { return across; });
  // in the plane along that of symmetry and normal to it, with two planes normal to either
  const unsigned directions = b.mirrors.empty() ? 1 : 2, first = b.mirrors.size() > 2 ? 1 : 0;
  for (unsigned k = first; !b.in_plane.empty() && k < first + directions; ++k)
    found = std::max(
        found, largest_omega2(b, root, k, [&](std::size_t e) { return in_plane_stiffness(b, e); }));
  return found;
}

std::vector<double> stencil_omega2(const Bending& b, std::span<const double> node_mass) {
  std::vector<double> omega2;
  for (std::size_t n = 0; n < b.area.size(); ++n) {
    // squares of the constants of `of`, a combination of B_11, B_22 and B_12, over the masses
    const auto squares = [&](const Vec3& of) {
      double sum = 0.0;
      for (auto i = static_cast<std::size_t>(b.begin[n]);
           i < static_cast<std::size_t>(b.begin[n + 1]); ++i) {
        const double constant = of[0] * b.b[i][0] + of[1] * b.b[i][1] + of[2] * b.b[i][2];
        sum += constant * constant / node_mass[b.of_ply(b.node[i])];
      }
      return sum;
    };
    double sheet = 0.0, plane = 0.0;
    for (const FamilyBending& family : b.law.families)
      sheet += family.law.largest_slope() * squares(family.of_axes());
    sheet += b.law.twist * squares(Vec3::UnitZ());
    for (std::size_t a = 0; a < b.law.families.size() && !b.in_plane.empty(); ++a)
      plane += in_plane_at(b, n)[a] * squares(b.law.families[a].of_axes());
    omega2.push_back(b.area[n] * std::max(sheet, plane));
  }
  return omega2;
}

void set_normal(StencilShape& s, const Vec3& sum) {
  s.size = sum.norm();
  s.normal = sum / s.size;
  for (std::size_t k = 0; k < 3; ++k)
    s.kappa[k] = s.normal.dot(s.second[k]); // (K)
}

YarnCurvature yarn_curvature(const StencilShape& s, const FamilyBending& family, double stiffness) {
  YarnCurvature t;
  const Vec3 p = family.of_axes(),
             second = p[0] * s.second[0] + p[1] * s.second[1] + p[2] * s.second[2];
  const Vec3 c = s.normal.cross(family.along.x() * s.first[0] + family.along.y() * s.first[1]);
  constexpr double least = 1e-12; // lower limit of l^2, below which a yarn has no direction
  const double l2 = std::max(least, c.squaredNorm());
  t.across = c / l2;
  t.kappa = second.dot(t.across);
  t.slope = second / l2 - 2.0 * t.kappa * t.across;
  t.moment = stiffness * t.kappa;
  return t;
}

double bending_energy(const BendingLaw& law, std::span<const double> in_plane,
                      const StencilShape& s) {
  const std::array<double, 3>& k = s.kappa;
  double sum = 0.0;
  for (const FamilyBending& family : law.families)
    sum += family.law.at(family_curvature(family, k)).energy;
  sum = sum + law.coupling * k[0] * k[1] + 0.5 * law.twist * k[2] * k[2]; // (E)
  for (std::size_t a = 0; a < in_plane.size(); ++a)
    if (in_plane[a] > 0.0) {
      const YarnCurvature t = yarn_curvature(s, law.families[a], in_plane[a]);
      sum += 0.5 * t.moment * t.kappa; // (G)
    }
  return sum;
}

} // namespace plyform
