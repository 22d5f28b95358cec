// SPDX-License-Identifier: GPL-3.0-or-later
// What a run leaves behind: summary.json, history.csv, plies/NAME.csv, results.h5 and results.xdmf.
//
// The simulation fills Frame and Summary; the writers here know nothing of how they came about.
// HDF5 types stay inside results_hdf5.cpp. Units at this border: mm, N, s, degrees, N per yarn.
#pragma once

#include "core/results/frame.hpp"
#include "core/results/summary.hpp"

#include <filesystem>
#include <memory>

namespace plyform {

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

  /// plies/NAME.csv of the last frame, and summary.json with the keys of docs/users/results.md.
  /// Writes `last` as a frame too if the last one written has another time or step. No frame may
  /// follow.
  void write_final(const Frame& last, const Summary& summary);

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace plyform
