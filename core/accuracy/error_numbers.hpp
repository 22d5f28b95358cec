// SPDX-License-Identifier: GPL-3.0-or-later
// The dimensionless numbers of a case in the error model (E) of core/accuracy/error_model.hpp, and
// each term from them and back.
#pragma once

#include "core/model/case.hpp"

#include <cmath>
#include <vector>

namespace plyform {

/// r of (E): errors go with this power of the element size.
constexpr double order_of_mesh = 1.6;

/// A family of yarns: S of (E) for softening 1, and its largest effective softening.
struct YarnNumbers {
  double softening, most;
};

/// Numbers of (E) for duration 1 s, softening 1.
struct ErrorNumbers {
  double inertia = 0.0, softening = 0.0, mesh = 0.0;
  std::vector<YarnNumbers> families{}; ///< S of each; `softening` above is the largest of them
  double max_inertia = 0.0;            ///< I at most
  double inertia_factor = 0.0;         ///< c_inertia, c_stack or c_cloth; 0: nothing has a stroke
  double stack_softening_factor = 1.0; ///< n^u of (E): plies support each other's softened yarns
  double max_softening = 0.0;          ///< softening at most
  /// Factor of c_M, above 1 in a stack of few plies: which of them slide or stick depends on the
  /// mesh.
  double few_ply_mesh_factor = 1.0;
  double cloth_mesh_factor = 1.0; ///< likewise in a stack of real cloth
  double clamp_load_factor = 1.0; ///< load of softened yarns in grips over that under tools

  // Terms of (E), degrees.
  double inertia_error(double duration) const;
  double softening_error(double softening) const;
  double mesh_error() const;

  /// s, the shortest duration whose error is `error` at most.
  double duration_for(double error) const;
  /// The largest softening whose error is `error` at most.
  double softening_for(double error) const;
  /// Lowers max_inertia to what keeps forces where an error of `wanted` degrees is asked for.
  void hold_inertia(double wanted);
};

/// Whether w, which I and S are over, is more than 0.
bool has_shear_energy(const Fabric& fabric);

/// mass_factor: of the mass that counts in I, by element mass scaling.
ErrorNumbers error_numbers(const Case& all, double mass_factor);

/// mass_factor before there is a mesh: what the share that solver.element_mass_scaling allows may
/// come to.
double assumed_mass_factor(const Case& data);

} // namespace plyform
