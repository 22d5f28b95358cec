// SPDX-License-Identifier: GPL-3.0-or-later
// What a search gives to points of contact of two plies by their law of friction: their areas, and
// the angle between the fibres of both faces.
#pragma once

#include "contact/forces/ply_ply.hpp"

namespace plyform {

/// Area (mm^2) of a new point, which is on this face of the master.
double area_of(const ContactLaw& law, const SurfaceKinematics& slave,
               const SurfaceKinematics& master, const PlyPlyPoint& point, const Triangle& face);

/// Gives a point that goes on the area that it had, as its springs store energy. A film bears shear
/// by its area, which changes as one sheet slides out from the other: its points take the present
/// one, and keep their force.
void keep_area(const PlyPlyPoint& before, const ContactLaw& law, PlyPlyPoint& c);

/// f_a of contact/forces/friction_law.hpp at a point; 1 where a face has no fibres.
double by_angle(const FrictionLaw& law, const PlyPlyPoint& point, const SurfaceKinematics& slave,
                const SurfaceKinematics& master, std::span<const Triangle> triangles);

} // namespace plyform
