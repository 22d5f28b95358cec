// SPDX-License-Identifier: GPL-3.0-or-later
// Vacuums between two plies, where these touch: contact bears them there ((V) of
// contact/forces/ply_ply.hpp), and air pushes on nodes as far as their faces are open,
//
//   q min(max(g / g_q - 1, 0), 1)                                                             (N)
//
// which takes over from what pulls by (V) between g_q and 2 g_q.
#pragma once

#include "core/model/case.hpp"
#include "core/solver/contact_state.hpp"
#include "core/solver/layup.hpp"

#include <vector>

namespace plyform {

/// N/mm^2, the most that a vacuum between these two plies has; 0: there is none.
double largest_vacuum(const Case& data, int a, int b);

/// Sets PlyPlyContact::vacuum, PlyCache::borne_load, what (N) leaves out, and area_now of plies
/// that a vacuum presses on each other, at the present positions. To be called at every step, after
/// searches and before forces are computed.
void bear_vacuums(Layup& layup, std::vector<PlyPair>& pairs);

/// Sets PlyModel::vacuum_stiffness: the most by which (N) changes on any node as its gap opens.
void note_vacuum_stiffness(const std::vector<PlyPair>& pairs, std::vector<PlyBody>& plies);

} // namespace plyform
