// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/cpu_features.hpp"

namespace plyform {

bool has_avx2() {
#if defined(__x86_64__)
  static const bool has = __builtin_cpu_supports("avx2");
  return has;
#else
  return false;
#endif
}

bool has_avx512() {
#if defined(__x86_64__) && !defined(PLYFORM_SANITIZED) // its kernels take minutes to compile so
  static const bool has = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
                          __builtin_cpu_supports("avx512dq") && has_avx2();
  return has;
#else
  return false;
#endif
}

} // namespace plyform
