// SPDX-License-Identifier: GPL-3.0-or-later
// Ends of runs with known figures.
#pragma once

#include "core/verification/bands.hpp"

#include <stdexcept>
#include <string>
#include <vector>

namespace plyform::verify_test {

/// A run of `plies` flat plies with this shear everywhere and this force of the punch.
inline RunEnd end_with(int plies, double shear_deg, double draw_in, double force) {
  RunEnd end;
  for (int p = 0; p < plies; ++p) {
    PlyFrame ply;
    ply.name = "ply" + std::to_string(p + 1);
    ply.x0 = ply.x = {{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0}};
    ply.triangles = {{0, 1, 2}, {0, 2, 3}};
    ply.shear_deg = {shear_deg, shear_deg};
    end.last.plies.push_back(ply);
    PlyReport report;
    report.draw_in.yarns.fill(draw_in * (p + 1));
    report.draw_in.bisectors.fill(draw_in * (p + 1));
    end.plies.push_back(report);
  }
  ToolFrame punch;
  punch.name = "punch", punch.force_N = force;
  end.last.tools = {punch};
  return end;
}

/// Throws std::runtime_error if there is none.
inline const VerifiedFigure& named(const std::vector<VerifiedFigure>& all,
                                   const std::string& name) {
  for (const VerifiedFigure& f : all)
    if (f.name == name) return f;
  throw std::runtime_error("no figure " + name);
}

} // namespace plyform::verify_test
