// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/machine_kernel.hpp"

#include "base/simd.hpp"

namespace plyform {
namespace {

PLYFORM_INLINE void triad(double* __restrict a, const double* __restrict b,
                          const double* __restrict c, double s, std::size_t count) {
  for (std::size_t i = 0; i < count; i += 8) {
    store(a + i, load(b + i) + s * load(c + i));
    store(a + i + 4, load(b + i + 4) + s * load(c + i + 4));
  }
}

PLYFORM_INLINE double chains(double* at, std::size_t rounds) {
#if defined(__AVX__)
  constexpr int each = 6; // two units of three or four cycles each; all stay in registers
#else
  constexpr int each = 3; // of pairs of registers
#endif
  const Double4 shrink = all(1.0 - 1e-9), grow = all(1e-9);
  Double4 product[each], sums[each];
  for (int i = 0; i < each; ++i)
    product[i] = load(at) + double(i), sums[i] = load(at) - double(i);
  for (std::size_t round = 0; round < rounds; ++round)
    for (int i = 0; i < each; ++i)
      product[i] *= shrink, sums[i] += grow;
  Double4 last = all(0.0);
  for (int i = 0; i < each; ++i)
    last += product[i] + sums[i];
  store(at, last);
  return 2.0 * each * 4.0 * static_cast<double>(rounds);
}

} // namespace

void PLYFORM_COPY_OF(triad)(double* a, const double* b, const double* c, double s,
                            std::size_t count) {
  triad(a, b, c, s, count);
}

double PLYFORM_COPY_OF(chains)(double* at, std::size_t rounds) {
  return chains(at, rounds);
}

} // namespace plyform
