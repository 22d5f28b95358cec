// SPDX-License-Identifier: GPL-3.0-or-later
// Made-up formed plies for the tests of what results say of a ply.
#pragma once

#include "core/model/ply_frame.hpp"

#include <cmath>
#include <functional>
#include <numbers>

namespace plyform::sheets {

/// A sheet of `columns` x `rows` squares of side h whose middle is the origin, diagonals turned
/// from square to square, with its mesh and its warp turned by angle_deg; formed by `shape`. All
/// fields of its triangles are 0.
inline PlyFrame sheet(int columns, int rows, double h, double angle_deg,
                      const std::function<Vec3(const Vec2&)>& shape) {
  PlyFrame ply;
  ply.name.assign(1, 'p');
  ply.angle_deg = angle_deg;
  const Eigen::Rotation2Dd turn(angle_deg * std::numbers::pi / 180.0);
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i <= columns; ++i) {
      const Vec2 place = turn * Vec2((i - 0.5 * columns) * h, (j - 0.5 * rows) * h);
      ply.x0.emplace_back(place.x(), place.y(), 0.0);
      ply.x.push_back(shape(place));
    }
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const int a = j * (columns + 1) + i, b = a + 1, c = a + columns + 1, d = c + 1;
      if ((i + j) % 2)
        ply.triangles.insert(ply.triangles.end(), {{a, b, d}, {a, d, c}});
      else
        ply.triangles.insert(ply.triangles.end(), {{a, b, c}, {b, d, c}});
    }
  const std::size_t m = ply.triangles.size();
  ply.shear_deg.assign(m, 0.0);
  for (const bool weft : {false, true}) {
    const Vec2 along = turn * (weft ? Vec2(0.0, 1.0) : Vec2(1.0, 0.0));
    ply.families.push_back({weft ? "weft" : "warp", angle_deg + (weft ? 90.0 : 0.0),
                            std::vector<Vec3>(m, Vec3(along.x(), along.y(), 0.0)), ply.shear_deg,
                            ply.shear_deg});
  }
  ply.thickness.assign(m, 0.6);
  ply.contact_pressure.assign(ply.x.size(), 0.0);
  return ply;
}

inline Vec3 flat(const Vec2& p) {
  return {p.x(), p.y(), 0.0};
}

/// Centroid of a triangle before forming, seen from above, mm.
inline Vec2 centre(const PlyFrame& ply, std::size_t t) {
  Vec3 sum = Vec3::Zero();
  for (const std::int32_t k : ply.triangles[t])
    sum += ply.x0[k];
  return sum.head<2>() / 3.0;
}

} // namespace plyform::sheets
