// SPDX-License-Identifier: GPL-3.0-or-later
// Exports the last state of a run to VTK, STL and CSV.
#pragma once

#include <filesystem>
#include <vector>

namespace plyform {

/// Reads the last state of DIR/results.h5 and writes DIR/export/NAME.vtu, .stl and .csv for
/// each ply and .stl for each tool. Returns the files written. Throws std::runtime_error naming
/// results.h5 and what is wrong with it, before anything is written.
std::vector<std::filesystem::path> export_results(const std::filesystem::path& directory);

} // namespace plyform
