// SPDX-License-Identifier: GPL-3.0-or-later
// What one core can do at best, in the two copies that plyform's kernels come in.
#pragma once

#include <cstddef>

namespace plyform {

/// a[i] = b[i] + s c[i]; arrays aligned to 32 bytes, count a multiple of 8.
void triad_generic(double* a, const double* b, const double* c, double s, std::size_t count);
void triad_avx2(double* a, const double* b, const double* c, double s, std::size_t count);

/// Independent chains of multiplications and as many of additions, `rounds` long, nothing fused.
/// Returns the operations done; `at`: 4 numbers, changed.
double chains_generic(double* at, std::size_t rounds);
double chains_avx2(double* at, std::size_t rounds);

} // namespace plyform
