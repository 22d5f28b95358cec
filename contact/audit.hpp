// SPDX-License-Identifier: GPL-3.0-or-later
// Exact check of a finished state (CGAL, exact predicates): what crosses what.
#pragma once

#include "contact/geometry.hpp"

#include <span>
#include <vector>

namespace plyform {

/// Triangle `a` of sheet `sheet_a` crosses triangle `b` of sheet `sheet_b` (sheet_a <= sheet_b).
struct Intersection {
  int sheet_a, a, sheet_b, b;
};

struct AuditResult {
  std::vector<Intersection> between; ///< pairs of triangles of different sheets
  std::vector<Intersection> within; ///< pairs of one sheet, neighbours that only share a node or an
                                    ///< edge left out
};

struct SheetView {
  std::span<const Vec3> x;
  std::span<const Triangle> triangles;
};

/// All intersecting triangle pairs of the given sheets, in ascending order. Exact: coordinates are
/// taken as the doubles that they are. Cost about n log n.
AuditResult audit_intersections(std::span<const SheetView> sheets);

} // namespace plyform
