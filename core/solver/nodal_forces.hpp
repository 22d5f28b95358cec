// SPDX-License-Identifier: GPL-3.0-or-later
// Nodal forces of elements, bending and contact, and the acceleration from their sum.
#pragma once

#include "base/thread_pool.hpp"
#include "core/solver/scene.hpp"

namespace plyform {

/// Computes the forces of elements, bending, tools and contacts (N) at the present positions, each
/// into arrays of its own. Moves force-controlled tools into equilibrium.
void element_and_contact_forces(Scene& scene, ThreadPool& pool);

/// Loads in proportion to mass: gravity (mm/s^2) and mass damping (1/s).
struct MassLoads {
  Vec3 gravity;
  double damping;
};

MassLoads mass_loads(const Case& data);

/// Sum of all forces (N) on nodes begin .. end - 1, stored in f[0 ..]. The arrays are added one
/// after the other; a node's terms are added in the same order however its ply is divided into
/// blocks.
void sum_forces(const PlyBody& ply, int begin, int end, Vec3* f);

/// Acceleration (mm/s^2) of a node by (17) of core/solver/step.hpp. force: sum of its forces, N.
inline Vec3 acceleration(const PlyBody& ply, std::size_t n, const Vec3& force,
                         const MassLoads& loads) {
  const double mass = ply.mass[n];
  return force / mass + (ply.membrane.cloth_mass(n) / mass) * loads.gravity -
         loads.damping * ply.velocity[n];
}

/// The same, with the sum of the present forces.
Vec3 acceleration(const PlyBody& ply, int node, const MassLoads& loads);

} // namespace plyform
