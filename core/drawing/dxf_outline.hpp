// SPDX-License-Identifier: GPL-3.0-or-later
// Outlines of blanks from DXF drawings.
#pragma once

#include "core/model/blank_spec.hpp"

#include <filesystem>
#include <limits>
#include <optional>
#include <string>

namespace plyform {

struct DxfRequest {
  std::filesystem::path file;
  std::string layer;           ///< empty: all
  std::optional<double> scale; ///< mm per unit of the drawing; nothing: as its $INSUNITS says
  /// mm, longest piece of an ellipse or spline; corners and eighths of a turn have points anyway
  double spacing = std::numeric_limits<double>::infinity();
};

struct DxfOutline {
  Outline outline;         ///< mm
  std::string description; ///< "blank.dxf: 4 lines and arcs on layer CUT, in mm"
};

/// mm per unit that the description of a drawing without a `scale` names; 1 if it names none.
double unit_named_in(const std::string& description);

/// Ends of lines and arcs nearer than this are one point, mm.
inline constexpr double dxf_join = 0.01;

/// Reads lines, arcs, circles, ellipses, splines and polylines with bulges, joins them to closed
/// loops, and takes the largest for the outline and those in it for its holes. Throws
/// std::runtime_error ("file: rule; remedy", with the line of the file where there is one): what
/// read_dxf refuses, entities of other kinds, nothing there, open, branching, several outlines, a
/// unit that is not known or an outline of no likely size.
DxfOutline read_dxf_outline(const DxfRequest& request);

} // namespace plyform
