// SPDX-License-Identifier: GPL-3.0-or-later
// The limits of the machine at hand, measured in the same run as what is held against them.
#pragma once

#include <cstddef>

namespace plyform {

/// s of this process, all its threads together.
double cpu_seconds();

/// Bytes per second that one core streams through a working set of `bytes` (of 256 MB if that is
/// larger): the best of many triads a = b + s c over three arrays. 24 bytes count a number of each
/// array; that a cache first reads a line that will be overwritten (write-allocate) is not counted,
/// here as in the figures that are divided by this. Measured once a size and run.
double stream_bandwidth(double bytes);

/// Operations per second of one core on doubles, four side by side, multiplications and additions
/// in equal shares and not fused, as in plyform's kernels. Measured once a run.
double peak_arithmetic();

/// How much memory a loop touches.
struct Traffic {
  double streamed = 0.0; ///< bytes read and bytes written, each array once a pass
  double resident = 0.0; ///< bytes of those arrays
  Traffic& operator+=(const Traffic& t) {
    streamed += t.streamed, resident += t.resident;
    return *this;
  }
};

/// `count` items of `size` bytes, each moved `times` (1: read or written, 2: both).
inline Traffic traffic(std::size_t count, std::size_t size, double times = 1.0) {
  const double bytes = static_cast<double>(count) * static_cast<double>(size);
  return {times * bytes, bytes};
}

/// s that one core needs at least to move it.
inline double stream_seconds(const Traffic& t) {
  return t.streamed / stream_bandwidth(t.resident);
}

} // namespace plyform
