// SPDX-License-Identifier: GPL-3.0-or-later
// The file `checkpoint` in the folder of a run in progress, from which it can go on.
#pragma once

#include "core/results/result_fields.hpp"

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

/// Nothing if there is no such file. Throws std::runtime_error naming the path if it is damaged, or
/// not of a case with this identity.
std::optional<Checkpoint> read_checkpoint_file(const std::filesystem::path& path,
                                               const std::string& identity);

} // namespace plyform
