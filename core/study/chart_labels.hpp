// SPDX-License-Identifier: GPL-3.0-or-later
// Where the words of a chart go: beside their points, off markers, lines and each other.
#pragma once

#include "contact/geometry.hpp"

#include <string>
#include <vector>

namespace plyform {

/// Pixels, y downwards.
struct PixelBox {
  double left = 0, top = 0, right = 0, bottom = 0;
};

struct LabelRequest {
  Vec2 at = Vec2::Zero(); ///< pixels
  double radius = 5;      ///< of the marker
  std::string text;
};

/// What labels keep clear of.
struct Obstacles {
  PixelBox frame;              ///< labels stay inside
  std::vector<PixelBox> boxes; ///< markers
  std::vector<std::pair<Vec2, Vec2>> lines;
};

/// Width of a text in a sans-serif face of the given size, pixels, on the generous side.
double text_width(const std::string& text, double size);

/// The left end of each text's base line, one after the other: of sixteen places around its point
/// the first that touches nothing, or that which touches least.
std::vector<Vec2> place_labels(const std::vector<LabelRequest>& requests, double size,
                               Obstacles obstacles);

} // namespace plyform
