// SPDX-License-Identifier: GPL-3.0-or-later
// The largest stable time step. Central differences with lagged damping,
//   M (x_{n+1} - 2 x_n + x_{n-1}) / dt^2 + C (x_n - x_{n-1}) / dt + K x_n = 0,
// are stable where
//
//   largest eigenvalue of  M^-1 (dt^2 K + 2 dt C)  <=  4                                  (S)
//
// since each mode z^n v obeys the scalar equation with k = v*Kv/v*Mv and c = v*Cv/v*Mv, whose roots
// lie in the unit circle for dt^2 k + 2 dt c <= 4. Two answers to it:
//
//   bound   per ply, that of its elements plus the largest row sum of contact stiffness over mass
//           of any node: holds without doubt, and is cheap, but adds up what does not act together:
//           elements in the plane, contacts across it, the stiffest of each anywhere
//   stretch how much longer the step may be: K and C of all plies, contacts and friction at the
//           present shape, yarns taut and contacts stuck, by Lanczos' iteration; costs as much as
//           30 steps and is renewed every 1000
//
// Between renewals the bound times stretch holds as far as elements and contacts change alike: what
// contacts have grown by counts in full, and neither may be more than its own bound allows.
#pragma once

#include "core/base/thread_pool.hpp"
#include "core/solver/scene.hpp"

#include <cmath>

namespace plyform {

/// k and c of (S), 1/s^2 and 1/s.
struct Frequencies {
  double omega2 = 0.0, damping = 0.0;

  double stability_lhs(double dt) const { return dt * dt * omega2 + 2.0 * dt * damping; }
  double step() const { return (std::sqrt(damping * damping + 4.0 * omega2) - damping) / omega2; }
};

/// What limits the step now, from the elements and the contacts.
struct StepBound {
  double dt = 0.0;     ///< s, stable step without the case's factor
  double omega2 = 0.0; ///< 1/s^2, of the bound
  int ply = -1, triangle = -1;
};
/// Contacts count where they stand now, those too that are within bound_margin of closing; what
/// slides until the next renewal is what step_factor leaves room for. The elements' part is
/// PlyState::bound.
StepBound stable_step(const Scene& scene, ThreadPool& pool);

/// mm; by when anything has moved by half of it the bound is due again.
constexpr double bound_margin = 0.5;
constexpr double edge_margin = 0.25 * bound_margin; ///< mm, the same of edges

/// Renews PlyState::bound at the present shape, and if due PlyState::eigenvalue_ratio and
/// Scene::stretch.
void update_stable_step(Scene& scene, ThreadPool& pool);

} // namespace plyform
