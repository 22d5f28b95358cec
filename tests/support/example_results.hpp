// SPDX-License-Identifier: GPL-3.0-or-later
// A small made-up run for the tests of the result files: two sheets of different size, a punch that
// moves, a die that stays, and two grips that hold the second sheet. Every value differs from every
// other, so that no mix-up goes unseen.
#pragma once

#include "core/results/result_writer.hpp"

#include <cmath>
#include <string>

namespace plyform::example {

/// A flat grid of `cells` x `cells` squares of 10 mm, two triangles each, at height z.
inline TriMesh sheet(int cells, double z) {
  TriMesh s;
  for (int j = 0; j <= cells; ++j)
    for (int i = 0; i <= cells; ++i)
      s.x.emplace_back(10.0 * i, 10.0 * j, z);
  for (int j = 0; j < cells; ++j)
    for (int i = 0; i < cells; ++i) {
      const int a = j * (cells + 1) + i, b = a + 1, c = a + cells + 1, d = c + 1;
      s.triangles.push_back({a, b, d});
      s.triangles.push_back({a, d, c});
    }
  return s;
}

/// `index` tells plies apart, `time` in s drives everything.
inline PlyFrame ply(const std::string& name, int cells, int index, double time) {
  PlyFrame p;
  const TriMesh s = sheet(cells, index);
  p.name = name;
  p.angle_deg = 45.0 * index;
  p.x0 = p.x = s.x;
  p.triangles = s.triangles;
  for (std::size_t i = 0; i < p.x.size(); ++i) {
    p.x[i] += time * Vec3(0.1 * p.x[i].y(), 0.01 * p.x[i].x(), std::sin(p.x[i].x()) / 3.0);
    p.contact_pressure.push_back(time * (0.001 * static_cast<double>(i) + index));
  }
  FamilyFrame warp{"warp", p.angle_deg, {}, {}, {}}, weft{"weft", p.angle_deg + 90.0, {}, {}, {}};
  for (std::size_t i = 0; i < p.triangles.size(); ++i) {
    const double k = static_cast<double>(i) + 100.0 * index;
    const double shear = (i % 2 ? -1 : 1) * time * (1.0 + k / 7.0);
    p.shear_deg.push_back(shear);
    warp.direction.emplace_back(std::cos(0.01 * k), std::sin(0.01 * k), 0.0);
    weft.direction.emplace_back(-std::sin(0.02 * k), std::cos(0.02 * k), 0.0);
    warp.strain.push_back(1e-4 * time * k);
    weft.strain.push_back(-2e-4 * time * k);
    warp.tension.push_back(3.0 * time * k);
    weft.tension.push_back(5.0 * time * k);
    p.thickness.push_back(0.3 + 0.001 * k);
  }
  p.families = {warp, weft};
  return p;
}

/// The names hold what names of people hold: spaces, a degree sign, an ampersand.
inline Frame frame(double time) {
  Frame f;
  f.time = time;
  f.stroke_mm = 50 * time;
  f.step = std::lround(1000 * time);
  f.plies = {ply("lower", 3, 0, time), ply("90\u00b0 ply & co", 4, 1, time)};
  ToolFrame punch{"punch",   sheet(2, 30), {0, 0, -50 * time}, {1, 2, 400 * time},
                  50 * time, 400 * time,   420 * time};
  ToolFrame die{"die", sheet(1, -5), Vec3::Zero(), {0, 0, -30 * time}, 0, -30 * time, -28 * time};
  f.tools = {punch, die};
  for (std::size_t i = 0; i < f.plies[1].x.size(); ++i) // the first ply is held by none
    f.plies[1].reaction.push_back(time * Vec3(static_cast<double>(i), 0.25, -3.0));
  f.boundaries = {{"grip", 8 * time, 70 * time, {70 * time, -7 * time, 0.5 * time}},
                  {"clamp", 0, -9 * time, {-9 * time, 0, 11 * time}}};
  f.energy = {1 * time, 2 * time, 3 * time, 0, 0, 4 * time, 5 * time, 6 * time, 0, 20 * time};
  return f;
}

} // namespace plyform::example
