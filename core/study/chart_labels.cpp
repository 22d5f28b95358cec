// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/chart_labels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plyform {

namespace {

/// Pixels^2 that two boxes share.
double overlap(const PixelBox& a, const PixelBox& b) {
  const double x = std::min(a.right, b.right) - std::max(a.left, b.left);
  const double y = std::min(a.bottom, b.bottom) - std::max(a.top, b.top);
  return x > 0.0 && y > 0.0 ? x * y : 0.0;
}

/// Length of the part of a line inside a box, pixels (Liang and Barsky).
double inside(const PixelBox& box, const Vec2& a, const Vec2& b) {
  double from = 0.0, to = 1.0;
  const Vec2 d = b - a;
  const auto clip = [&](double slope, double gap) {
    if (slope == 0.0) {
      if (gap < 0.0) to = -1.0;
    } else if (slope < 0.0) {
      from = std::max(from, gap / slope);
    } else {
      to = std::min(to, gap / slope);
    }
  };
  clip(-d.x(), a.x() - box.left);
  clip(d.x(), box.right - a.x());
  clip(-d.y(), a.y() - box.top);
  clip(d.y(), box.bottom - a.y());
  return to > from ? (to - from) * d.norm() : 0.0;
}

double outside(const PixelBox& box, const PixelBox& frame) {
  return std::max({0.0, frame.left - box.left, box.right - frame.right, frame.top - box.top,
                   box.bottom - frame.bottom});
}

/// How bad a place is: a word over a word cannot be read, one over a thin line can.
double cost(const PixelBox& box, const Obstacles& obstacles) {
  double sum = 100.0 * outside(box, obstacles.frame);
  for (const PixelBox& other : obstacles.boxes)
    sum += overlap(box, other);
  for (const auto& [a, b] : obstacles.lines)
    sum += 0.5 * inside(box, a, b);
  return sum;
}

PixelBox box_of(const Vec2& base, double width, double size) {
  return {base.x(), base.y() - 0.8 * size, base.x() + width, base.y() + 0.2 * size};
}

/// Places around a marker, the usual one first, each as the left end of the base line.
std::vector<Vec2> places(const LabelRequest& request, double width, double size) {
  const double x = request.at.x(), y = request.at.y();
  std::vector<Vec2> all;
  for (const double gap : {3.0, 12.0}) {
    const double r = request.radius + gap, s = r - 1.0;
    const double left = -width - r, middle = -0.5 * width, low = 0.35 * size;
    for (const auto& [dx, dy] : {std::pair{s, -s},
                                 {s, s + 0.7 * size},
                                 {r, low},
                                 {middle, -r},
                                 {middle, r + 0.8 * size},
                                 {left, low},
                                 {-width - s, -s},
                                 {-width - s, s + 0.7 * size}})
      all.emplace_back(x + dx, y + dy);
  }
  return all;
}

} // namespace

double text_width(const std::string& text, double size) {
  const auto characters = std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; // UTF-8: not the bytes that follow
  });
  return 0.58 * size * static_cast<double>(characters);
}

std::vector<Vec2> place_labels(const std::vector<LabelRequest>& requests, double size,
                               Obstacles obstacles) {
  std::vector<Vec2> chosen;
  for (const LabelRequest& request : requests) {
    const double width = text_width(request.text, size);
    double least = std::numeric_limits<double>::infinity();
    Vec2 best = request.at;
    for (const Vec2& place : places(request, width, size)) {
      const double found = cost(box_of(place, width, size), obstacles);
      if (!(found < least)) continue;
      least = found;
      best = place;
    }
    chosen.push_back(best);
    obstacles.boxes.push_back(box_of(best, width, size));
  }
  return chosen;
}

} // namespace plyform
