// SPDX-License-Identifier: GPL-3.0-or-later
// The largest stable time step. Central differences with lagged damping,
//   M (x_{n+1} - 2 x_n + x_{n-1}) / dt^2 + C (x_n - x_{n-1}) / dt + K x_n = 0,
// are stable where
//
//   largest eigenvalue of  M^-1 (dt^2 K + 2 dt C)  <=  4                                  (S)
//
// since each mode z^n v obeys the scalar equation with k = v*Kv/v*Mv and c = v*Cv/v*Mv, whose roots
// lie in the unit circle for dt^2 k + 2 dt c <= 4. Two estimates of that eigenvalue:
//
//   bound   per ply, the bound of its elements plus the largest row sum of contact stiffness over
//           mass of any node (Gershgorin): always safe and cheap, but it adds up terms that do not
//           act on the same mode: elements in the plane, contacts normal to it, each at the node
//           where it is stiffest
//   gain    factor by which the step may be longer than the bound allows, from K and C of all
//           plies, contacts and friction at the present shape, with yarns taut and contacts
//           sticking, by Lanczos' iteration; it costs as much as 30 steps and is updated every 1000
//
// Between updates bound times gain is used. It is valid as long as elements and contacts change in
// proportion; therefore any increase of contact stiffness since the update counts in full, and the
// step never exceeds that of the elements' or the contacts' bound alone.
#pragma once

#include "base/thread_pool.hpp"
#include "core/solver/contact_rows.hpp"

namespace plyform {

/// The stable time step, and where it is limited.
struct StepBound {
  double dt = 0.0;     ///< s, stable time step without the case's step_factor
  double omega2 = 0.0; ///< 1/s^2, of the bound of that ply
  int ply = -1, triangle = -1;
};
/// The stable time step from PlyCache::bound, the gain, and the contacts at their present
/// positions: those that are closed or within Scene::bound_margin of closing. step_factor covers
/// their sliding until the next update.
StepBound stable_step(const Layup& layup, const ContactRows& touching);

/// Bound of omega^2, 1/s^2, of the elements and the bending of a ply.
double element_omega2(const PlyBody& ply);

/// Updates PlyCache::bound at the present shape, and if due PlyCache::eigenvalue_ratio and
/// SceneProgress::time_step_gain.
void update_stable_step(Scene& scene, ThreadPool& pool);

} // namespace plyform
