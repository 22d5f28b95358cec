// SPDX-License-Identifier: GPL-3.0-or-later
// Internal to core/results and its tests: functions and classes that result_writer.hpp is made of.
#pragma once

#include "core/results/result_writer.hpp"

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace plyform {

/// Writes `content` to `path` + ".tmp" and renames it to `path` when it is complete. Throws
/// std::runtime_error naming the path and the system's reason; the temporary file is then removed.
void write_whole(const std::filesystem::path& path, std::string_view content);

/// Throws std::runtime_error when a name cannot stand as a file name or stands twice, and
/// std::logic_error when an array of a ply has not as many entries as its nodes or triangles.
void check_frame(const Frame& frame);

/// The content of plies/NAME.csv: a header line and one row per triangle.
std::string ply_table(const PlyFrame& ply);

/// The content of summary.json: always valid JSON, numbers that are not finite as null.
std::string summary_json(const Frame& last, const Summary& summary);

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

/// results.h5 of a run in progress. The file gets its final name with its first complete frame.
class StateFile {
public:
  explicit StateFile(std::filesystem::path path);
  ~StateFile();

  /// Writes and flushes one frame. Throws std::runtime_error naming the path and the reason.
  void append(const Frame& frame);

  /// Closes the file. Throws std::runtime_error if the last bytes cannot be written.
  void close();

  std::size_t frames() const;

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// A whole frame of a results.h5: from 0, or -1 for the last, -2 for the one before. The energies
/// are not stored and stay 0. Throws std::runtime_error naming the path and what is wrong with it.
Frame read_frame(const std::filesystem::path& path, long index);
inline Frame read_last_frame(const std::filesystem::path& path) {
  return read_frame(path, -1);
}

} // namespace plyform
