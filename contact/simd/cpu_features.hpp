// SPDX-License-Identifier: GPL-3.0-or-later
// Detection of the processor's instruction sets, to choose between the copies of a kernel.
#pragma once

namespace plyform {

bool has_avx2();

} // namespace plyform
