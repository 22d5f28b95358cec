// SPDX-License-Identifier: GPL-3.0-or-later
// Error of the cost parameters of a run (duration, fibre softening, element size), and which of
// them to take for a wanted accuracy.
//
// Error: root mean square, over all plies, of the difference in shear angle to a run that has
// converged (docs/users/accuracy.md: how it was measured, on which cases the rule was set and on
// which it was checked). Three causes, each a power of a number without unit:
//   inertia    I = 1/2 rho v^2 / w       rho t/mm^2, v = stroke / duration, w N/mm
//   softening  S = s w / (d k)           s effective_softening, k N a yarn, d yarns per mm
//   mesh       M = h / L                 element size over stroke, mm
//   plies      n                         in a stack: the outer ones are held on one side only, and
//                                        plies hold each other's yarns
// w = n_c Ws(1/2 rad): energy of shear by half a radian per area, the work that forms the plies.
//   e = sqrt( (c_I I^p)^2 + (c_S n^u S^q)^2 + (c_M M^r)^2 )                                (E)
// c_I is larger in a stack; so is c_M in one of fewer than five plies, where the mesh has a part in
// which of them slide and which stick.
// Steps are as many as duration / sqrt(softening), work on a coarser mesh falls as h^-2.7.
#pragma once

#include "core/model/case.hpp"

#include <string>
#include <vector>

namespace plyform {

/// Degrees, rms; of (E), by cause. A mesh from a file has no element size and counts as 0.
struct PredictedError {
  double inertia = 0.0, softening = 0.0, mesh = 0.0;
  double total() const;
  /// What the user may count on: total(), or what was asked for if that is more.
  double promised(const Case& data) const;
};

/// For a case whose stroke is given (driven tools, boundaries); NaN without one. Of several fabrics
/// and blanks the worst counts.
PredictedError predicted_error(const Case& data);

/// One line for the user; promised: degrees; coarsening: as pick_cost_parameters returned it.
std::string describe_accuracy(const PredictedError& error, double promised, double coarsening);

/// Presets of --accuracy, and their promise in degrees. 0 for a word that is none.
double preset_error(const std::string& word);

/// Cost parameters that the user has set by hand.
struct FixedParameters {
  bool duration = false, softening = false, element_size = false;
};

/// Sets solver.duration, solver.fibre_softening and the element size of the blanks for the least
/// work whose error (E) is at most accuracy.shear_deg: softening between 1 and 1000 (stacks: 300),
/// I at most 2.8, elements up to 1.4 times as large as the case's where tools and outlines allow
/// it (not in stacks of two to four plies, where that was not measured), never smaller. Where the
/// mesh leaves less than half of the error, inertia and softening get half. Nothing is done without
/// accuracy.shear_deg or a stroke. What is fixed stays; the others then make up for it as far as
/// they can, with half of the wanted error at least. Returns the element sizes over those before.
double pick_cost_parameters(Case& data, const FixedParameters& fixed = {});

} // namespace plyform
