// SPDX-License-Identifier: GPL-3.0-or-later
// Selective mass scaling: the few nodes whose contacts are much stiffer than the elements get mass
// added, so that they do not shorten the time step of all others.
//
//   c_n    N/mm   row sum of the contact stiffness of node n;  m_n  t  its own mass
//   kappa  1/s^2  the largest c_n / mass that is left
//   added mass  max(0, c_n / kappa - m_n)                                                     (M)
//
// kappa is a fixed share of the elements' largest omega^2, below which contacts hardly count in the
// step, or what solver.mass_scaling, the largest share of each ply's mass that may be added,
// allows; a ply whose bound would hardly fall gets none, nor does any where a pushed tool has a
// mass and swings on its contacts: two plies under one of 1 kg, 300 N, answered with 40 N for 28 N.
// Every 50 steps masses go there by a quarter at most: a node that is thrown at a contact
// and back again in fewer steps keeps its mass, as its kinetic energy would grow with it. A node
// keeps its velocity, and the kinetic energy that a change of mass brings, 1/2 dm |v|^2, is a term
// of the energy balance. Gravity acts on m_n alone. Adding mass to a few nodes only where stiffness
// calls for it: Hallquist, LS-DYNA Theory Manual, on mass scaling.
#pragma once

#include "core/solver/contact_rows.hpp"

namespace plyform {

constexpr int mass_scaling_interval = 50; ///< steps

/// Changes PlyState::mass towards (M), and adds to SceneProgress::mass_scaling_work and
/// largest_added_mass.
void scale_masses(Layup& layup, const std::vector<ToolState>& tools, const ContactRows& touching);

} // namespace plyform
