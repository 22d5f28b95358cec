// SPDX-License-Identifier: GPL-3.0-or-later
// The figures of a run in summary.json, described once: name, words, unit and digits are written
// there beside the values, and reports, tables and the workbench read them from it.
#pragma once

#include "core/results/frame.hpp"
#include "core/results/summary.hpp"

#include <string>
#include <variant>
#include <vector>

namespace plyform {

struct Figure : Description {
  bool compared = false; ///< lists of runs show it
  std::string verified;  ///< VerifiedFigure::name before " of NAME"; empty: it never has a band
};

/// A figure with its value: a number, or a place in mm, of the formed ply.
struct FigureValue {
  Figure figure;
  std::variant<double, Vec3> value;
};

/// The figures of a ply that it has, in the order of the file; a name with a dot, a.b, is b within
/// a. `report`: none if only the fields are known. A new figure needs a line there.
std::vector<FigureValue> figures_of(const PlyFrame& ply, const PlyReport* report);

/// Figures of the whole run; names are paths from the top of summary.json.
const std::vector<Figure>& figures_of_runs();

} // namespace plyform
