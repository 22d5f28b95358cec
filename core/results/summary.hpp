// SPDX-License-Identifier: GPL-3.0-or-later
// Summary of a run in numbers and sentences: the content of summary.json.
#pragma once

#include "core/results/bridging.hpp"
#include "core/results/broken_stitches.hpp"
#include "core/results/draw_in.hpp"
#include "core/results/mould_fill.hpp"
#include "core/results/verification.hpp"
#include "core/results/wrinkles.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace plyform {

struct ContactReport {
  double max_tool_penetration_mm = 0, max_ply_penetration_mm = 0; ///< of nodes
  double max_tool_penetration_between_nodes_mm = 0; ///< core/run/facet_penetration.hpp
  long intersections_between_plies = 0, intersections_within_plies = 0;
};

/// Where in a curve of friction a run was while it slid.
struct CurveRange {
  double least = 0, most = 0;              ///< that it was at; mm, 1/s or degC
  double first = 0, last = 0;              ///< ends of the curve; both 0: there is none
  double below_share = 0, above_share = 0; ///< of the work of sliding, outside these ends
};

/// Contact of one pair of bodies, or of a ply with itself, over a run.
struct PairReport {
  std::string a, b;
  double time_share = 0; ///< fraction of the computing time, search included
  double deepest_mm = 0; ///< since the start; 0 if they never touched
  double slip_mm = 0;    ///< largest sliding distance of a contact while it was closed
  double friction_coefficient = 0, friction_mJ = 0;
  std::string friction_law;                    ///< that holds instead of the coefficient, if any
  std::optional<CurveRange> hersey, film_rate; ///< Hersey numbers, mm; rates of the film, 1/s
  std::optional<CurveRange> film_temperature;  ///< degC, where its viscosity follows it
  double unsteady_share = 0; ///< of the work of sliding, at speeds at which friction falls and that
                             ///< did not stay: contact/forces/friction_law.hpp
  bool touched() const { return deepest_mm > 0; }
};

/// Computing time of a run by kind of work, and effects that its model could leave out or lacks.
struct WorkReport {
  /// Fractions of the computing time of all threads; the rest is the time integration.
  double elements_share = 0, contact_share = 0, search_share = 0;
  long searches = 0; ///< number of contact searches
  std::vector<PairReport> pairs;
  std::vector<std::string> could_be_left_out, missing; ///< a sentence each
};

/// Predicted root mean square error of the shear angle (core/accuracy/error_model.hpp), degrees;
/// NaN where the rule does not hold.
struct AccuracyReport {
  double inertia_deg = 0, softening_deg = 0, mesh_deg = 0;
  double promised_deg = 0; ///< PredictedError::promised
  double coarsening = 1.0; ///< element sizes over those of the case file
  std::string unknown;     ///< why nothing is predicted, a clause; else empty
};

/// Compressed yarns of one ply: shortening in its membrane where real yarns would buckle.
struct PressedYarns {
  double largest = 0;                          ///< largest compressive strain, 0.01 = 1 %; 0: none
  double share_above_2 = 0, share_above_5 = 0; ///< fraction of the area before forming, > 2, 5 %
  double excess_mm = 0;                        ///< core/run/ply_plausibility.hpp
  Vec3 excess_at = Vec3::Zero();               ///< mm, formed, where that yarn is compressed most
};

/// How far apart the yarns of a family have come, across them in the sheet.
struct Opening {
  std::string family;
  double largest = 0;                      ///< of the distance between neighbours, 0.1 = 10 %
  Vec3 at = Vec3::Zero();                  ///< mm, formed, where that is
  std::optional<double> limit;             ///< of the family, if it has one
  double beyond_mm2 = 0, beyond_share = 0; ///< of the area before forming
};

/// Measures of each ply that show whether the result is plausible for cloth.
struct PlyReport {
  std::optional<PressedYarns> pressed; ///< none of a sheet without yarns
  Wrinkle wrinkle;
  std::optional<Bridging> bridging; ///< none where nothing could bridge
  std::optional<FibreVolume> fibre_volume;
  std::optional<MouldFill> mould;
  std::optional<double> locking_angle_deg;    ///< of the fabric, if it is known
  std::optional<double> beyond_locking_share; ///< fraction of the area before forming; likewise
  std::vector<Opening> openings;              ///< of the families for which it is told
  std::optional<double> max_stretch;          ///< of rubber
  std::optional<double> stretch_limit;        ///< of the fabric, if it is known
  std::optional<double> beyond_stretch_share; ///< fraction of the area before forming; likewise
  std::optional<double> max_shear_rate;       ///< 1/s of the process, of laws with rates
  std::optional<double> measured_shear_rate;  ///< up to which the law was measured, if it is known
  std::optional<double> beyond_rate_share;    ///< fraction of the area before forming; likewise
  DrawIn draw_in;
  std::vector<BrokenStitches> stitches; ///< one for each direction
};

/// Up to where the force of a tool is known: to the last output at which it did not press the plies
/// against another tool (core/run/pressed_stack.hpp).
struct KnownForce {
  double stroke_mm = std::numeric_limits<double>::infinity();
  double time_s = std::numeric_limits<double>::infinity(); ///< infinite: to the end
  bool to_end() const { return time_s == std::numeric_limits<double>::infinity(); }
};

/// How a tool that is pushed by a force came to rest.
struct PushedTool {
  std::string name;
  double speed_mm_s = 0; ///< along its direction at the end, of the simulated time
  bool at_rest = true; ///< in a twentieth of the run's time it would come less than 0.01 mm further
};

struct Summary {
  std::string title, version;
  /// done; doubtful: it ended, but there are reasons to doubt the result; instant: each ply was
  /// formed alone (core/setup/instant.hpp); interrupted; stopped
  std::string status = "done";
  std::string message; ///< why it was stopped, or is doubtful; else empty
  double wall_time_s = 0;
  long steps = 0;
  double min_step_s = 0, max_step_s = 0;
  double largest_added_mass = 0; ///< by mass scaling, share of the mass of any ply, at any time
  double element_added_mass = 0; ///< to small elements, largest share of the mass of any ply
  int threads = 1;
  AccuracyReport accuracy;
  double motion_share = 0; ///< largest_motion (core/run/ply_motion.hpp) at the end
  Verification verification;
  ContactReport contact;
  WorkReport work;
  std::vector<KnownForce> known_forces; ///< one per tool, or empty: all to the end
  std::vector<PlyReport> plies;         ///< one per ply of the last frame, or empty: not known
  /// A sentence each: estimates of values that the case does not give, and values that were limited
  /// (core/model/fabric_estimates.hpp, assumptions).
  std::vector<std::string> assumed;
  /// keys of the case with their values (core/input/keys/given_values.hpp); may be empty: not known
  std::vector<std::pair<std::string, std::string>> given;
  bool flies = false; ///< a ply at the end: core/run/ply_motion.hpp
  /// What not to trust, a sentence each, as WorkReport::missing begins; any makes a run that ended
  /// doubtful.
  std::vector<std::string> doubts = {};
  std::vector<PushedTool> pushed = {};
};

/// What would make the result better, a sentence each: what follows the doubts.
inline std::vector<std::string> advice_of(const Summary& summary) {
  const std::vector<std::string>& all = summary.work.missing;
  return {all.begin() + static_cast<std::ptrdiff_t>(std::min(summary.doubts.size(), all.size())),
          all.end()};
}

/// Whether a run with this status reached its end time.
inline bool ended(std::string_view status) {
  return status == "done" || status == "doubtful" || status == "instant";
}

} // namespace plyform
