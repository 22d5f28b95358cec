// SPDX-License-Identifier: GPL-3.0-or-later
// What each ply has come to, and which results no real cloth would give.
//
// Woven yarns cannot be pressed: they buckle, and what the mesh is too coarse to show of it stands
// in the results as a yarn that has become shorter. The excess length of a ply is the largest, over
// straight lines of the unformed ply along warp and weft, 2 mm apart, of
//   e = integral of max(0, -strain) ds,  mm                                                     (1)
// that is, by how much that yarn is longer than the way that the mesh gives it. Put into one
// wrinkle of wavelength w it would have the height (2/pi) sqrt(w e).
#pragma once

#include "core/results/result_writer.hpp"
#include "core/solver/facet_penetration.hpp"
#include "core/solver/scene.hpp"

#include <string>
#include <vector>

namespace plyform {

/// Of woven plies: more than 5 % shorter (PressedYarns::share_above_5) on more than this share of
/// the area is no longer a spot but the answer.
constexpr double doubtful_pressed_share = 0.02;

/// Energy balance error of a run beyond which its forces are not to be trusted.
constexpr double doubtful_balance_error = 0.01;

/// What has to be known of a ply beside its frame.
struct PlyNature {
  double fibre_angle_deg = 90.0; ///< from warp to weft before forming
  bool woven = true;             ///< has yarns
  std::optional<double> locking_angle_deg = std::nullopt;
};

PlyReport report_ply(const PlyFrame& ply, const PlyNature& nature,
                     const std::vector<const ToolBody*>& tools);

/// One for each ply of `last`, the frame of the scene as it stands.
std::vector<PlyReport> report_plies(const Scene& s, const Frame& last);

/// What in the result is not to be trusted, and why, and what to do: a sentence each; empty if
/// there is no reason to doubt.
std::vector<std::string> doubts(const Scene& s, const Frame& last,
                                const std::vector<PlyReport>& plies,
                                const std::vector<ToolCut>& cuts);

} // namespace plyform
