// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solver/mass_scaling.hpp"

#include "core/solver/omega_cap.hpp"
#include "core/solver/stable_time_step.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace plyform {
namespace {

/// Of the elements' largest omega^2: contacts below it get no mass. With half of it five plies of
/// real cloth step no further.
constexpr double contact_share = 0.5;
constexpr double largest_change = 1.25; // of a node's mass at a time

// A bound of contacts that would fall by less is left as it is: where a whole ply lies on a tool,
// all of its nodes would get mass for a step that is hardly longer.
constexpr double least_gain = 1.2;

/// kappa of (M), 1/s^2: `least`, or more where that would add more than `budget` (t). Infinite if
/// it brings less than least_gain.
double largest_contact_omega2(const std::vector<ContactRow>& rows, const std::vector<double>& mass,
                              double least, double budget) {
  std::vector<StiffMass> stiff;
  for (std::size_t n = 0; n < rows.size(); ++n)
    if (rows[n].stiffness > least * mass[n]) stiff.push_back({rows[n].stiffness, mass[n]});
  const OmegaCap cap = lowest_cap(std::move(stiff), least, budget);
  return cap.before < least_gain * cap.omega2 ? std::numeric_limits<double>::infinity()
                                              : cap.omega2;
}

} // namespace

void scale_masses(Layup& layup, const std::vector<ToolState>& tools, const ContactRows& touching) {
  const double share = layup.data.solver.mass_scaling;
  const auto swings = [](const ToolState& tool) { return tool.body.mass > 0.0 && !tool.far; };
  if (share == 0.0 || std::any_of(tools.begin(), tools.end(), swings)) return;
  double elements = 0.0;
  for (const PlyBody& ply : layup.plies)
    if (!ply.resting) elements = std::max(elements, element_omega2(ply));
  for (std::size_t p = 0; p < layup.plies.size(); ++p) {
    PlyBody& ply = layup.plies[p];
    if (ply.resting) continue;
    const std::vector<double>& own = ply.membrane.node_mass;
    const double whole = std::accumulate(own.begin(), own.end(), 0.0);
    const double kappa =
        largest_contact_omega2(touching[p], own, contact_share * elements, share * whole);
    double added = 0.0;
    for (std::size_t n = 0; n < own.size(); ++n) {
      const double wanted = std::max(own[n], touching[p][n].stiffness / kappa);
      const double mass =
          std::clamp(wanted, ply.mass[n] / largest_change, ply.mass[n] * largest_change);
      layup.mass_scaling_work += 0.5 * (mass - ply.mass[n]) * ply.velocity[n].squaredNorm();
      ply.mass[n] = mass;
      added += mass - own[n];
    }
    layup.largest_added_mass = std::max(layup.largest_added_mass, added / whole);
  }
}

} // namespace plyform
