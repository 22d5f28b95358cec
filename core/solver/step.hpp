// SPDX-License-Identifier: GPL-3.0-or-later
// One explicit step: central differences with lumped mass, the paper's (14)-(17).
//
//   a_i      = M^-1 ( F_ext - F_int - C v_(i-1/2) )                                        (17)
//   v_(i+1/2) = v_(i-1/2) + 1/2 (dt_(i-1) + dt_i) a_i                                      (16)
//   x_(i+1)  = x_i + v_(i+1/2) dt_i                                                        (15)
#pragma once

#include "base/thread_pool.hpp"
#include "core/model/energies.hpp"
#include "core/solver/scene.hpp"
#include "core/solver/stop.hpp"

#include <optional>

namespace plyform {

/// Prepares the first step: contact search, step size.
void start(Scene& scene, ThreadPool& pool);

/// Moves driven tools to scene.time, searches contacts if motion has used up the skin, updates the
/// stable time step if due, and computes all forces at the present positions. Returns the reason if
/// the simulation cannot go on.
std::optional<Stop> compute_forces(Scene& scene, ThreadPool& pool);

/// Energies and work at the present positions; after compute_forces. The kinetic energy is that of
/// the velocities half a step before and after, 1/2 m v- . v+, which central differences conserve.
Energies current_energies(const Scene& scene, ThreadPool& pool);

/// (15)-(17): moves all nodes to their next positions and advances scene.time.
void move_plies(Scene& scene, ThreadPool& pool);

} // namespace plyform
