// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of an outline before it is meshed. Points, sides and holes are numbered from 0 in the
// messages, as in dotted paths of case-file keys; side k runs from point k to the next.
#include "base/format.hpp"
#include "core/mesh/mesher_parts.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_2_algorithms.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/convex_hull_2.h>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>

namespace plyform {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// Corners; or, of a loop with arcs, the ends of pieces, which have no number for the user.
struct Loop : std::vector<Kernel::Point_2> {
  bool pieces = false;
};

/// Points of an outline and its holes; drawings have as many lines and arcs at most.
constexpr std::size_t most_points = 100'000;
/// A loop whose width is below this fraction of its length counts as a line without area.
constexpr double line = 1e-9;

[[noreturn]] void fail(const std::string& message) {
  throw std::runtime_error(message);
}

std::string text(const Kernel::Point_2& p) {
  return fmt::format("({:.6g}, {:.6g})", p.x(), p.y());
}

Kernel::Segment_2 side(const Loop& loop, std::size_t k) {
  return {loop[k], loop[(k + 1) % loop.size()]};
}

std::string text(const Loop& loop, std::size_t k) {
  const std::string ends =
      fmt::format("from {} to {}", text(loop[k]), text(loop[(k + 1) % loop.size()]));
  return loop.pieces ? "the part " + ends : fmt::format("side {} {}", k, ends);
}

/// The loop, checked: finite points, at least three, no two successive ones equal.
Loop checked_points(const std::vector<Vec2>& points, const std::string& name) {
  if (points.size() < 3)
    fail(fmt::format("{} has {} points, at least 3 are needed; add its missing corners", name,
                     points.size()));
  Loop loop;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (!points[k].allFinite())
      fail(fmt::format("point {} of {} is not finite; give both coordinates as numbers in mm", k,
                       name));
    loop.emplace_back(points[k].x(), points[k].y());
  }
  for (std::size_t k = 0; k + 1 < loop.size(); ++k)
    if (loop[k] == loop[k + 1])
      fail(fmt::format("points {} and {} of {} are both {}; leave one of them out", k, k + 1, name,
                       text(loop[k])));
  if (loop.front() == loop.back())
    fail(fmt::format("the last point of {} repeats the first, {}; leave it out, the outline is "
                     "closed without it",
                     name, text(loop.front())));
  return loop;
}

/// Smallest distance between two parallel lines that enclose the loop, mm; `length` is the largest.
double smallest_width(const Loop& loop, double& length) {
  Loop hull;
  CGAL::convex_hull_2(loop.begin(), loop.end(), std::back_inserter(hull));
  double width = std::numeric_limits<double>::infinity();
  length = 0.0;
  const std::size_t n = hull.size();
  std::size_t far = 1; // the corner furthest from a side goes round with the side (calipers)
  for (std::size_t k = 0; k < n; ++k) {
    const Kernel::Vector_2 along = hull[(k + 1) % n] - hull[k];
    const auto reach = [&](std::size_t i) {
      return CGAL::determinant(along, hull[i % n] - hull[k]);
    };
    for (std::size_t i = 0; i < n && reach(far + 1) >= reach(far); ++i)
      far = (far + 1) % n;
    for (const std::size_t end : {k, (k + 1) % n})
      length = std::max(length, std::sqrt((hull[far] - hull[end]).squared_length()));
    width = std::min(width, reach(far) / std::sqrt(along.squared_length()));
  }
  return width;
}

CGAL::Bbox_2 grown(const CGAL::Bbox_2& box, double by) {
  return {box.xmin() - by, box.ymin() - by, box.xmax() + by, box.ymax() + by};
}

/// A side of one of several loops.
struct Side {
  std::size_t loop, k;
  bool operator<(const Side& other) const {
    return std::pair(loop, k) < std::pair(other.loop, other.k);
  }
};

