// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/verification/siblings.hpp"

#include "core/accuracy/error_model.hpp"
#include "core/input/bending_resolution.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

constexpr double fewest_in_layer = 1.8; // elements

/// Whether elements larger by this factor still resolve the transition zones of every ply.
bool resolves_bending(const Case& data, double by) {
  return std::all_of(data.plies.begin(), data.plies.end(), [&](const Ply& ply) {
    const BendingLengths lengths = bending_lengths(data.fabrics[ply.fabric], 0.0);
    const double size = by * data.blanks[ply.blank].element_size;
    return !lengths.layer || *lengths.layer >= fewest_in_layer * size;
  });
}

double coarsening_of(const Case& data) {
  for (const double by : {1.4, 1.3, 1.2})
    if (may_coarsen(data, by) && resolves_bending(data, by)) return by;
  return 1.0;
}

} // namespace

Siblings siblings_of(const Case& data) {
  Siblings siblings;
  siblings.coarsening = coarsening_of(data);
  Case sibling = data;
  sibling.solver.outputs = 1;
  if (siblings.coarsening > 1.0) {
    for (BlankSpec& blank : sibling.blanks)
      blank.element_size *= siblings.coarsening;
    siblings.runs.push_back({Cause::mesh, "coarser mesh", sibling});
  } else {
    siblings.left_out.emplace_back(
        "the error of the mesh is the predicted one: the scene takes no larger elements to compare "
        "with");
    siblings.speed = 3.0; // to cost no more
  }
  sibling.solver.duration /= siblings.speed;
  siblings.runs.push_back({Cause::inertia, "faster stroke", sibling});
  Case softer = sibling, twin = sibling;
  softer.solver.fibre_softening *= 2.0;
  if (predicted_error(softer).softening > predicted_error(sibling).softening)
    siblings.runs.push_back({Cause::softening, "softer set of fibres", softer});
  constexpr double turn = 1e-6 * M_PI / 180.0;
  twin.plies[twin.plies.size() / 2].angle += turn;
  siblings.runs.push_back({Cause::chance, "faster stroke and a ply turned by 1e-6 degrees", twin});
  return siblings;
}

} // namespace plyform
