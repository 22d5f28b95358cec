// SPDX-License-Identifier: GPL-3.0-or-later
// One explicit step: central differences with lumped mass, the paper's (14)-(17).
//
//   a_i      = M^-1 ( F_ext - F_int - C v_(i-1/2) )                                        (17)
//   v_(i+1/2) = v_(i-1/2) + 1/2 (dt_(i-1) + dt_i) a_i                                      (16)
//   x_(i+1)  = x_i + v_(i+1/2) dt_i                                                        (15)
#pragma once

#include "core/results.hpp"
#include "core/scene.hpp"
#include "core/thread_team.hpp"

#include <optional>
#include <string>

namespace plyform {

/// A simulation that cannot go on: says step, time, ply, element or node and value.
struct Stop {
  std::string message;
};

/// Prepares the first step: contact search, step size.
void start(Scene& scene, ThreadTeam& team);

/// Forces at the present positions, then motion to the next ones. `energies`: if not null, filled
/// with the energies at the positions before the motion.
std::optional<Stop> step(Scene& scene, ThreadTeam& team, Energies* energies);

} // namespace plyform
