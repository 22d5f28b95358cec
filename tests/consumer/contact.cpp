// SPDX-License-Identifier: GPL-3.0-or-later
// Uses of the installed contact library that need FCL (SheetTree) and CGAL (the audit).
#include "contact/intersections.hpp"
#include "contact/search/sheet_bvh.hpp"

#include <cstdio>
#include <vector>

int main() {
  using namespace plyform;
  const std::vector<Vec3> flat{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  const std::vector<Vec3> upright{{1, 1, -1}, {1, 1, 1}, {9, 9, 0}};
  const std::vector<Triangle> one{{0, 1, 2}};

  std::vector<Candidate> found;
  SheetTree(flat, one).candidates(upright, 1.5, found);
  const std::vector<MeshView> sheets{{flat, one}, {upright, one}};
  const std::size_t crossings = find_intersections(sheets).between.size();
  std::printf("%zu candidates, %zu crossings\n", found.size(), crossings);
  return found.size() == 2 && crossings == 1 ? 0 : 1; // two corners are 1 mm away, one is far off
}
