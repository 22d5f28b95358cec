// SPDX-License-Identifier: GPL-3.0-or-later
// Crimped cells in a membrane: instead of W_a of (E), core/ply/membrane.hpp, two families of a
// crossing with crimp have the energy of their cells at both mean strains of a strain group,
//   A n w(mean eps_1, mean eps_2),  n = d_1 / p_1 = d_2 / p_2 cells per area                   (E)
// and W_a' of (N) is N_a of (C3), core/model/crimp.hpp. Compression is that of each family by
// itself. A pair is then no stiffer than its triangles, as w is convex.
#pragma once

#include "core/ply/membrane.hpp"

namespace plyform {

/// What cells give each family at these strains; nothing to families that are in none.
std::array<LawPoint, most_families> cell_points(const Membrane& m, const OfFamilies& strain);

/// Elastic tension of each family at these strains, N per yarn.
OfFamilies elastic_tensions(const Membrane& m, const OfFamilies& strain);

} // namespace plyform
