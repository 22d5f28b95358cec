// SPDX-License-Identifier: GPL-3.0-or-later
// Sheets of square cells, put anywhere.
#pragma once

#include "base/geometry.hpp"

#include <functional>

namespace plyform {

using Map = std::function<Vec3(double, double)>;

/// nx x ny cells of size h, two triangles a cell, node (x, y) put at map(x, y).
inline TriMesh grid(int nx, int ny, double h, const Map& map) {
  TriMesh sheet;
  for (int j = 0; j <= ny; ++j)
    for (int i = 0; i <= nx; ++i)
      sheet.x.push_back(map(i * h, j * h));
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      const int a = j * (nx + 1) + i, b = a + 1, d = a + nx + 1, c = d + 1;
      sheet.triangles.push_back({a, b, c});
      sheet.triangles.push_back({a, c, d});
    }
  return sheet;
}

} // namespace plyform
