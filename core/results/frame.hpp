// SPDX-License-Identifier: GPL-3.0-or-later
// One state of a run, as it is output. Units of output: mm, N, s, degrees, N per yarn.
#pragma once

#include "core/model/energies.hpp"
#include "core/model/ply_frame.hpp"

#include <string>
#include <vector>

namespace plyform {

struct ToolFrame {
  std::string name;
  TriMesh surface;                  ///< in space at time 0
  Vec3 displacement = Vec3::Zero(); ///< mm, since time 0
  Vec3 force = Vec3::Zero();        ///< N, of the plies on the tool, filtered: force_filter.hpp
  double stroke_mm = 0;             ///< displacement along the tool's direction
  double force_N = 0;     ///< reaction of the plies against that direction, + when pushed back
  double force_raw_N = 0; ///< the same of the last step alone, with the jitter of contact
};

/// A grip, a frame, a spring or a gripper.
struct BoundaryFrame {
  std::string name;
  double stroke_mm = 0; ///< of a spring: how much longer it is than at the start
  double force_N = 0;   ///< conjugate to the stroke, + when it pulls along it; of a spring tension
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
  bool films = false; ///< whether bodies slide on films: Energies::film is then shown
};

} // namespace plyform
