// SPDX-License-Identifier: GPL-3.0-or-later
// What a run leaves behind: summary.json, history.csv, plies/NAME.csv, results.h5 and results.xdmf.
//
// The simulation fills Frame and Summary; the writers here know nothing of how they came about.
// HDF5 types stay inside results_hdf5.cpp. Units at this border: mm, N, s, degrees, N per yarn.
#pragma once

#include "contact/geometry.hpp"
#include "core/draw_in.hpp"
#include "core/ply_frame.hpp"
#include "core/wrinkles.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace plyform {

/// Energies and work done since the start, N mm (mJ). external: work of tools, boundaries and
/// gravity on the plies, and what those held when the run began.
struct Energies {
  double kinetic = 0, fibre = 0, shear = 0, bending = 0, contact = 0, friction = 0, damping = 0,
         external = 0;
  double surplus() const; ///< all kept and lost, less what was put in
  /// (kinetic + fibre + shear + bending + contact + friction + damping - external) over the largest
  /// of them; 0 when all are 0.
  double balance_error() const;
};

struct ToolFrame {
  std::string name;
  Surface surface;                  ///< in space at time 0
  Vec3 displacement = Vec3::Zero(); ///< mm, since time 0
  Vec3 force = Vec3::Zero();        ///< N, that the plies exert on the tool
  double stroke_mm = 0;             ///< displacement along the tool's direction
  double force_N = 0; ///< reaction of the plies against that direction, + when pushed back
};

/// A grip or a frame.
struct BoundaryFrame {
  std::string name;
  double stroke_mm = 0;
  double force_N = 0;        ///< conjugate to the stroke, + when it pulls along it
  Vec3 force = Vec3::Zero(); ///< N, on the plies
};

struct Frame {
  double time = 0;      ///< s
  double stroke_mm = 0; ///< of the first driven tool
  long step = 0;
  std::vector<PlyFrame> plies; ///< topology and names the same in every frame of a run
  std::vector<ToolFrame> tools;
  std::vector<BoundaryFrame> boundaries;
  Energies energy;
};

struct ContactReport {
  double max_tool_penetration_mm = 0, max_ply_penetration_mm = 0; ///< of nodes
  double max_tool_penetration_between_nodes_mm = 0;               ///< core/tool_depth.hpp
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

/// Predicted root mean square error of the shear angle (core/accuracy.hpp), degrees.
struct AccuracyReport {
  double inertia_deg = 0, softening_deg = 0, mesh_deg = 0;
  double promised_deg = 0; ///< all three together; what was asked for, if that is kept
  double coarsening = 1.0; ///< element sizes over those of the case file
};

/// Pressed yarns of one ply: what its membrane shortens by, where real yarns would buckle.
struct PressedYarns {
  double largest = 0;                          ///< strain, 0.01: 1 % shorter; 0 if none is
  double share_above_2 = 0, share_above_5 = 0; ///< of the area before forming, by more than 2, 5 %
  double excess_mm = 0;                        ///< core/ply_plausibility.hpp
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
};

/// Whether a run with this status went all the way to its end.
inline bool ended(std::string_view status) {
  return status == "done" || status == "doubtful";
}

/// Writes a run's folder as it goes. Everything it writes goes to a temporary name first and is
/// renamed when whole, so that a crash never leaves a half file under a final name; results.h5 is
/// flushed after each frame, so that it opens even if the run is killed.
class ResultWriter {
public:
  /// Creates `directory` (and parents). What a former run left there stays until the first frame.
  /// Throws std::runtime_error naming the path and the reason.
  explicit ResultWriter(const std::filesystem::path& directory);
  ~ResultWriter();

  /// One row of history.csv and one time of results.h5/.xdmf. The first one removes the results of
  /// a former run. Throws std::runtime_error naming the path and the reason (a full disk, names
  /// that stand twice or cannot be file names), std::logic_error when sizes do not fit each other
  /// or the first frame.
  void write_frame(const Frame& frame);

  /// plies/NAME.csv of the last frame, and summary.json with the keys of docs/results.md. Writes
  /// `last` as a frame too if the last one written has another time or step. No frame may follow.
  void write_final(const Frame& last, const Summary& summary);

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Reads the last state of DIR/results.h5 back and writes DIR/export/NAME.vtu, .stl and .csv for
/// each ply and .stl for each tool. Returns the files written. Throws std::runtime_error naming
/// results.h5 and what is wrong with it, before anything is written.
std::vector<std::filesystem::path> export_results(const std::filesystem::path& directory);

} // namespace plyform
