// SPDX-License-Identifier: GPL-3.0-or-later
// Mass on the small elements of a graded mesh, so that they do not set the time step of all.
//
//   m_e      t      mass of triangle e
//   w_e      1/s^2  what it brings to the ply's omega^2: of its strain group (group_omega2) and of
//                   the bending stencils at its corners (stencil_omega2), each in proportion to
//                   what Lanczos' iteration finds for the whole ply
//   kappa    1/s^2  the largest w_e that is left, the same for all plies, since one step is taken
//   mass of a small triangle: m_e max(1, w_e / kappa)                                        (E)
//
// Small is a triangle of less than small_share of the area of the ply's usual triangle, the one in
// which the middle of its mass is. kappa is as low as the ply with the least to spare allows: no
// ply gets more than a share of its mass, and none is below the largest w_e of a triangle that is
// not small. Where the largest w_e would fall by less than a tenth nothing is added. A uniform mesh
// has no small triangle and keeps its masses bit by bit.
//
// Masses change once, before the first step, so that no energy comes with them. Gravity acts on the
// mass of the cloth. Stiffness and damping of contacts, and the viscosity of yarns, follow from the
// frequency that is left, as they do on a coarser mesh. Mass scaling by elements: Hallquist,
// LS-DYNA Theory Manual.
#pragma once

#include "core/solver/layup.hpp"

namespace plyform {

/// Adds mass by (E), at most solver.element_mass_scaling of each ply's, to Membrane::node_mass and
/// PlyState::mass, and bounds the frequency of bending anew; that of the membrane, and what
/// follows from it, is left to the caller. Plies that nothing moves keep their masses. Before tools
/// and contacts are made.
void scale_element_masses(const Case& data, std::vector<PlyBody>& plies);

/// The mass added to a ply's elements over that of its cloth.
double added_element_mass(const Membrane& membrane);

/// The largest of that of all plies.
double largest_added_element_mass(const Layup& layup);

/// By how much inertia counts for more, in the ply where it does most: the error by inertia goes
/// with the power 1.5 of the mass (core/accuracy/error_model.hpp), here element by element, and is
/// the root mean square over the area, so that the factor is the cubic mean of those of the
/// elements. 1 without mass scaling.
double effective_mass_factor(const Layup& layup);

} // namespace plyform
