// SPDX-License-Identifier: GPL-3.0-or-later
// Puts the results of one run in the place of another's.
#pragma once

#include <filesystem>
#include <vector>

namespace plyform {

/// The files of a run that has ended, as paths within its folder: summary.json, history.csv,
/// results.h5, results.xdmf and the tables of plies, those that are there.
std::vector<std::filesystem::path> files_of_run(const std::filesystem::path& folder);

/// Moves the results in `folder` to `former`, replacing what a run has left there, then those in
/// `second`, a folder within it, to `folder`, and removes `second`. Both runs have ended. Whenever
/// it is cut off, each run is whole or in two folders with nothing lost. Throws std::runtime_error
/// naming the path and the reason.
void replace_run(const std::filesystem::path& folder, const std::filesystem::path& second,
                 const std::filesystem::path& former);

} // namespace plyform
