// SPDX-License-Identifier: GPL-3.0-or-later
// Draws wall time against error as an SVG of 800 pixels width, both axes logarithmic.
#pragma once

#include <limits>
#include <string>
#include <vector>

namespace plyform {

/// A run in the chart.
struct ChartPoint {
  double time_s = 0;
  double error_deg = std::numeric_limits<double>::quiet_NaN(); ///< NaN: stopped, a cross on top
  std::string label{};
  bool marked = true; ///< false: the line goes through, without marker or label
  double promised_deg = std::numeric_limits<double>::quiet_NaN(); ///< of a preset
};

/// A dial.
struct ChartLine {
  std::string name;
  std::vector<ChartPoint> points; ///< in the order in which they are joined
};

struct Chart {
  std::string title, note; ///< the note in small letters: processor, version
  std::vector<ChartLine> dials;
  std::vector<ChartPoint> presets;
  ChartPoint own;                ///< the case as it is
  double reference_time_s = 0;   ///< 0: not shown
  std::vector<ChartPoint> front; ///< runs that no other beats in both, by time
};

/// The document, UTF-8. Texts may hold anything; points with a time that is not above 0 are left
/// out, and errors of 0 stand on the lower edge.
std::string chart_svg(const Chart& chart);

} // namespace plyform
