// SPDX-License-Identifier: GPL-3.0-or-later
// Fibre volume fractions that cannot be: beyond the densest packing of a ply, where its triangles
// are crushed in their plane or its contacts pressed beyond its compaction curve, and those that a
// ply has because pressing has changed the length of its yarns.
//
//   V    -     present fibre volume fraction (core/run/present_thickness.hpp)
//   V_d  -     rho_A / (rho_f (c - nu)) of a compaction curve down to c (mm) that nests by nu, but
//              pi / (2 sqrt 3) at most, the densest packing of circles, as of plies without one (1)
//   f    -     A0 / (A r): how much denser than pressing alone made it, r of
//   core/ply/thickness.hpp;
//              a triangle with V > V_d is crushed if V / f < V_d                             (2)
//   g    -     area that stretched yarns add: (1 + e_1)(1 + e_2) - 1 of the first crossing, in the
//              mean over the triangles that are pressed: V is 1 / (1 + g) of what yarns that keep
//              their length would have, and the volume balance is off by that                (3)
#pragma once

#include "core/results/frame.hpp"
#include "core/solver/scene.hpp"

#include <string>
#include <vector>

namespace plyform {

/// (3) beyond which a volume balance is doubtful.
constexpr double doubtful_volume_balance = 0.02;

/// Of a ply, at the output at which its fibre volume was largest beyond its densest packing.
struct Overpacked {
  double fibre_volume = 0.0, densest = 0.0; ///< V and V_d; 0: it never was beyond
  double share = 0.0;                       ///< of its area before forming, of the triangles beyond
  Vec3 at = Vec3::Zero();                   ///< mm, of the densest triangle
  double stroke_mm = 0.0, time_s = 0.0;
  double crushed = 0.0; ///< A / A0 of that triangle, by (2); 0: it is pressed
};

/// Whether these are of none or all of `plies` plies, and numbers.
bool finite_of_each(const std::vector<Overpacked>& found, std::size_t plies);

/// For checkpoints: base/archive.hpp.
template <class F>
void each_member(Overpacked& ply, F&& f) {
  auto& [fibre_volume, densest, share, at, stroke_mm, time_s, crushed] = ply;
  f("fibre_volume", fibre_volume);
  f("densest", densest);
  f("share", share);
  f("at", at);
  f("stroke_mm", stroke_mm);
  f("time_s", time_s);
  f("crushed", crushed);
}

/// To be called at each output, with its frame: follows what is of each ply.
void follow_packing(const Scene& scene, const Frame& frame, std::vector<Overpacked>& plies);

/// A sentence each: plies that were beyond their densest packing, and those whose volume balance is
/// off at the end.
std::vector<std::string> doubts_of_packing(const Scene& scene, const Frame& last,
                                           const std::vector<Overpacked>& plies);

} // namespace plyform
