// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of an outline before it is meshed. Points, sides and holes are numbered from 0 in the
// messages, as in dotted paths of case-file keys; side k runs from point k to the next.
#include "core/mesh/mesher_parts.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_2_algorithms.h>
#include <CGAL/convex_hull_2.h>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <stdexcept>
#include <string>

namespace plyform {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// Corners; or, of a loop with arcs, the ends of pieces, which have no number for the user.
struct Loop : std::vector<Kernel::Point_2> {
  bool pieces = false;
};

/// More triangles are rejected as a probable mistake in element_size: one time step of them would
/// take seconds.
constexpr double most_triangles = 1e7;
/// A loop whose width is below this fraction of its length counts as a line without area.
constexpr double line = 1e-9;

[[noreturn]] void fail(const std::string& message) {
  throw std::runtime_error("blank outline: " + message);
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
  for (std::size_t k = 0; k < hull.size(); ++k) {
    const Kernel::Vector_2 along = hull[(k + 1) % hull.size()] - hull[k];
    double reach = 0.0;
    for (const auto& p : hull) {
      reach = std::max(reach, CGAL::determinant(along, p - hull[k]));
      length = std::max(length, std::sqrt((p - hull[k]).squared_length()));
    }
    width = std::min(width, reach / std::sqrt(along.squared_length()));
  }
  return width;
}

/// Throws for the first two sides of the loop that meet where they should not.
void check_simple(const Loop& loop, const std::string& name) {
  if (CGAL::is_simple_2(loop.begin(), loop.end())) return;
  const std::size_t n = loop.size();
  const auto report = [&](std::size_t k, std::size_t l) {
    fail(fmt::format("{} and {} of {} cross or touch; list the points in order around it, each "
                     "once",
                     text(loop, k), text(loop, l), name));
  };
  for (std::size_t k = 0; k < n; ++k) {
    const auto& p = loop[k];
    const auto& q = loop[(k + 1) % n];
    const auto& r = loop[(k + 2) % n];
    if (CGAL::collinear(p, q, r) && (q - p) * (r - q) < 0) report(k, (k + 1) % n);
    for (std::size_t l = k + 2; l < n; ++l)
      if (!(k == 0 && l == n - 1) && CGAL::do_intersect(side(loop, k), side(loop, l))) report(k, l);
  }
  fail(name + " crosses or touches itself; list its points in order around it, each once");
}

Loop checked_loop(const std::vector<Vec2>& points, const std::string& name, bool pieces) {
  Loop loop = checked_points(points, name);
  loop.pieces = pieces;
  double length = 0.0;
  const double width = smallest_width(loop, length);
  if (!(width > line * length))
    fail(name + " encloses no area, its points lie on one line; correct the points");
  check_simple(loop, name);
  return loop;
}

void check_apart(const Loop& a, const std::string& a_name, const Loop& b,
                 const std::string& b_name) {
  for (std::size_t k = 0; k < a.size(); ++k)
    for (std::size_t l = 0; l < b.size(); ++l)
      if (CGAL::do_intersect(side(a, k), side(b, l)))
        fail(fmt::format("{} of {} crosses or touches {} of {}; move or shrink the hole",
                         text(a, k), a_name, text(b, l), b_name));
}

/// Whether loop a lies inside loop b, for loops whose sides do not meet: one point is
/// representative.
bool lies_in(const Loop& a, const Loop& b) {
  return CGAL::bounded_side_2(b.begin(), b.end(), a.front()) == CGAL::ON_BOUNDED_SIDE;
}

void check_holes(const Loop& boundary, const std::vector<Loop>& holes) {
  const auto name = [](std::size_t k) { return fmt::format("hole {}", k); };
  for (std::size_t k = 0; k < holes.size(); ++k) {
    check_apart(holes[k], name(k), boundary, "the boundary");
    if (!lies_in(holes[k], boundary))
      fail(fmt::format("{} lies outside the boundary, its first point is {}; move it inside or "
                       "leave it out",
                       name(k), text(holes[k].front())));
    for (std::size_t l = 0; l < k; ++l) {
      check_apart(holes[k], name(k), holes[l], name(l));
      for (const auto& [inner, outer] : {std::pair(k, l), std::pair(l, k)})
        if (lies_in(holes[inner], holes[outer]))
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

} // namespace

void check_outline(const Outline& outline, double element_size) {
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

} // namespace plyform
