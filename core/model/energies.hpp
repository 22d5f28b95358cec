// SPDX-License-Identifier: GPL-3.0-or-later
// The energies of a run and their balance.
#pragma once

namespace plyform {

/// Energies and work done since the start, N mm (mJ). external: work of tools, boundaries and
/// gravity on the plies, and what those held when the run began.
struct Energies {
  double kinetic = 0, fibre = 0, shear = 0, bending = 0, contact = 0, friction = 0, damping = 0,
         external = 0;
  double residual() const; ///< all kept and lost, less what was put in
  /// (kinetic + fibre + shear + bending + contact + friction + damping - external) over the largest
  /// of them; 0 when all are 0.
  double balance_error() const;
};

} // namespace plyform
