// SPDX-License-Identifier: GPL-3.0-or-later
// Writes the results of a run: summary.json, history.csv, plies/NAME.csv, results.h5 and
// results.xdmf.
//
// The writers depend on Frame and Summary only, not on the simulation that fills them. HDF5 is used
// in hdf5_writer.cpp and hdf5_reader.cpp only. Units of output: mm, N, s, degrees, N per yarn.
#pragma once

#include "core/results/frame.hpp"
#include "core/results/size_file.hpp"
#include "core/results/summary.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace plyform {

/// In the folder of results while plyform run works (core/run/progress_file.hpp).
constexpr const char* progress_file_name = "progress.json";

/// Where a run goes on.
struct Resume {
  std::string state; ///< of the solver, as saved
  Frame last;        ///< the last output state before it, without energies
};

/// Writes the folder of a run while it is in progress. Every file is written under a temporary name
/// first and renamed when complete, so that a crash never leaves an incomplete file under its final
/// name. Until the end results.h5 refers to a file for each state (core/results/result_fields.hpp).
class ResultWriter {
public:
  /// Creates `directory` (and parents) and keeps other runs out of it. Results of a former run
  /// remain there until the first frame. Throws std::runtime_error naming the path and the reason,
  /// also if another run writes into it; WouldOverwrite if its files are not all of a run.
  explicit ResultWriter(const std::filesystem::path& directory);
  ~ResultWriter();

  /// Element sizes that the meshes were made by: a file beside the first frame, if there are any.
  void keep_sizes(std::vector<PlySizes> sizes);

  /// Number of frames that the results have so far.
  std::size_t states() const;

  /// One row of history.csv and one time of results.h5/.xdmf. The first one removes the results of
  /// a former run. Throws std::runtime_error naming the path and the reason (a full disk, names
  /// that occur twice or cannot be file names), std::logic_error if array sizes do not match each
  /// other or the first frame.
  void write_frame(const Frame& frame);

  /// Writes the file `checkpoint`, whole or not at all: from it and the frames so far the run can
  /// go on. identity: text that tells this case from others. state: of the solver
  /// (RunHooks::Checkpoint). Throws std::runtime_error naming the path and the reason.
  void write_checkpoint(const std::string& identity, const std::string& state);

  /// Goes on after the frames of the checkpoint, in the place of the first frame; later ones are
  /// removed. Nothing if there is no checkpoint. Throws std::runtime_error naming the path if it is
  /// of another case or damaged.
  std::optional<Resume> go_on(const std::string& identity);

  /// plies/NAME.csv of the last frame, and summary.json with the keys of docs/users/results.md.
  /// Writes `last` as a frame too if the last one written has another time or step. No frame may
  /// follow. Unless the run was interrupted, it cannot go on then.
  void write_final(const Frame& last, const Summary& summary);
  /// Writes summary.json alone, once more.
  void write_summary(const Frame& last, const Summary& summary);

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace plyform
