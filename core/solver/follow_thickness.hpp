// SPDX-License-Identifier: GPL-3.0-or-later
// Keeps what search and contact know of the thickness of plies (core/ply/thickness.hpp) up to date.
//
// It acts in contact where a fabric says how it gives way through its thickness. Cloth that is
// thicker and does not give way at all would be wrong the other way round: a holder would lie on
// its most sheared corners alone and let go of the rest (docs/tried.md).
#pragma once

#include "base/thread_pool.hpp"
#include "core/solver/layup.hpp"

namespace plyform {

/// Sets the largest and the smallest ratio of the scene, Scene::thickest and thinnest, at a search.
void note_thickness(Layup& layup);

/// mm, of mid-surfaces that may touch before the next search. distance: theirs before forming, mm.
double reach_of(const Layup& layup, double distance);

/// mm, which contact keeps at least between two mid-surfaces anywhere.
double least_distance(const Layup& layup, const PlyPlyContact& contact);

/// Sets PlyCache::thickness_ratio of plies whose thickness acts, and what the search must know of
/// its change. To be called at every step before contacts are searched.
void update_thickness(Layup& layup, ThreadPool& pool);

} // namespace plyform
