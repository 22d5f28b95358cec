// SPDX-License-Identifier: GPL-3.0-or-later
// What the results say of each of their columns and numbers, beside the values: results.h5 has it
// as attributes, and every program that shows them reads it there.
#pragma once

#include <string>

namespace plyform {

/// What a value belongs to.
enum class Location { node, triangle, ply, tool, boundary, run };

/// How values are shown on a scale.
enum class Scale {
  from_zero, ///< from 0, or from the least if that is below
  whole,     ///< from the least to the largest
  both_ways, ///< as far below 0 as above it: either sign counts
  magnitude, ///< without signs, from 0
};

struct Description {
  std::string name;       ///< in every file; ends in its unit where that is no ratio
  std::string word;       ///< in options and study files: warp-strain
  std::string label;      ///< in words, as on a scale
  std::string unit;       ///< "1": a ratio, which is shown as %
  int digits = 0;         ///< after the point, where one value is shown
  double precision = 0.0; ///< in its unit; finer steps say nothing
  Scale scale = Scale::from_zero;
  std::string note = {}; ///< what a reader has to know; a clause, or empty
};

/// "triangle", as files have it.
constexpr const char* word_of(Location location) {
  constexpr const char* words[] = {"node", "triangle", "ply", "tool", "boundary", "run"};
  return words[static_cast<int>(location)];
}

/// "from zero", as files have it.
constexpr const char* word_of(Scale scale) {
  constexpr const char* words[] = {"from zero", "whole", "both ways", "magnitude"};
  return words[static_cast<int>(scale)];
}

} // namespace plyform