/// The first two sides in the order of `loops` that meet, or are nearer than `near` (mm), and for
/// which asked(a, b), a < b, holds; nothing if none do. One of them, if a great many do.
template <class Asked>
std::optional<std::pair<Side, Side>> first_meeting(const std::vector<const Loop*>& loops,
                                                   double near, const Asked& asked) {
  using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 2, Side>;
  struct Enough {};
  constexpr std::size_t enough = 10'000; // pairs, of which the first is taken
  std::vector<Box> boxes;
  for (std::size_t i = 0; i < loops.size(); ++i)
    for (std::size_t k = 0; k < loops[i]->size(); ++k)
      boxes.emplace_back(grown(side(*loops[i], k).bbox(), near), Side{i, k});
  std::optional<std::pair<Side, Side>> first;
  std::size_t met = 0;
  const auto meet = [&](const Box& one, const Box& other) {
    Side a = one.info(), b = other.info();
    if (b < a) std::swap(a, b);
    if (!asked(a, b)) return;
    const auto one_side = side(*loops[a.loop], a.k), other_side = side(*loops[b.loop], b.k);
    if (!CGAL::do_intersect(one_side, other_side) &&
        !(CGAL::squared_distance(one_side, other_side) < near * near))
      return;
    if (!first || std::pair(a, b) < *first) first = std::pair(a, b);
    if (++met == enough) throw Enough{};
  };
  try {
    CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), meet);
  } catch (const Enough&) {
  }
  return first;
}

/// Throws for the first two sides of the loop that meet, or are nearer than `near` (mm), where they
/// should not: the mesh between would be as fine.
void check_simple(const Loop& loop, double near, const std::string& name) {
  const std::size_t n = loop.size();
  const auto report = [&](std::size_t k, std::size_t l) {
    fail(fmt::format("{} and {} of {} cross or touch; list the points in order around it, each "
                     "once",
                     text(loop, k), text(loop, l), name));
  };
  const bool simple = CGAL::is_simple_2(loop.begin(), loop.end());
  const auto crossing = first_meeting({&loop}, near, [n](const Side& a, const Side& b) {
    return b.k > a.k + 1 && !(a.k == 0 && b.k == n - 1);
  });
  if (simple && !crossing) return;
  std::size_t back = 0; // the first side after which the next goes back on it
  const auto goes_back = [&](std::size_t k) {
    const auto &p = loop[k], &q = loop[(k + 1) % n], &r = loop[(k + 2) % n];
    return CGAL::collinear(p, q, r) && (q - p) * (r - q) < 0;
  };
  while (back < n && !goes_back(back))
    ++back;
  if (crossing && crossing->first.k < back) report(crossing->first.k, crossing->second.k);
  if (back < n) report(back, (back + 1) % n);
  fail(name + " crosses or touches itself; list its points in order around it, each once");
}

Loop checked_loop(const std::vector<Vec2>& points, const std::string& name, bool pieces) {
  Loop loop = checked_points(points, name);
  loop.pieces = pieces;
  double length = 0.0;
  const double width = smallest_width(loop, length);
  if (!(width > line * length))
    fail(name + " encloses no area, its points lie on one line; correct the points");
  check_simple(loop, line * length, name);
  return loop;
}

/// Whether loop a lies inside loop b, for loops whose sides do not meet: one point is
/// representative.
bool lies_in(const Loop& a, const Loop& b) {
  return CGAL::bounded_side_2(b.begin(), b.end(), a.front()) == CGAL::ON_BOUNDED_SIDE;
}

/// loops: the boundary, and all holes; `near`: as of check_simple.
void check_apart(const std::vector<const Loop*>& loops, double near,
                 const std::function<std::string(std::size_t)>& name) {
  const auto met =
      first_meeting(loops, near, [](const Side& a, const Side& b) { return a.loop != b.loop; });
  if (!met) return;
  const auto& [b, a] = *met;
  fail(fmt::format("{} of {} crosses or touches {} of {}; move or shrink the hole",
                   text(*loops[a.loop], a.k), name(a.loop), text(*loops[b.loop], b.k),
                   name(b.loop)));
}

