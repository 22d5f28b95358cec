// SPDX-License-Identifier: GPL-3.0-or-later
// What result_writer.hpp is made of: texts and files of results, and their reader.
#pragma once

#include "core/results/history.hpp"
#include "core/results/result_writer.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace plyform {

/// Throws std::runtime_error when a name cannot stand as a file name or stands twice, and
/// std::logic_error when an array of a ply has not as many entries as its nodes or triangles.
void check_frame(const Frame& frame);

/// The content of plies/NAME.csv: a header line and one row per triangle.
std::string ply_table(const PlyFrame& ply);

/// The content of summary.json: always valid JSON, numbers that are not finite as null.
std::string summary_json(const Frame& last, const Summary& summary);

/// A name that has passed check_frame as it stands in XML.
std::string xml_text(std::string_view name);

/// Text of results.xdmf, to which each frame is added.
struct XdmfText {
  std::vector<std::string> names; ///< of the plies, then of the tools
  std::vector<std::string> grids; ///< for each name, its grids, one per frame

  /// `index` is the number of the frame in results.h5.
  void add(const Frame& frame, std::size_t index);
  std::string document() const;
};

/// Path of frame `index` in results.h5: /frames/000012.
std::string frame_group(std::size_t index);

/// What results.h5 says of all of its frames: names, and times (s), strokes (mm) and steps.
struct StateIndex {
  std::vector<std::string> plies, tools, boundaries;
  std::vector<double> time, stroke;
  std::vector<std::int64_t> step;
  std::string shape; ///< names and mesh sizes, which do not change during a run
  std::vector<Series> history{};
};

// While a run is in progress, each state is a file of its own, states/000012.h5, and results.h5
// refers to them by links, which readers follow. So no file is ever changed, and whatever happens
// leaves whole files. At the end results.h5 is made of all of them. core/results/hdf5_writer.cpp
// writes these files, each whole or not at all; all throw std::runtime_error naming the path and
// the reason.

/// Paths from the folder of results.h5: of the meshes, of a state.
std::filesystem::path constants_file();
std::filesystem::path state_file(std::size_t index);

void write_constants(const std::filesystem::path& path, const Frame& frame);
void write_state(const std::filesystem::path& path, const Frame& frame, std::size_t index);
/// results.h5 with links to the files of all states, which stand beside it; or with copies of them.
void write_linked(const std::filesystem::path& path, const StateIndex& index);
void write_merged(const std::filesystem::path& path, const StateIndex& index);

/// The states of a run in progress: results.h5 and the folder states beside it.
class StateFiles {
public:
  explicit StateFiles(const std::filesystem::path& directory) : directory_(directory) {}

  /// Writes one frame. Throws as the functions above, std::logic_error if its names or sizes differ
  /// from the first frame's.
  void append(const Frame& frame);

  /// Goes on after the frames of `index`, which must be there; later ones are removed. Throws
  /// std::runtime_error naming the path if one is missing.
  void go_on(const StateIndex& index);

  /// Makes one file of all; the folder states stays. Throws as the functions above; then the files
  /// stay as they were.
  void merge();

  const StateIndex& index() const { return index_; }
  std::size_t frames() const { return index_.step.size(); }

private:
  std::filesystem::path directory_;
  StateIndex index_;
};

/// Removes the folder states of a run: only files that runs write. Throws std::runtime_error.
void remove_states(const std::filesystem::path& directory, std::size_t first = 0);

/// A whole frame of a results.h5: from 0, or -1 for the last, -2 for the one before. The energies
/// are not read and stay 0. Throws std::runtime_error naming the path and what is wrong with it.
Frame read_frame(const std::filesystem::path& path, long index);
/// How many frames a results.h5 has. Throws as read_frame.
long count_frames(const std::filesystem::path& path);
inline Frame read_last_frame(const std::filesystem::path& path) {
  return read_frame(path, -1);
}

} // namespace plyform
