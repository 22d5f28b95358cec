// SPDX-License-Identifier: GPL-3.0-or-later
// Row sums of the stiffness and damping matrices of a scene's contacts, springs and grippers, which
// bound their eigenvalues (Gershgorin).
#pragma once

#include "base/thread_pool.hpp"
#include "core/solver/scene.hpp"

namespace plyform {

/// mm, SceneModel::bound_margin of edge-edge contact.
inline double edge_margin(const Layup& layup) {
  return 0.25 * layup.bound_margin;
}

/// Row sums of the contact matrices, per ply and node.
using ContactRows = std::vector<std::vector<ContactRow>>;

/// Computes those of the contacts between two plies, or of one with itself, that are closed or
/// within bound_margin of closing now, and the depths (renew_depth) up to which they hold.
void renew_rows(const Layup& layup, std::vector<PlyPair>& pairs, ThreadPool& pool);

/// The same of the pairs of plies alone in which a contact is deeper than that.
void renew_deepened_rows(const Layup& layup, std::vector<PlyPair>& pairs, ThreadPool& pool);

/// The rows of the pairs as they were last computed, and those of the tools at the present
/// positions, of springs and of the drives of grippers.
ContactRows contact_rows(const Scene& scene, ThreadPool& pool);

} // namespace plyform
