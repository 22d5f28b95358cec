// SPDX-License-Identifier: GPL-3.0-or-later
// progress.json in the folder of results while a run works: what it does and how far it is, for
// programs that show runs which others have started. Keys: docs/users/results.md.
#pragma once

#include "base/time_left.hpp"
#include "core/run/run.hpp"

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

namespace plyform {

enum class RunPhase { checking, meshing, forming, verifying, correcting };

/// Keeps the file, and removes it in the end. A run can do without it: what cannot be written is
/// left.
class ProgressFile {
public:
  /// folder: of a ResultWriter, which keeps other runs out; while both exist.
  ProgressFile(const std::filesystem::path& folder, const std::filesystem::path& case_file);
  ~ProgressFile();
  ProgressFile(const ProgressFile&) = delete;
  ProgressFile& operator=(const ProgressFile&) = delete;

  /// Writes at once. words: what the run does now, a plain sentence.
  void begin(RunPhase phase, const std::string& words);

  /// Writes twice a second at most. fraction: of the phase, 0 to 1; states: written so far.
  void show(const Progress& progress, double fraction, std::size_t states);

private:
  using Clock = std::chrono::steady_clock;
  void write();

  std::filesystem::path path_, case_file_;
  RunPhase phase_ = RunPhase::checking;
  std::string words_;
  std::optional<Progress> progress_; ///< of the phase, once known
  double fraction_ = 0.0;
  std::size_t states_ = 0;
  Clock::time_point begin_ = Clock::now(), written_{};
  TimeLeft left_;
};

} // namespace plyform
