// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solver/element_mass_scaling.hpp"

#include "core/solver/omega_cap.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace plyform {
namespace {

/// Of the usual triangle's area: a triangle of one bisection less has half of it.
constexpr double small_share = 0.75;

/// The area (mm^2) of the triangle in which the middle of the mass is, triangles in order of size.
double usual_area(const Membrane& m) {
  std::vector<double> areas = m.area;
  std::sort(areas.begin(), areas.end());
  double left = 0.5 * std::accumulate(areas.begin(), areas.end(), 0.0);
  for (const double area : areas)
    if ((left -= area) <= 0.0) return area;
  return areas.back();
}

/// Per triangle, 1 where it is small.
std::vector<char> small_triangles(const Membrane& m) {
  const double most = small_share * usual_area(m);
  std::vector<char> small;
  for (const double area : m.area)
    small.push_back(static_cast<char>(area < most));
  return small;
}

/// Of omega^2: what would fall by less is left as it is, so that free meshes, whose elements differ
/// a little, keep their masses for steps that would be 5 % longer at most.
constexpr double least_fall = 1.1;

Bending bending_of(const PlyBody& ply) {
  std::vector<Vec2> x;
  for (const Vec3& p : ply.x0)
    x.push_back(p.head<2>());
  const Membrane& m = ply.membrane;
  const MaterialAxes axes = material_axes(m.fabric);
  return make_bending(x, m.triangles, ply.bending->law, ply.angle + axes.first,
                      ply.angle + axes.second, m.node_mass, ply.planes);
}

/// w_e of (E).
std::vector<double> element_frequencies(const PlyBody& ply, const std::optional<Bending>& b) {
  const Membrane& m = ply.membrane;
  std::vector<double> of = group_omega2(m, ply.x);
  const double whole = kink_factor(m) * highest_omega2(ply.bound, eigenvalue_ratio(m, ply.x));
  const double scale = whole / *std::max_element(of.begin(), of.end());
  for (double& omega2 : of)
    omega2 *= scale;
  if (!b || !(b->omega2 > 0.0)) return of;
  const std::vector<double> bent = stencil_omega2(*b, m.node_mass);
  const double bent_scale = b->omega2 / *std::max_element(bent.begin(), bent.end());
  for (std::size_t e = 0; e < of.size(); ++e) {
    const auto& [p, q, r] = m.triangles[e];
    of[e] += bent_scale * std::max({bent[p], bent[q], bent[r]});
  }
  return of;
}

/// What is needed to give a ply mass; without small triangles all but omega2 is empty.
struct Grading {
  std::vector<char> small;
  std::optional<Bending> bending;
  std::vector<double> omega2; ///< w_e of (E)
};

Grading grading_of(const PlyBody& ply) {
  Grading of{small_triangles(ply.membrane), std::nullopt, {}};
  if (ply.bending) of.bending = bending_of(ply);
  of.omega2 = element_frequencies(ply, of.bending);
  return of;
}

/// kappa of (E) for one ply.
double cap_of(const PlyBody& ply, const Grading& of, double share) {
  const Membrane& m = ply.membrane;
  double least = 0.0;
  for (std::size_t e = 0; e < m.area.size(); ++e)
    if (!of.small[e]) least = std::max(least, of.omega2[e]);
  std::vector<StiffMass> stiff;
  double cloth = 0.0;
  for (std::size_t e = 0; e < m.area.size(); ++e) {
    const double mass = m.fabric.surface_density * m.area[e];
    cloth += mass;
    if (of.small[e] && of.omega2[e] > least) stiff.push_back({of.omega2[e] * mass, mass});
  }
  return stiff.empty() ? least : lowest_cap(std::move(stiff), least, share * cloth).omega2;
}

void add_mass(PlyBody& ply, const Grading& of, double kappa) {
  Membrane& m = ply.membrane;
  std::vector<double> factor(m.triangles.size(), 1.0);
  bool any = false;
  for (std::size_t e = 0; e < factor.size(); ++e)
    if (of.small[e] && of.omega2[e] > kappa) {
      factor[e] = of.omega2[e] / kappa, any = true;
      for (const int n : m.triangles[e])
        m.node_mass[n] += m.fabric.surface_density * m.area[e] / 3.0 * (factor[e] - 1.0);
    }
  if (!any) return;
  m.density_factor = std::move(factor);
  ply.mass = m.node_mass;
  if (ply.bending) ply.bending->omega2 = bending_omega2(*of.bending, m.node_mass);
}

} // namespace

void scale_element_masses(const Case& data, std::vector<PlyBody>& plies) {
  const double share = data.solver.element_mass_scaling;
  if (share == 0.0) return;
  std::vector<Grading> gradings(plies.size());
  double kappa = 0.0, before = 0.0;
  for (std::size_t p = 0; p < plies.size(); ++p) {
    if (plies[p].left_alone) continue;
    gradings[p] = grading_of(plies[p]);
    const std::vector<double>& omega2 = gradings[p].omega2;
    before = std::max(before, *std::max_element(omega2.begin(), omega2.end()));
    kappa = std::max(kappa, cap_of(plies[p], gradings[p], share));
  }
  if (before < least_fall * kappa) return;
  for (std::size_t p = 0; p < plies.size(); ++p)
    if (!plies[p].left_alone) add_mass(plies[p], gradings[p], kappa);
}

double added_element_mass(const Membrane& m) {
  if (m.density_factor.empty()) return 0.0;
  double added = 0.0, cloth = 0.0;
  for (std::size_t n = 0; n < m.node_mass.size(); ++n) {
    cloth += m.cloth_mass(n);
    added += m.node_mass[n] - m.cloth_mass(n);
  }
  return added / cloth;
}

double largest_added_element_mass(const Layup& layup) {
  double share = 0.0;
  for (const PlyBody& ply : layup.plies)
    share = std::max(share, added_element_mass(ply.membrane));
  return share;
}

double effective_mass_factor(const Layup& layup) {
  double most = 1.0;
  for (const PlyBody& ply : layup.plies) {
    const Membrane& m = ply.membrane;
    double cubes = 0.0, area = 0.0;
    for (std::size_t e = 0; e < m.density_factor.size(); ++e) {
      const double factor = m.density_factor[e];
      cubes += m.area[e] * factor * factor * factor;
      area += m.area[e];
    }
    if (area > 0.0) most = std::max(most, std::cbrt(cubes / area));
  }
  return most;
}

} // namespace plyform
