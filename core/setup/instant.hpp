// SPDX-License-Identifier: GPL-3.0-or-later
// The first answer: how far the plies of a stack will shear, each formed alone between the tools,
// with elements as coarse and a stroke as fast as about four degrees of error allow.
//
// A ply alone is kept from a tool by half its own thickness and that of all plies between the two,
// along the tool's normal, so that each follows the tools as it does in the stack. What pushes all
// plies, a holder's force, is shared among them equally, and a ply rubs on such a tool as on the
// ply next to it: as plies of a stack hardly slide on each other under a holder, the friction of n
// plies is then that of the stack. Without friction where plies lie between, five plies were 4.1
// instead of 2.1 degrees off. Plies that differ by no more than their height, and by that less than
// 3 mm, are formed once. Planes of symmetry are made use of where a ply has them
// (core/setup/part_of_scene.hpp), those too that hold but for families that are nearly alike.
//
// What a ply alone does not know: how plies slide on each other, wrinkles of the stack, forces. How
// far it is from the stack was measured: docs/users/accuracy.md.
#pragma once

#include "core/run/run.hpp"
#include "core/setup/prepare_case.hpp"

namespace plyform {

/// A case of one ply of a stack, and the plies that it stands for.
struct PlyAlone {
  PreparedCase prepared;
  std::vector<std::size_t> plies; ///< numbers in the stack; the first is the one that is formed
};

/// Why plies alone would say nothing of a case, a clause: it is formed by what acts on a stack
/// only. Empty: they do.
std::string not_for_plies_alone(const Case& data);

/// The plies of a case, one case for all that are alike. prepared.value must be there.
std::vector<PlyAlone> plies_alone(const PreparedCase& prepared);

/// Forms each of them and puts them together; the status is "instant", or that of a ply that did
/// not come to its end. Frames are told when all have. threads >= 1. Throws as run_case.
RunResult run_instant(const PreparedCase& prepared, int threads, const RunHooks& hooks);

/// One ply of it, the only one in the state and in the summary that come back; frames have it in
/// its place among empty ones. ply: its number.
RunResult form_ply(const PreparedCase& prepared, std::size_t ply, int threads,
                   const RunHooks& hooks);

} // namespace plyform
