// SPDX-License-Identifier: GPL-3.0-or-later
// Whether plies lie or fly at the end of a run. What is predicted of inertia, and the orders by
// which bands extrapolate it, hold for plies that follow the tools; those that fly go where they
// were thrown.
//
//   K  N mm  kinetic energy of a ply
//   W  N mm  work of its deformation: elastic energy of yarns, shear and bending, without contact,
//            and what the viscosity of its elements has lost
//   E  N mm  work that was done on all plies
//   a ply flies if  K > flying max(W, mean of all W, floor)  and  K > counts E
// A ply that is hardly deformed is compared with the others. The floor is that of energies
// (Scene::energy_floor): below it both are rounding errors. Plies that slide under friction are
// deformed by little of the work, and their motion is none that counts.
#pragma once

#include "core/results/frame.hpp"
#include "core/solver/scene.hpp"

#include <string>
#include <vector>

namespace plyform {

/// K / W. Hemispheres of one ply and two, a box, a dome without a holder, in ever shorter times:
/// with 0.03 to 0.05 at the end the punch has lost 0.8 to 0.99 of its force, with 0.06 a fifth in
/// the dome (docs/users/accuracy.md).
constexpr double flying = 0.05;
/// K / E. Grippers that draw plies from under a holder (cases/springs_and_grippers, draft) have
/// 0.002, and 0.05 of K / W; those that fly 0.02 and more.
constexpr double counts_as_motion = 0.01;

struct PlyMotion {
  double kinetic = 0.0, deformation = 0.0; ///< K, W
};

/// Of each ply, in the present state.
std::vector<PlyMotion> motion_of_plies(const Scene& s);

/// K over what it is compared with, of the ply for which it is the largest.
struct LargestMotion {
  double share = 0.0;
  std::vector<std::size_t> flying; ///< numbers of the plies that fly
};
/// work: E.
LargestMotion largest_motion(const Scene& s, const std::vector<PlyMotion>& plies, double work);

/// Reasons to doubt a result whose plies fly, have left the scene, or are drawn by more than what
/// holds them, a sentence each. last: the frame of the present state.
std::vector<std::string> doubts_of_motion(const Scene& s, const Frame& last);

} // namespace plyform
