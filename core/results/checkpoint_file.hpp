// SPDX-License-Identifier: GPL-3.0-or-later
// The file `checkpoint` in the folder of a run in progress, from which it can go on.
#pragma once

#include "core/results/result_fields.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace plyform {

/// What a ResultWriter has to know of what it has written.
struct WriterState {
  StateIndex states;
  std::string history; ///< all of history.csv
  XdmfText xdmf;
  double last_time = 0.0; ///< s
  long last_step = 0;
};

struct Checkpoint {
  std::string identity; ///< of the case
  WriterState writer;
  std::string solver; ///< its state, as bytes
};

/// Writes a Checkpoint of these. Throws std::runtime_error naming the path and the reason.
void write_checkpoint_file(const std::filesystem::path& path, std::string identity,
                           WriterState writer, std::string_view solver);

/// FNV-1a, 64 bits (Fowler, Noll, Vo; RFC 9923), of what a checkpoint holds. It tells damage, not
/// intent. sum: of the bytes before these.
std::uint64_t checkpoint_sum(std::string_view bytes, std::uint64_t sum = 14695981039346656037ULL);

/// Nothing if there is no such file. Throws std::runtime_error naming the path if it is damaged, or
/// not of a case with this identity; whatever its checksum says, sizes, names and times are
/// checked.
std::optional<Checkpoint> read_checkpoint_file(const std::filesystem::path& path,
                                               const std::string& identity);

} // namespace plyform
