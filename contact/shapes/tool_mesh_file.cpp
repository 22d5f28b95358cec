// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/format.hpp"
#include "contact/shapes/tool_mesh.hpp"

#include <cmath>
#include <stdexcept>

namespace plyform {

MeshShapePtr load_tool_mesh(const std::filesystem::path& file, double scale, MeshReport* report) {
  const std::string name = fmt::format("tool mesh {}", file.string());
  if (!(scale > 0.0) || !std::isfinite(scale))
    throw std::runtime_error(fmt::format("{}: scale = {:g} must be a finite number above 0; 1000 "
                                         "turns metres into millimetres",
                                         name, scale));
  PolygonSoup soup;
  try {
    soup = read_polygons(file);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(name + ": " + error.what());
  }
  for (Vec3& p : soup.points)
    p *= scale;
  return make_mesh_shape(std::move(soup), name, report);
}

} // namespace plyform
