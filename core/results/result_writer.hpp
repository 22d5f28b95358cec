// SPDX-License-Identifier: GPL-3.0-or-later
// Writes the results of a run: summary.json, history.csv, plies/NAME.csv, results.h5 and
// results.xdmf.
//
// The writers depend on Frame and Summary only, not on the simulation that fills them. HDF5 is used
// in hdf5_writer.cpp and hdf5_reader.cpp only. Units of output: mm, N, s, degrees, N per yarn.
#pragma once

#include "core/results/frame.hpp"
#include "core/results/summary.hpp"

#include <filesystem>
#include <memory>

namespace plyform {

/// Writes the folder of a run while it is in progress. Every file is written under a temporary name
/// first and renamed when complete, so that a crash never leaves an incomplete file under its final
/// name; results.h5 is flushed after each frame, so that it can be opened even if the run is
/// killed.
class ResultWriter {
public:
  /// Creates `directory` (and parents). Results of a former run remain there until the first frame.
  /// Throws std::runtime_error naming the path and the reason.
  explicit ResultWriter(const std::filesystem::path& directory);
  ~ResultWriter();

  /// One row of history.csv and one time of results.h5/.xdmf. The first one removes the results of
  /// a former run. Throws std::runtime_error naming the path and the reason (a full disk, names
  /// that occur twice or cannot be file names), std::logic_error if array sizes do not match each
  /// other or the first frame.
  void write_frame(const Frame& frame);

  /// plies/NAME.csv of the last frame, and summary.json with the keys of docs/users/results.md.
  /// Writes `last` as a frame too if the last one written has another time or step. No frame may
  /// follow.
  void write_final(const Frame& last, const Summary& summary);

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Keeps HDF5 from tidying up when the program ends: after a write that failed (a full disk) it
/// tries for ever to close what cannot be closed, and says so. For programs that close their files
/// themselves; to be called before any other use of HDF5.
void leave_hdf5_at_exit();

} // namespace plyform
