// SPDX-License-Identifier: GPL-3.0-or-later
// What a run looks like between two output states, for programs that watch it: picture.bin in the
// folder of results, drawn when one of them has made the file picture.ask there. Layout:
// docs/users/results.md.
#pragma once

#include "core/results/frame.hpp"

#include <chrono>
#include <filesystem>
#include <string>

namespace plyform {

/// The bytes of picture.bin. scouting: the run of the scout that it is of, from 1, whose plies have
/// other meshes than the results, which the picture therefore holds; 0: of the run itself.
std::string picture_of(const Frame& frame, int scouting = 0);

/// Answers those who watch a run, and removes the files in the end. A run can do without it: what
/// cannot be written is left.
class LivePicture {
public:
  explicit LivePicture(const std::filesystem::path& folder);
  ~LivePicture();
  LivePicture(const LivePicture&) = delete;
  LivePicture& operator=(const LivePicture&) = delete;

  /// Whether somebody asks. Looks four times a second at most, and less often where pictures take
  /// long: a twentieth of the run's time.
  bool asked();

  /// scouting: as in picture_of.
  void draw(const Frame& frame, int scouting = 0);

private:
  using Clock = std::chrono::steady_clock;
  std::filesystem::path ask_, picture_;
  Clock::time_point next_{}, begin_{};
};

} // namespace plyform
