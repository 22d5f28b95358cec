// SPDX-License-Identifier: GPL-3.0-or-later
// What a closed mould leaves the stack at each place: its gap, what of that the plies do not fill,
// where resin runs, and how near they are to their densest packing, where it cannot close further.
//
//   d_a, d_b  mm  distances of a triangle's centre from both tools;  H = d_a + d_b, the gap
//   t_i, w_i  mm  present thickness of the plies that the way from tool to tool crosses, and that
//                 of their fibres alone, V t (core/run/present_thickness.hpp)
//   c_i       mm  thickness at the densest packing; of a ply without compaction its own
//   nu        mm  by which neighbours that nest are thinner than apart
//   gap left H - sum t_i,  packing (sum c_i - sum nu) / H,  fibre volume fraction sum w_i / H   (1)
// Once a mould is closed somewhere, a place is between the two tools that leave it least, if their
// surfaces there look at each other, within 60 degrees.
#pragma once

#include "core/results/frame.hpp"
#include "core/run/moulds.hpp"

#include <vector>

namespace plyform {

/// Fills `mould` of all plies of a state, whose thickness and fibre volume are known. It stays
/// empty where no fabric has compaction, or without a mould that closes. For the state of the
/// scene with its last forces.
void add_closed_gap(const Scene& scene, const Moulds& moulds, ThreadPool& pool,
                    std::vector<PlyFrame>& plies);

} // namespace plyform
