// SPDX-License-Identifier: GPL-3.0-or-later
// Temperatures of plies that cool: one through the thickness at each node, and nothing flows within
// the plane. Both faces of a node give heat to what is there.
//
//   T    degC            temperature of a node;  T_k  of what its face k touches
//   t    s               time of the process
//   C    N mm/(mm^2 K)   heat capacity per present area, rho_A c A0 / A
//   h_k  N/(mm s K)      conductance of the face
//
//   C dT/dt = sum_k h_k (T_k - T)                                                           (1)
//   T' = T_e + (T - T_e) e^(-dt h / C),  h = sum_k h_k,  T_e = sum_k h_k T_k / h            (2)
//
// (2) is exact while h_k and T_k stay as they are, whatever dt is: no number of steps is asked for.
// A face that touches the air has that of the case's cooling; one with a gap g to a tool or a ply
// gives its heat through the film of air between, if that is more:
//
//   1/h_k = 1/h_touching + g / k_air                                                        (3)
//
// A face gives heat to what lies before it, and to nothing behind that: at its nodes the contact
// search sees tools and plies behind a ply, too. A ply before it covers a share of a node's area
// near its own rim (contact/forces/sliding_point.hpp), and what it leaves goes to what is there,
// or to the air.
//
// Of two plies that touch, (1) for both has the mean T_m = (C_a T_a + C_b T_b) / (C_a + C_b),
// which stays, and each goes to it: T_k = T_m, h_k = h (C_a + C_b) / C_b for ply a. With T_k = T_b,
// they would exchange their temperatures in a step that is too long.
//
// Elastic shear over temperature, C = f(T) C_e: what it stores, f W, changes with f at a fixed
// shape too. That is heat which becomes elastic energy, or the other way, and no work of any force:
// its sum, of W df at each update, is PlyState::law_work.
#pragma once

#include "base/thread_pool.hpp"
#include "core/solver/scene.hpp"

namespace plyform {

/// Steps from one update of temperatures to the next, which take nothing of what cools in seconds.
constexpr long temperatures_every = 10;
/// h dt / C of one face, of the largest h, after which they are due sooner: T_m of (2) stays as it
/// is meanwhile, which a ply between two others feels.
constexpr double longest_update = 0.01;

/// degC, of the nodes of each ply at the present time, which may be some steps after those of its
/// state; empty of plies without temperatures.
std::vector<std::vector<double>> present_temperatures(const Scene& s, ThreadPool& pool);

/// Takes the temperatures of plies to the present time, if the case has cooling and an update is
/// due, and what they make of viscosities and of elastic shear. Asked twice at one time it changes
/// nothing. To be called before forces are computed.
void update_temperatures(Scene& s, ThreadPool& pool);

} // namespace plyform
