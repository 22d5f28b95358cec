// SPDX-License-Identifier: GPL-3.0-or-later
// The file mesh_sizes.txt in the folder of a run whose meshes came from the scene: the element
// sizes wanted in each ply, so that resumed runs, siblings and studies need not scout again.
//
//   plyform mesh sizes 1
//   ply X Y SPACING COLUMNS ROWS NAME       origin, spacing (mm) and size of the grid
//   SIZE ...                                COLUMNS ROWS of them, mm, as SizeGrid::size
#pragma once

#include "core/model/blank_spec.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace plyform {

struct PlySizes {
  std::string ply;
  SizeGrid sizes;
};

inline constexpr const char* size_file_name = "mesh_sizes.txt";

std::string text_of(const std::vector<PlySizes>& plies);

/// Writes text_of, whole or not at all. Throws std::runtime_error naming the path and the reason.
void write_sizes(const std::filesystem::path& file, const std::vector<PlySizes>& plies);

/// Reads them, from a file or the folder of a run. Throws std::runtime_error naming the path, and
/// what is wrong: missing, damaged, of another program; sizes that are not above 0.
std::vector<PlySizes> read_sizes(const std::filesystem::path& path);

} // namespace plyform
