// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/setup/size_ahead.hpp"

#include "core/mesh/mesh_blank.hpp"

#include <algorithm>
#include <cmath>
#include <unistd.h>

namespace plyform {
namespace {

/// Steps, by the time that a wave of tension takes through an element. The ratio is that of
/// cases/hemisphere_0, and holds to a factor of two or so.
double steps_of(const Case& data, const Ply& ply) {
  constexpr double elements_a_step = 0.7;
  const Fabric& fabric = data.fabrics[ply.fabric];
  const double size = smallest_wanted(data.blanks[ply.blank]);
  if (!fabric.has_yarns() || !(size > 0.0)) return 0.0;
  double stiffness = 0.0; // N/mm
  for (const YarnFamily& family : fabric.families)
    stiffness = std::max(stiffness, family.tension.largest_slope() * family.density /
                                        data.solver.fibre_softening);
  const double speed = std::sqrt(stiffness / fabric.surface_density);
  return data.solver.duration * speed / (elements_a_step * size);
}

} // namespace

SizeAhead size_ahead(const Case& data, int threads) {
  // measured on one core with five plies (README) and on 25 000 triangles and more
  constexpr double seconds_a_triangle = 2e-7;
  SizeAhead size;
  double steps = 0.0, most = 0.0;
  for (const Ply& ply : data.plies) {
    const double triangles = expected_triangles(data.blanks[ply.blank]);
    size.triangles += triangles;
    if (triangles > most) most = triangles, size.largest = ply.blank;
    steps = std::max(steps, steps_of(data, ply));
  }
  size.bytes = bytes_for(size.triangles);
  size.seconds = seconds_a_triangle * size.triangles * steps / std::max(threads, 1);
  return size;
}

double bytes_for(double triangles) {
  constexpr double a_triangle = 3072.0; // at its peak, measured as seconds_a_triangle
  return a_triangle * triangles;
}

double machine_memory() {
  const long pages = sysconf(_SC_PHYS_PAGES), bytes = sysconf(_SC_PAGESIZE);
  return pages > 0 && bytes > 0 ? static_cast<double>(pages) * static_cast<double>(bytes) : 4e9;
}

bool too_large(const SizeAhead& size, double memory) {
  constexpr double day = 86400.0;
  return size.bytes > 0.5 * memory || size.seconds > day;
}

} // namespace plyform
