// SPDX-License-Identifier: GPL-3.0-or-later
// Forces on the nodes: what elements, tools and other plies do to them, and the acceleration that
// comes of their sum.
#pragma once

#include "core/base/thread_pool.hpp"
#include "core/solver/scene.hpp"

namespace plyform {

/// Forces of elements, bending, tools and contacts at the present positions, each into arrays of
/// its own. Force-controlled tools find their place.
void element_and_contact_forces(Scene& scene, ThreadPool& pool);

/// What acts on every mass: gravity (mm/s^2) and damping (1/s).
struct MassLoads {
  Vec3 gravity;
  double damping;
};

MassLoads mass_loads(const Scene& scene);

/// N, of nodes begin .. end - 1 into f[0 ..): the sum of all forces. Array after array, which
/// streams; a node's terms are added in the same order however its ply is cut up.
void sum_forces(const PlyState& ply, int begin, int end, Vec3* f);

/// mm/s^2, (17) of core/solver/step.hpp, of the sum of a node's forces.
inline Vec3 acceleration(const PlyState& ply, std::size_t n, const Vec3& force,
                         const MassLoads& loads) {
  return force / ply.membrane.node_mass[n] + loads.gravity - loads.damping * ply.velocity[n];
}

/// The same, of the forces as they are now.
Vec3 acceleration(const PlyState& ply, int node, const MassLoads& loads);

} // namespace plyform
