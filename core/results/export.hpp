// SPDX-License-Identifier: GPL-3.0-or-later
// Exports states of a run to VTK, STL and CSV.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

namespace plyform {

struct ExportChoice {
  bool vtu = true, stl = true, csv = true;
  bool all = false;               ///< every state
  std::optional<long> frame{};    ///< this state: from 0, or -1 for the last
  std::filesystem::path folder{}; ///< for the files; DIR/export if it is empty
  /// Called before each state with the fraction that is done.
  std::function<void(double fraction)> progress{};
};

/// Reads the last state of DIR/results.h5, or those of the choice, and writes FOLDER/NAME.vtu,
/// .stl and .csv for each ply and .stl for each tool; NAME_000012.vtu and so on where states were
/// chosen. Returns the files written. Throws std::runtime_error naming results.h5 and what is wrong
/// with it, before anything of that state is written; WouldOverwrite for a file of the run.
std::vector<std::filesystem::path> export_results(const std::filesystem::path& directory,
                                                  const ExportChoice& choice = {});

} // namespace plyform
