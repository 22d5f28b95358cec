// SPDX-License-Identifier: GPL-3.0-or-later
// Tables of shear as the kernel of core/ply/membrane_simd.hpp looks them up.
#pragma once

#include "core/model/shear_law.hpp"
#include "core/ply/shear_piece.hpp"

namespace plyform {

/// The pieces of the odd and the even part of a table, from 0 on; between them begin the pieces of
/// either side. Behind them stand two that never begin.
struct ShearTable {
  std::vector<ShearPiece> pieces;
  std::vector<ShearInterval> intervals; ///< of even width: the last one has no end
  double per_width = 0.0;               ///< 1/rad
};

/// cells: n_c, 1/mm^2.
ShearTable shear_table(const ShearLaw& law, double cells);

} // namespace plyform
