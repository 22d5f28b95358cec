// SPDX-License-Identifier: GPL-3.0-or-later
// Report on each ply, and checks whether the results are plausible for cloth.
//
// Woven yarns hardly bear compression: they buckle. Buckling that the mesh is too coarse to resolve
// appears in the results as shortening of the yarn. The excess length of a ply is the largest, over
// straight lines of the undeformed ply along warp and weft, 2 mm apart or less, of
//   e = integral of max(0, -strain) ds,  mm                                                     (1)
// that is, by how much that yarn is longer than its path in the mesh. Gathered in one wrinkle of
// wavelength w (mm) it would have the height (2/pi) sqrt(w e). Of yarns with crimp the strain
// counts from where they cannot take more of it (core/model/crimp.hpp).
#pragma once

#include "core/results/result_writer.hpp"
#include "core/run/astray_forces.hpp"
#include "core/run/facet_penetration.hpp"
#include "core/solver/scene.hpp"

#include <string>
#include <vector>

namespace plyform {

/// Woven plies with yarns shortened by more than 5 % (PressedYarns::share_above_5) on more than
/// this share of their area are doubtful; on less it is a local effect.
constexpr double doubtful_pressed_share = 0.02;

/// Relative energy balance error of a run beyond which its forces are doubtful.
constexpr double doubtful_balance_error = 0.01;

/// Forces astray over the edges of a tool (core/run/astray_forces.hpp), of the load that draws
/// the plies, beyond which forces are doubtful.
constexpr double doubtful_astray_share = 0.2;

/// Properties of a ply that report_ply needs besides its frame.
struct PlyNature {
  bool has_yarns = true;
  std::optional<double> locking_angle_deg = std::nullopt;
  std::vector<std::optional<double>> opening_limits = {}; ///< of its families, or empty: none
  std::vector<Crossing> crossings = {};                   ///< of its families
  std::optional<double> stretch_limit = std::nullopt;
  std::optional<double> measured_rate = std::nullopt; ///< 1/s, the highest
};

PlyReport report_ply(const PlyFrame& ply, const PlyNature& nature,
                     const std::vector<const ToolBody*>& tools);

/// The reports of all plies of `last`, the frame of the scene in its present state.
std::vector<PlyReport> report_plies(const Scene& s, const Frame& last);

/// Reasons to doubt forces: of tools that press the plies between them (known: per tool), or over
/// whose edges the mesh does not follow (astray: likewise).
std::vector<std::string> doubts_of_forces(const Scene& s, const std::vector<KnownForce>& known,
                                          const std::vector<AstrayForce>& astray);

/// Reasons to doubt the result and what to do about each, one sentence each; empty if there is
/// none. cuts: those of facet_penetration.hpp in the same state.
std::vector<std::string> doubts(const Scene& s, const Frame& last,
                                const std::vector<PlyReport>& plies,
                                const std::vector<ToolCut>& cuts);

} // namespace plyform
