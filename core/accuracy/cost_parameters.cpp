// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/accuracy/cost_parameters.hpp"

#include "core/accuracy/error_numbers.hpp"
#include "core/mesh/mesh_blank.hpp"
#include "core/model/boundary.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plyform {
namespace {

// Degrees: meshes from the scene reach no less (docs/users/accuracy.md, graded meshes).
constexpr double least_from_scene = 0.5;

/// The factor of the largest elements by which they become as small as any may.
double smallest_factor(const Case& data) {
  constexpr double thicknesses = 3.0; // no ply bends round less
  double factor = 0.0;
  for (const Ply& ply : data.plies)
    factor = std::max(factor, thicknesses * data.fabrics[ply.fabric].thickness /
                                  data.blanks[ply.blank].element_size);
  return std::min(factor, 1.0);
}

/// Parameters, and what they cost: CPU time over that of the case's own mesh for 1 s and
/// softening 1.
struct CostParameters {
  double coarsening = 1.0, duration = 0.0, softening = 1.0;
  double cost = std::numeric_limits<double>::max();
  double excess = std::numeric_limits<double>::max(); ///< degrees, error beyond the requested one
};

/// The cheapest duration and softening whose squared errors sum to `left2` (degrees^2) at most.
CostParameters cheapest(const ErrorNumbers& n, double left2) {
  CostParameters best;
  constexpr int shares = 200; // values tried for the share of softening; inertia gets the rest
  for (int i = 1; i < shares; ++i) {
    const double share = static_cast<double>(i) / shares;
    const double softening = n.softening_for(std::sqrt(share * left2));
    const double of_softening = n.softening_error(softening);
    const double rest2 = left2 - of_softening * of_softening;
    if (!(rest2 > 0.0)) continue;
    const double duration = n.duration_for(std::sqrt(rest2));
    const double steps = duration / std::sqrt(softening);
    if (steps < best.cost) best = {1.0, duration, softening, steps, 0.0};
  }
  return best;
}

/// The same if one of the two, or both, are fixed at the case's values.
CostParameters cheapest(const ErrorNumbers& n, double left2, const SolverOptions& now,
                        const FixedParameters& fixed) {
  if (!fixed.duration && !fixed.softening) return cheapest(n, left2);
  const auto left_by = [&](double error) {
    return std::sqrt(std::max(left2 - error * error, 0.25 * left2));
  };
  CostParameters parameters{1.0, now.duration, now.fibre_softening, 0.0, 0.0};
  if (!fixed.duration)
    parameters.duration = n.duration_for(left_by(n.softening_error(parameters.softening)));
  if (!fixed.softening)
    parameters.softening = n.softening_for(left_by(n.inertia_error(parameters.duration)));
  parameters.cost = parameters.duration / std::sqrt(parameters.softening);
  return parameters;
}

} // namespace

bool may_coarsen(const Case& data, double by) {
  constexpr double most_thicknesses = 16.0;
  double longest = std::numeric_limits<double>::max();
  for (const Tool& t : data.tools)
    if (const double radius = smallest_rounding(t.shape); radius > 0.0)
      longest = std::min(longest, radius);
  for (const Ply& ply : data.plies) {
    const double thickness = data.fabrics[ply.fabric].thickness;
    BlankSpec blank = data.blanks[ply.blank];
    if (blank.mesh == MeshKind::file) return false;
    scale_elements(blank, by);
    // what goes round a tool are the smallest
    if (smallest_wanted(blank) > std::min(longest, most_thicknesses * thickness)) return false;
    if (!takes_elements(blank)) return false;
  }
  return !hold_by_mesh(data.boundaries); // the nodes that they prescribe depend on the mesh
}

bool may_refine(const Case& data, double by) {
  return !hold_by_mesh(data.boundaries) &&
         std::all_of(data.plies.begin(), data.plies.end(), [&](const Ply& ply) {
           BlankSpec blank = data.blanks[ply.blank];
           scale_elements(blank, by);
           return blank.mesh != MeshKind::file && takes_elements(blank);
         });
}

bool largest_elements_suffice(const Case& data) {
  const double wanted = data.accuracy.shear_error / degree;
  const ErrorNumbers n = error_numbers(data, 1.0);
  constexpr double most = 0.95; // at their limits inertia and softening leave less than the rest
  return wanted > 0.0 && n.inertia_factor > 0.0 && n.mesh_error() <= most * wanted; // NaN: no
}

bool needs_small_elements(const Case& data) {
  const double wanted = data.accuracy.shear_error / degree;
  return wanted > 0.0 && wanted < least_from_scene;
}

double pick_cost_parameters(Case& data, const FixedParameters& fixed) {
  if (!not_measured(data).empty()) return 1.0;
  if (!fixed.element_size && awaits_scene(data) &&
      (largest_elements_suffice(data) || needs_small_elements(data)))
    for (BlankSpec& blank : data.blanks)
      if (blank.mesh_from == mesh_from_scene_word) blank.mesh_from.clear();
  ErrorNumbers n = error_numbers(data, assumed_mass_factor(data));
  const double wanted = data.accuracy.shear_error / degree;
  n.hold_inertia(wanted);
  const bool from_scene = awaits_scene(data);
  if (!(wanted > 0.0) || n.inertia == 0.0) return 1.0;
  const bool keep = fixed.element_size || n.few_ply_mesh_factor > 1.0 || from_scene;
  CostParameters best;
  const auto consider = [&](double by) {
    if (by > 1.0 && (keep || !may_coarsen(data, by))) return;
    // smaller ones only for an error that is out of reach without
    if (by < 1.0 && (keep || best.excess == 0.0 || !may_refine(data, by))) return;
    double mesh = std::isnan(n.mesh) ? 0.0 : n.mesh_error() * std::pow(by, order_of_mesh);
    if (from_scene) mesh = std::min(mesh, mesh_share(wanted));
    double left2 = wanted * wanted - mesh * mesh;
    const double least2 = 0.25 * wanted * wanted;
    if (left2 < least2 && by > 1.0) return;
    left2 = std::max(left2, least2);
    CostParameters parameters = cheapest(n, left2, data.solver, fixed);
    parameters.coarsening = by;
    // Number of elements, and time step: that grows less than h, as contacts keep their stiffness.
    parameters.cost /= by * by * std::pow(by, 0.7);
    parameters.excess = std::max(std::hypot(mesh, n.inertia_error(parameters.duration),
                                            n.softening_error(parameters.softening)) -
                                     wanted * (1.0 + 1e-9),
                                 0.0);
    // a smaller error has priority over a lower cost
    if (parameters.excess != best.excess ? parameters.excess < best.excess
                                         : parameters.cost < best.cost)
      best = parameters;
  };
  for (const double by : {1.0, 1.1, 1.2, 1.3, 1.4, 0.95, 0.9})
    consider(by);
  if (needs_small_elements(data) && best.excess > 0.0)
    consider(std::max(std::pow(mesh_share(wanted) / n.mesh_error(), 1.0 / order_of_mesh),
                      smallest_factor(data)));
  data.solver.duration = best.duration;
  data.solver.fibre_softening = best.softening;
  for (BlankSpec& blank : data.blanks)
    scale_elements(blank, best.coarsening);
  return best.coarsening;
}

} // namespace plyform
