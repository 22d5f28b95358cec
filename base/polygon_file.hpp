// SPDX-License-Identifier: GPL-3.0-or-later
// Points and polygons of mesh files: STL, OBJ, PLY, OFF. The files are not trusted: counts are
// compared with what stands there before anything is allocated, and a file that goes against its
// format is refused with its line, never read in part.
#pragma once

#include "base/geometry.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace plyform {

struct PolygonSoup {
  std::vector<Vec3> points;
  std::vector<std::vector<std::size_t>> polygons; ///< numbers of points, all below their count
};

/// The points (in the file's unit) and polygons of a file, unchanged; which format it has says its
/// extension. Throws std::runtime_error, "what is wrong; what to do" without the file's name:
/// missing, of another kind, empty, truncated, against the format, a coordinate not finite.
PolygonSoup read_polygons(const std::filesystem::path& file);

/// The same of bytes in memory; extension: ".stl", ".obj", ".ply" or ".off".
PolygonSoup parse_polygons(const std::string& extension, std::string_view bytes);

} // namespace plyform