void check_holes(const Loop& boundary, const std::vector<Loop>& holes) {
  const auto name = [](std::size_t k) { // 0: the boundary
    return k == 0 ? std::string("the boundary") : fmt::format("hole {}", k - 1);
  };
  std::vector<const Loop*> loops{&boundary};
  std::vector<CGAL::Bbox_2> boxes{CGAL::bbox_2(boundary.begin(), boundary.end())};
  for (const Loop& hole : holes) {
    loops.push_back(&hole);
    boxes.push_back(CGAL::bbox_2(hole.begin(), hole.end()));
  }
  const CGAL::Bbox_2& all = boxes.front();
  check_apart(loops, line * std::hypot(all.xmax() - all.xmin(), all.ymax() - all.ymin()), name);
  for (std::size_t k = 1; k < loops.size(); ++k) {
    if (!lies_in(*loops[k], boundary))
      fail(fmt::format("{} lies outside the boundary, its first point is {}; move it inside or "
                       "leave it out",
                       name(k), text(loops[k]->front())));
    for (std::size_t l = 1; l < k; ++l) {
      if (!CGAL::do_overlap(boxes[k], boxes[l])) continue;
      for (const auto& [inner, outer] : {std::pair(k, l), std::pair(l, k)})
        if (lies_in(*loops[inner], *loops[outer]))
          fail(fmt::format("{} lies inside {}; leave it out", name(inner), name(outer)));
    }
  }
}

void check_size(const Loop& boundary, double element_size) {
  if (!(element_size > 0 && std::isfinite(element_size)))
    fail(fmt::format("element_size {:g} mm must be greater than 0", element_size));
  double length = 0.0;
  const double width = smallest_width(boundary, length);
  // Tolerance for rounding of the width across an inclined side, so that one cell is accepted.
  if (element_size > width * (1 + 1e-9))
    fail(fmt::format("element_size {:g} mm is larger than the blank's smallest width {:g} mm; "
                     "choose less, usually a twentieth of it",
                     element_size, width));
  const double area = std::abs(CGAL::polygon_area_2(boundary.begin(), boundary.end(), Kernel()));
  const double triangles = 2 * area / (element_size * element_size);
  if (triangles > most_triangles)
    fail(
        fmt::format("element_size {:g} mm would give {:.1e} triangles, more than {:.0e}; choose at "
                    "least {:.2g} mm",
                    element_size, triangles, most_triangles, std::sqrt(2 * area / most_triangles)));
}

/// All loops, the boundary first, checked: arcs in pieces of `largest_turn`, and in those of
/// `spacing` (mm) at most.
std::vector<Loop> checked_loops(const Outline& outline, double spacing, double largest_turn) {
  std::vector<Loop> loops;
  for (int k = -1; k < static_cast<int>(outline.holes.size()); ++k) {
    const std::string name = k < 0 ? "the boundary" : fmt::format("hole {}", k);
    const auto of_loop = [&](const OutlineArc& arc) { return arc.hole == k; };
    const std::vector<Vec2>& corners = k < 0 ? outline.boundary : outline.holes[k];
    if (std::none_of(outline.arcs.begin(), outline.arcs.end(), of_loop)) {
      loops.push_back(checked_loop(corners, name, false));
    } else {
      checked_points(corners, name); // of arcs between other points there are no pieces
      loops.push_back(checked_loop(sample_loop(outline, k, spacing, largest_turn), name, true));
    }
  }
  return loops;
}

void check_whole_outline(const Outline& outline, double element_size) {
  std::size_t points = outline.boundary.size();
  for (const std::vector<Vec2>& hole : outline.holes)
    points += hole.size();
  if (points > most_points)
    fail(fmt::format("it has {} points, more than {}; leave out what an element cannot follow",
                     points, most_points));
  constexpr double fine = std::numbers::pi / 16.0, coarse = std::numbers::pi / 4.0; // rad
  const auto check = [&](double spacing, double turn) {
    std::vector<Loop> loops = checked_loops(outline, spacing, turn);
    const Loop boundary = std::move(loops.front());
    loops.erase(loops.begin());
    check_holes(boundary, loops);
    return boundary;
  };
  check_size(check(std::numeric_limits<double>::infinity(), fine), element_size);
  if (!outline.arcs.empty()) check(element_size, coarse); // as it is meshed
}

} // namespace

void check_outline(const Outline& outline, double element_size) {
  try {
    check_whole_outline(outline, element_size);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(std::string("blank outline: ") + error.what());
  }
}

void check_polygon(const std::vector<Vec2>& corners, const std::string& name) {
  checked_loop(corners, name, false);
}

} // namespace plyform
