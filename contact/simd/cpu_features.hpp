// SPDX-License-Identifier: GPL-3.0-or-later
// Detection of the processor's instruction sets, to choose between the copies of a kernel.
#pragma once

namespace plyform {

bool has_avx2();
bool has_avx512(); ///< F, VL and DQ, on top of AVX2

} // namespace plyform
