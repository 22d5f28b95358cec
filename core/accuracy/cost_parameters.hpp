// SPDX-License-Identifier: GPL-3.0-or-later
// The choice of cost parameters (duration, fibre softening, element size) for a requested accuracy:
// the least work that keeps it by the error model.
#pragma once

#include "core/accuracy/error_model.hpp"

namespace plyform {

/// Whether all of them may be of the largest elements for the error asked for, so that smaller ones
/// would cost time for the sake of fillets alone.
bool largest_elements_suffice(const Case& data);

/// Whether the error asked for is less than meshes from the scene reach: it takes small elements
/// throughout.
bool needs_small_elements(const Case& data);

/// Whether every blank may have elements larger by the factor `by`: not longer than the smallest
/// tool radius, nor than in the measurements of contact, and its outline can be meshed with them.
bool may_coarsen(const Case& data, double by);

/// Whether every blank may have elements smaller by the factor `by`: not those from files, nor with
/// boundaries, whose nodes depend on the mesh.
bool may_refine(const Case& data, double by);

/// Cost parameters that the user has set by hand.
struct FixedParameters {
  bool duration = false, softening = false, element_size = false;
};

/// Sets solver.duration, solver.fibre_softening and the element size of the blanks for the least
/// work whose error (E) is at most accuracy.shear_deg: softening between 1 and 1000 (stacks: 300),
/// I at most 0.36 (at 3 degrees; less for less), elements up to 1.4 times as large as the case's
/// where tools and outlines allow it (not in stacks of two to four plies of yarns that carry
/// tension only, where that was not measured), and down to 0.9 times where the error is out of
/// reach without (not with boundaries); below 0.5 degrees as far down as that takes, to three
/// thicknesses. If the mesh term leaves less than half of the error,
/// inertia and softening get half of it. Does nothing without accuracy.shear_deg
/// or a stroke, or where (E) was not_measured. Fixed parameters are not changed; the others
/// compensate for them as far as possible, with at least half of the requested error. A mesh that
/// would come from the scene is made of the largest elements throughout where they suffice, or of
/// small ones below 0.5 degrees (unless element sizes are fixed). Returns the ratio of the new
/// element sizes to the old ones.
double pick_cost_parameters(Case& data, const FixedParameters& fixed = {});

} // namespace plyform
