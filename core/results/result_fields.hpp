// SPDX-License-Identifier: GPL-3.0-or-later
// The parts behind result_writer.hpp: files that appear whole or not at all, and results.h5. For
// the .cpp files of this folder and their tests only.
#pragma once

#include "core/results/result_writer.hpp"

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace plyform {

/// Writes `content` to `path` + ".tmp" and renames it to `path` when it is whole. Throws
/// std::runtime_error naming the path and the system's reason; the temporary file is then gone.
void write_whole(const std::filesystem::path& path, std::string_view content);

/// Throws std::runtime_error when a name cannot stand as a file name or stands twice, and
/// std::logic_error when an array of a ply has not as many entries as its nodes or triangles.
void check_frame(const Frame& frame);

/// The content of plies/NAME.csv: a header line and one row a triangle.
std::string ply_table(const PlyFrame& ply);

/// The content of summary.json: always valid JSON, numbers that are not finite as null.
std::string summary_json(const Frame& last, const Summary& summary);

/// results.xdmf as it grows with the frames.
struct XdmfText {
  std::vector<std::string> names; ///< of the plies, then of the tools
  std::vector<std::string> grids; ///< for each name, one grid a frame

  /// `index` is the number of the frame in results.h5.
  void add(const Frame& frame, std::size_t index);
  std::string document() const;
};

/// Where frame `index` stands in results.h5: /frames/000012.
std::string frame_group(std::size_t index);

/// results.h5 of a run in progress. The file has its final name from the first whole frame on.
class StateFile {
public:
  explicit StateFile(std::filesystem::path path);
  ~StateFile();

  /// Writes and flushes one frame. Throws std::runtime_error naming the path and the reason.
  void append(const Frame& frame);

  /// Closes the file, so that an error of the last bytes is still heard of.
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
