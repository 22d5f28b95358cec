// SPDX-License-Identifier: GPL-3.0-or-later
// The plies of a preview: meshed, laid, with their yarns.
#pragma once

#include "base/thread_pool.hpp"
#include "core/input/case_file.hpp"
#include "core/setup/scene_preview.hpp"

namespace plyform {

/// Words with which a part says that it has mistakes in these of its keys; "" is the part itself.
std::string trouble_with(std::vector<std::string> keys);

struct LaidPlies {
  std::vector<PlyPreview> plies;   ///< one per ply of the case
  std::vector<FlatPly> flat;       ///< of those that can be drawn
  std::vector<std::size_t> number; ///< their numbers
};

/// data: reading.value or, of a file with mistakes, its sketch.
LaidPlies lay_plies(const Case& data, const CaseReading& reading, ThreadPool& pool);

} // namespace plyform
