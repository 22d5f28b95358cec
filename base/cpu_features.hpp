// SPDX-License-Identifier: GPL-3.0-or-later
// Detection of the processor's instruction sets, to choose between the copies of a kernel.
#pragma once

namespace plyform {

bool has_avx2();
bool has_avx512(); ///< F, VL and DQ, on top of AVX2; not with sanitizers

/// The copy of a kernel for this processor.
template <class Kernel>
Kernel* fastest(Kernel* generic, Kernel* avx2) {
  return has_avx2() ? avx2 : generic;
}

template <class Kernel>
Kernel* fastest(Kernel* generic, Kernel* avx2, Kernel* avx512) {
  return has_avx512() ? avx512 : fastest(generic, avx2);
}

} // namespace plyform
