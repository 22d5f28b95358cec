// SPDX-License-Identifier: GPL-3.0-or-later
// What points of contact of two plies have beside their forces: the areas that one covers of the
// other, on which films act and through which heat goes, and the angle between the fibres of both
// faces.
#pragma once

#include "contact/forces/ply_ply.hpp"

#include <optional>

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

/// How a node sees the face of another ply.
struct Cover {
  double share = 0.0;           ///< of its area, as above: what the master covers
  std::optional<double> height; ///< mm, over the face's plane, of a node that is beyond the rim
};

/// Of all points of a contact, with the sheets as they lie now. Takes rim_distance of the master.
std::vector<Cover> covers_of(const PlyPlyContact& contact, const SurfaceKinematics& slave,
                             const SurfaceKinematics& master, std::span<const Triangle> triangles);

/// f_a of contact/forces/friction_law.hpp at a point; 1 where a face has no fibres.
double by_angle(const FrictionLaw& law, const PlyPlyPoint& point, const SurfaceKinematics& slave,
                const SurfaceKinematics& master, std::span<const Triangle> triangles);

} // namespace plyform
