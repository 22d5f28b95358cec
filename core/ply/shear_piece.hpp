// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace plyform {

/// A piece of C_o and C_e of core/model/shear_law.hpp, times n_c: cubic polynomials of t = g -
/// begin (rad), constant term first, N/mm; and W_e at its begin, N/mm. Rows of four numbers, for
/// the kernel.
struct alignas(32) ShearPiece {
  double begin, odd[4], even[4], even_energy;
};

/// Where to look for a piece: the one in which interval i of g / width begins.
struct ShearInterval {
  int first_piece;
};

} // namespace plyform
