// SPDX-License-Identifier: GPL-3.0-or-later
// Error model of the cost parameters of a run (duration, fibre softening, element size). Their
// choice for a requested accuracy: core/accuracy/cost_parameters.hpp.
//
// Error: root mean square, over all plies, of the difference in shear angle to a run that has
// converged (docs/users/accuracy.md: how it was measured, the cases that (E) was fitted to and
// those it was validated with). Three causes, each a power of a dimensionless number:
//   inertia    I = 1/2 rho v^2 / w       rho t/mm^2, v = stroke / duration, w N/mm; rho with
//                                        what element mass scaling adds
//   softening  S = s w / (d k)           s effective_softening, k N a yarn, d yarns per mm
//   mesh       M = h / L                 element size over stroke, mm
//   plies      n                         in a stack: the outer ones are supported on one side only,
//                                        and plies support each other's yarns
// w = n_c Ws(1/2 rad): energy of shear by half a radian per area, the work that forms the plies.
//   e = sqrt( (c_I I^p)^2 + (c_S n^u S^q)^2 + (c_M M^r)^2 )                                (E)
// c_I is larger in a stack of yarns that carry tension only; so is c_M in one of fewer than five
// plies, where it depends on the mesh which of them slide and which stick. In a stack of real cloth
// c_M grows with the plies, unless their meshes come from the scene. The number of steps is
// proportional to duration / sqrt(softening), the cost of a mesh to h^-2.7.
#pragma once

#include "core/model/case.hpp"

#include <string>
#include <vector>

namespace plyform {

/// The terms of (E) by cause, degrees rms. Of a mesh from a file, or with zones or a grid of sizes,
/// the error of each place counts, as the root mean square over the area; the mesh term is NaN if
/// the file cannot be read.
struct PredictedError {
  double inertia = 0.0, softening = 0.0, mesh = 0.0;
  double total() const;
  /// The error promised to the user, degrees: total(), or the requested one if that is larger.
  double promised(const Case& data) const;
  /// Why promised() is NaN, a clause; else empty.
  std::string unknown(const Case& data) const;
};

/// Why (E) says nothing of a case: it has a part that none of the cases had that (E) was fitted to,
/// which were dry cloth of two families of yarns, sheared, formed by tools or pulled by grips.
/// Empty if it has none.
std::string not_measured(const Case& data);

/// (E) for a case with a stroke (of driven tools or boundaries); NaN without one, and where it was
/// not_measured. With several
/// fabrics and blanks the largest errors count. mass_factor: of rho in I, by element mass scaling
/// (effective_mass_factor, core/solver/element_mass_scaling.hpp); without it what the share that
/// solver.element_mass_scaling allows may come to.
PredictedError predicted_error(const Case& data);
PredictedError predicted_error(const Case& data, double mass_factor);

/// One line for the user; promised: degrees, or NaN, and `unknown` says why; coarsening: as
/// pick_cost_parameters returned it.
std::string describe_accuracy(const PredictedError& error, double promised, double coarsening,
                              const std::string& unknown);

/// What to say before a run of a case whose predicted error is more than its accuracy.shear_deg: by
/// how much, which cause, and what helps; empty if it is kept or none was asked for.
std::string missed_accuracy(const Case& data);

/// The part of an error (degrees) that is left to the mesh.
double mesh_share(double error);

/// Whether a mesh is still to come from the scene (core/setup/scene_mesh.hpp), which keeps
/// mesh_share of the error asked for where that is possible.
bool awaits_scene(const Case& data);

/// The error (degrees) of a preset of --accuracy; 0 for a word that is not a preset.
double preset_error(const std::string& word);

} // namespace plyform
