// SPDX-License-Identifier: GPL-3.0-or-later
// What the processor at hand can do, for the choice between the copies of a kernel.
#pragma once

namespace plyform {

bool has_avx2();

} // namespace plyform
