// SPDX-License-Identifier: GPL-3.0-or-later
// What a search gives to points of contact of two plies by their law of friction: their areas, and
// the angle between the fibres of both faces.
#pragma once

#include "contact/forces/ply_ply.hpp"

namespace plyform {

/// Tributary area (mm^2) of a new point, which is on this face of the master: the smaller of both
/// sheets' nodal areas, so that a node of a coarse sheet does not overload the small nodes of a
/// fine one.
double contact_area(const SurfaceKinematics& slave, const SurfaceKinematics& master,
                    const PlyPlyPoint& point, const Triangle& face);

/// Gives points the areas on which a film acts. It bears shear by its area, which is that of both
/// sheets' overlap and changes as one slides out from the other: all of the slave's node, and at
/// the master's rim, a distance phi away (below 0 outside),
///
///   A min(1/2 + phi / L, 1),  and A (phi / L - 1/2) more if > 0 and the next node is not covered
///
/// L (mm) being how far the slave's mesh reaches from the node towards that rim, to the next node:
/// a node stands for what the rim leaves of its own cell, and of that of the next one. Points keep
/// their forces.
void renew_film_areas(PlyPlyContact& contact, const SurfaceKinematics& slave,
                      const SurfaceKinematics& master, std::span<const Triangle> triangles);

/// f_a of contact/forces/friction_law.hpp at a point; 1 where a face has no fibres.
double by_angle(const FrictionLaw& law, const PlyPlyPoint& point, const SurfaceKinematics& slave,
                const SurfaceKinematics& master, std::span<const Triangle> triangles);

} // namespace plyform
