// SPDX-License-Identifier: GPL-3.0-or-later
// What a run has come to, in numbers and sentences: the content of summary.json.
#pragma once

#include "core/results/draw_in.hpp"
#include "core/results/wrinkles.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace plyform {

struct ContactReport {
  double max_tool_penetration_mm = 0, max_ply_penetration_mm = 0; ///< of nodes
  double max_tool_penetration_between_nodes_mm = 0; ///< core/solver/facet_penetration.hpp
  long intersections_between_plies = 0, intersections_within_plies = 0;
};

/// What one pair of bodies did in a run, or a ply with itself.
struct PairReport {
  std::string a, b;
  double time_share = 0; ///< of the computing time, search included
  double deepest_mm = 0; ///< since the start; 0 if they never touched
  double slip_mm = 0;    ///< longest way that a contact slid while it lasted
  double friction_coefficient = 0, friction_mJ = 0;
  bool touched() const { return deepest_mm > 0; }
};

/// What a run did with its time, and what it modelled too much or too little.
struct WorkReport {
  /// Of the computing time of all threads; the rest moves nodes.
  double elements_share = 0, contact_share = 0, search_share = 0;
  long searches = 0; ///< broad phases
  std::vector<PairReport> pairs;
  std::vector<std::string> could_be_left_out, missing; ///< a sentence each
};

/// Predicted root mean square error of the shear angle (core/accuracy/error_model.hpp), degrees.
struct AccuracyReport {
  double inertia_deg = 0, softening_deg = 0, mesh_deg = 0;
  double promised_deg = 0; ///< all three together; what was asked for, if that is kept
  double coarsening = 1.0; ///< element sizes over those of the case file
};

/// Pressed yarns of one ply: what its membrane shortens by, where real yarns would buckle.
struct PressedYarns {
  double largest = 0;                          ///< strain, 0.01: 1 % shorter; 0 if none is
  double share_above_2 = 0, share_above_5 = 0; ///< of the area before forming, by more than 2, 5 %
  double excess_mm = 0;                        ///< core/solver/ply_plausibility.hpp
  Vec3 excess_at = Vec3::Zero();               ///< mm, where that yarn is pressed most, formed
};

/// What each ply has come to, and whether cloth can be like that.
struct PlyReport {
  std::optional<PressedYarns> pressed; ///< none of a sheet without yarns
  Wrinkle wrinkle;
  std::optional<double> beyond_locking_share; ///< of the area before forming; if the angle is known
  DrawIn draw_in;
};

struct Summary {
  std::string title, version;
  /// done; doubtful: it ended, but not all of it can be true; interrupted; stopped
  std::string status = "done";
  std::string message; ///< why it was stopped, or what not to trust; else empty
  double wall_time_s = 0;
  long steps = 0;
  double min_step_s = 0, max_step_s = 0;
  int threads = 1;
  AccuracyReport accuracy;
  ContactReport contact;
  WorkReport work;
  std::vector<PlyReport> plies; ///< one each of the last frame's, or empty: not known
  /// A sentence each: estimates in the place of what the case does not have, and what of it was not
  /// taken as it stands (core/model/fabric_estimates.hpp).
  std::vector<std::string> assumed;
};

/// Whether a run with this status went all the way to its end.
inline bool ended(std::string_view status) {
  return status == "done" || status == "doubtful";
}

} // namespace plyform
